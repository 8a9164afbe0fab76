// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace vantage {

/// Takes a number off the front of a text, whatever the locale; false, and nothing taken, if there is none. What is too
/// large for a double is infinite, what is too small is 0; "nan" and "inf" are numbers.
inline bool take_number(std::string_view& text, double& value) {
  const std::size_t sign = !text.empty() && text[0] == '+' ? 1 : 0;
  if (sign == 1 && text.size() > 1 && text[1] == '-') return false;
  const char* begin = text.data() + sign;
  const auto [end, failed] = std::from_chars(begin, text.data() + text.size(), value);
  if (failed == std::errc::invalid_argument) return false;
  if (failed == std::errc::result_out_of_range) {
    const std::string digits(begin, std::min<std::size_t>(static_cast<std::size_t>(end - begin), 512));
    value = std::strtod(digits.c_str(), nullptr);
  }
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace vantage
