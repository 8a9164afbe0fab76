// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cassert>

/// A caller's bug, not an input: checked in debug builds only. Define it before including vantage to route it
/// elsewhere.
#ifndef VANTAGE_ASSERT
#define VANTAGE_ASSERT(condition) assert(condition)
#endif
