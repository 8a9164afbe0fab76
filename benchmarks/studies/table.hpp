// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <vantage/io/file.hpp>
#include <vantage/mission/text.hpp>

#include "statistics.hpp"
#include "units.hpp"

// Tables as people and programs read them.
namespace study {

/// NaN as null.
inline Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }
inline double number(const Json& x) { return x.is_number() ? x.get<double>() : nan; }

/// With so many decimals; "-" for NaN.
inline std::string decimals(double x, int digits) {
  if (std::isnan(x)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, x);
  return text;
}
/// "0.026 ± 0.002"; without a deviation "0.026".
inline std::string with_deviation(double mean, double deviation, int digits) {
  return decimals(mean, digits) +
         (std::isnan(mean) || std::isnan(deviation) ? "" : " ± " + decimals(deviation, digits));
}
/// A time or a size in three digits, whatever its magnitude.
inline int three_digits(double x) { return x >= 100 || x == 0 ? 0 : x >= 10 ? 1 : x >= 1 ? 2 : 3; }

/// A Markdown table; cells must hold no line breaks.
class Markdown {
 public:
  explicit Markdown(std::span<const std::string> header) : columns_(header.size()) {
    row(header);
    text_ += '|';
    for (std::size_t i = 0; i < columns_; ++i) text_ += "---|";
    text_ += '\n';
  }
  void row(std::span<const std::string> cells) {
    if (cells.size() != columns_)
      throw vantage::Error("Markdown", vantage::concat(cells.size(), " cells"), vantage::concat(columns_));
    text_ += '|';
    for (const std::string& cell : cells) {
      text_ += ' ';
      for (const char c : cell) c == '|' ? text_ += "\\|" : text_ += c;
      text_ += " |";
    }
    text_ += '\n';
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::size_t columns_;
  std::string text_;
};

/// Flat JSON objects with the same keys as CSV, a header first; null and NaN are empty (RFC 4180).
inline std::string csv(const Json& rows) {
  const auto quoted = [](const std::string& s) {
    if (s.find_first_of(",\"\n\r") == s.npos) return s;
    std::string q = "\"";
    for (const char c : s) q += c == '"' ? std::string("\"\"") : std::string(1, c);
    return q + '"';
  };
  std::string text, line;
  for (const Json& row : rows) {
    if (text.empty()) {
      for (const auto& [key, value] : row.items()) line += (line.empty() ? "" : ",") + quoted(key);
      text = line + "\n";
    }
    bool first = true;
    for (const auto& [key, value] : row.items()) {
      if (!first) text += ',';
      first = false;
      text += value.is_null() ? "" : value.is_string() ? quoted(value.get<std::string>()) : value.dump();
    }
    text += '\n';
  }
  return text;
}

/// A statement of the thesis, tested; `of_thesis`: the same test on the thesis' own figures, where it prints them.
struct Claim {
  std::string text, scope;
  std::optional<bool> met, of_thesis = {};
  std::string numbers;
};

inline std::string verdict(const std::optional<bool>& met) { return !met ? "-" : *met ? "met" : "not met"; }

inline Json json(std::span<const Claim> claims) {
  Json list = Json::array();
  const auto value = [](const std::optional<bool>& b) { return b ? Json(*b) : Json(); };
  for (const Claim& c : claims)
    list.push_back({{"claim", c.text},
                    {"scope", c.scope},
                    {"met", value(c.met)},
                    {"met_by_the_thesis_figures", value(c.of_thesis)},
                    {"numbers", c.numbers}});
  return list;
}

}  // namespace study
