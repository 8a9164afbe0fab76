// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/io/number.hpp>
#include <vantage/io/printable.hpp>

namespace vantage {

/// Lines of an OBJ or MTL file, read on demand: words and numbers one after the other. A backslash joins a line with
/// the next.
class ObjLines {
 public:
  ObjLines(std::string_view text, std::string where) : text_(text), where_(std::move(where)) {}

  /// The next line's first word, or "" at the end; comments and blank lines do not count.
  std::string_view next() {
    while (!text_.empty()) {
      line_ = take_line();
      if (line_.ends_with('\\')) {
        joined_.clear();
        for (; line_.ends_with('\\'); line_ = text_.empty() ? std::string_view() : take_line())
          (joined_ += line_.substr(0, line_.size() - 1)) += ' ';
        joined_ += line_;
        line_ = joined_;
      }
      const std::string_view first = word();
      if (!first.empty() && first[0] != '#') return first;
    }
    return {};
  }
  /// The next word of the line, or "".
  std::string_view word() {
    blanks();
    std::size_t n = 0;
    while (n < line_.size() && line_[n] != ' ' && line_[n] != '\t') ++n;
    const std::string_view w = line_.substr(0, n);
    line_.remove_prefix(n);
    return w;
  }
  /// What is left of the line, without the blanks around it.
  std::string_view rest() {
    blanks();
    return line_.substr(0, line_.find_last_not_of(" \t") + 1);
  }
  /// The next number of the line. False if there is none left; throws Error if something else is.
  bool number(double& value) {
    blanks();
    if (line_.empty() || line_[0] == '#') return false;
    const std::string_view before = line_;
    if (!take_number(line_, value) || (!line_.empty() && line_[0] != ' ' && line_[0] != '\t'))
      refuse(concat("'", printable(before, 16), "'"), "a number");
    return true;
  }
  template <int N>
  Eigen::Matrix<double, N, 1> numbers(std::string_view what) {
    Eigen::Matrix<double, N, 1> v;
    for (int i = 0; i < N; ++i)
      if (!number(v[i])) refuse(concat(i, " numbers of a ", what), concat(N));
    return v;
  }
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const {
    throw Error(concat(where_, ":", number_), what, expected);
  }
  [[nodiscard]] const std::string& where() const { return where_; }

 private:
  std::string_view take_line() {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view line = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++number_;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.find('\0') != line.npos) refuse("a byte 0", "text, not binary data");
    return line;
  }
  void blanks() {
    while (!line_.empty() && (line_[0] == ' ' || line_[0] == '\t')) line_.remove_prefix(1);
  }
  std::string_view text_, line_;
  std::string where_, joined_;
  std::size_t number_ = 0;
};

}  // namespace vantage
