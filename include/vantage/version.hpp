// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once

/// The library's version. Nothing else states it: CMake reads these three lines.
#define VANTAGE_VERSION_MAJOR 0
#define VANTAGE_VERSION_MINOR 1
#define VANTAGE_VERSION_PATCH 0

#define VANTAGE_DETAIL_TEXT_(x) #x
#define VANTAGE_DETAIL_TEXT(x) VANTAGE_DETAIL_TEXT_(x)

/// "major.minor.patch", as reports and checkpoints carry it.
#define VANTAGE_VERSION                      \
  VANTAGE_DETAIL_TEXT(VANTAGE_VERSION_MAJOR) \
  "." VANTAGE_DETAIL_TEXT(VANTAGE_VERSION_MINOR) "." VANTAGE_DETAIL_TEXT(VANTAGE_VERSION_PATCH)
