// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
static_assert(false, "a refusal that nobody described");
