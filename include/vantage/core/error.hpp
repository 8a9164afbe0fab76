// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace vantage {

/// Bad input or configuration: says where, what was found and what was expected. Whatever threw it is unchanged.
class Error : public std::runtime_error {
 public:
  /// `where`: the function, type or file (with its line or byte); `expected` may be empty.
  Error(std::string_view where, std::string_view what, std::string_view expected = {})
      : std::runtime_error(text(where, what, expected)) {}

 private:
  static std::string text(std::string_view where, std::string_view what, std::string_view expected) {
    std::string s;
    s.append(where).append(": ").append(what);
    if (!expected.empty()) s.append("; expected ").append(expected);
    return s;
  }
};

/// Text of several values in a row, for error messages: `concat("row ", 3, " has ", n, " columns")`.
template <class... Ts>
std::string concat(const Ts&... parts) {
  std::ostringstream s;
  s.precision(10);
  (s << ... << parts);
  return s.str();
}

/// Collects every violation of a configuration and throws them all in one Error.
///
///     Check check("IntegralGp::Config");
///     check(c.depth >= 1 && c.depth <= 12, "depth", c.depth, "1 to 12");
///     check.done();
class Check {
 public:
  explicit Check(std::string_view where) : where_(where) {}

  template <class T>
  void operator()(bool holds, std::string_view name, const T& value, std::string_view expected) {
    if (holds) return;
    if (!violations_.empty()) violations_ += "; ";
    violations_ += concat(name, " = ", value, " (expected ", expected, ")");
  }
  /// The most common rule: a finite number above zero.
  template <class T>
  void positive(std::string_view name, T value) {
    (*this)(std::isfinite(static_cast<double>(value)) && value > T{0}, name, value, "finite and > 0");
  }
  template <class T>
  void not_negative(std::string_view name, T value) {
    (*this)(std::isfinite(static_cast<double>(value)) && value >= T{0}, name, value, "finite and >= 0");
  }
  template <class T>
  void finite(std::string_view name, T value) {
    (*this)(std::isfinite(static_cast<double>(value)), name, value, "finite");
  }
  /// Throws if anything was violated.
  void done() const {
    if (!violations_.empty()) throw Error(where_, violations_);
  }

 private:
  std::string where_, violations_;
};

}  // namespace vantage
