// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <numbers>

namespace vantage {

/// Degrees to radians: angles are radians everywhere else.
constexpr double deg(double degrees) { return degrees * std::numbers::pi / 180.0; }

}  // namespace vantage
