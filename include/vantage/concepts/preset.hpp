// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string_view>

/// Where the thesis and the published code disagree, a system has two presets; these tags choose. Each room says what
/// it makes of a tag, in types and in values (field: FieldPreset).
namespace vantage::preset {

struct thesis {
  static constexpr std::string_view name = "thesis";
};
struct reference {
  static constexpr std::string_view name = "reference";
};

}  // namespace vantage::preset
