// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// expect: the cause
// expect: another cause
static_assert(false, "the cause, and not the one expected");
