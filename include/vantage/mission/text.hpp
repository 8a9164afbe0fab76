// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <string_view>

// Numbers, times and markup as people and pages read them.
namespace vantage {

/// `x` in about six characters, as people write numbers: "0.0423", "12.3", "4096"; "-" for NaN.
inline std::string short_number(double x) {
  if (std::isnan(x)) return "-";
  if (std::isinf(x)) return x > 0 ? "inf" : "-inf";
  const double a = std::abs(x);
  char text[32];
  if (x == std::round(x) && a < 1e6)
    std::snprintf(text, sizeof text, "%.0f", x + 0.0);
  else if (a >= 100 && a < 1e6)
    std::snprintf(text, sizeof text, "%.1f", x);
  else
    std::snprintf(text, sizeof text, "%.3g", x);
  return text;
}

/// Seconds as "0:07", "12:05" or "1:02:03".
inline std::string short_time(double seconds) {
  const auto s = static_cast<std::uint64_t>(std::clamp(std::round(seconds), 0.0, 1e9));
  const auto part = [](std::uint64_t x) { return static_cast<int>(x); };
  char text[32];
  if (s < 3600)
    std::snprintf(text, sizeof text, "%d:%02d", part(s / 60), part(s % 60));
  else
    std::snprintf(text, sizeof text, "%d:%02d:%02d", part(s / 3600), part(s / 60 % 60), part(s % 60));
  return text;
}

/// Text for HTML and SVG, between tags and in quoted attributes.
inline std::string escaped(std::string_view text) {
  std::string s;
  for (const char c : text) switch (c) {
      case '&':
        s += "&amp;";
        break;
      case '<':
        s += "&lt;";
        break;
      case '>':
        s += "&gt;";
        break;
      case '"':
        s += "&quot;";
        break;
      case '\'':
        s += "&#39;";
        break;
      default:
        s += c;
    }
  return s;
}

/// RFC 4648, with padding.
inline std::string base64(std::span<const std::byte> bytes) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = (word << 8) | (i + k < bytes.size() ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[(word >> (18 - 6 * k)) & 63] : '=';
  }
  return text;
}

}  // namespace vantage
