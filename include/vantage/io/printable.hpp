// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <string>
#include <string_view>

namespace vantage {

/// Hostile text, cut short and made of printable characters, for an error message.
inline std::string printable(std::string_view text, std::size_t most = 60) {
  std::string out(text.substr(0, most));
  for (char& c : out)
    if (c < 0x20 || c > 0x7E) c = '?';
  return text.size() > most ? out + "..." : out;
}

}  // namespace vantage
