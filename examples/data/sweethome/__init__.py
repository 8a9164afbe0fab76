# SPDX-FileCopyrightText: 2026 The vantage authors
# SPDX-License-Identifier: MIT
