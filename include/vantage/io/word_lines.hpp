// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/printable.hpp>

namespace vantage {

/// What a text of words may cost; whatever is larger is refused.
struct WordLimits {
  std::size_t bytes = std::size_t{64} << 20;
  std::size_t words = 64;                         ///< of a line
  std::size_t lines = std::size_t{1} << 20;       ///< that are not comments
  std::size_t line_bytes = std::size_t{1} << 16;  ///< of a line that is read, not skipped
};

/// The lines of a text, word by word, as lists of pictures and poses are written: words stand between blanks, a line
/// that is blank or starts with # does not count. Does not own the text.
class WordLines {
 public:
  WordLines(std::string_view text, std::string where, const WordLimits& limits = {})
      : text_(text), where_(std::move(where)), limits_(limits) {
    if (text_.size() > limits_.bytes)
      throw Error(where_, concat(text_.size(), " bytes"), concat("at most ", limits_.bytes));
  }

  /// Goes to the next line that counts; false at the end. Throws Error, naming the line, if it holds bytes that no text
  /// has or is too long.
  bool next() {
    while (take_line()) {
      if (line_.size() > limits_.line_bytes)
        refuse(concat("a line of ", line_.size(), " bytes"), concat("at most ", limits_.line_bytes));
      for (const char c : line_)
        if ((static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F)
          refuse(concat("byte ", static_cast<int>(static_cast<unsigned char>(c))), "text, not binary data");
      split();
      if (words_.empty() || words_[0].starts_with('#')) continue;
      if (++count_ > limits_.lines) refuse(concat("more than ", limits_.lines, " lines"), "fewer");
      return true;
    }
    return false;
  }
  /// Leaves out the next line, whatever it holds.
  void skip() { take_line(); }

  [[nodiscard]] std::size_t size() const { return words_.size(); }
  /// A word of the line, from 0. Throws Error if the line is shorter.
  [[nodiscard]] std::string_view word(std::size_t index) const {
    need(index + 1);
    return words_[index];
  }
  /// The line from a word to its end, which may hold blanks: a file's name.
  [[nodiscard]] std::string_view rest(std::size_t index) const {
    need(index + 1);
    const auto at = static_cast<std::size_t>(words_[index].data() - line_.data());
    return line_.substr(at, line_.find_last_not_of(" \t") + 1 - at);
  }
  /// A word as a finite number. Throws Error otherwise.
  [[nodiscard]] double number(std::size_t index) const {
    std::string_view digits = word(index);
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    double value = 0;
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (failed != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
      refuse(concat("'", printable(word(index)), "' (word ", index + 1, ")"), "a finite number");
    return value;
  }
  /// A word as a whole number from `low` to `high`. Throws Error otherwise.
  [[nodiscard]] long integer(std::size_t index, long low, long high) const {
    const std::string_view digits = word(index);
    long value = 0;
    const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (failed != std::errc{} || end != digits.data() + digits.size() || value < low || value > high)
      refuse(concat("'", printable(digits), "' (word ", index + 1, ")"),
             concat("a whole number from ", low, " to ", high));
    return value;
  }
  /// File and line, for errors.
  [[nodiscard]] std::string where() const { return concat(where_, ":", number_); }
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const {
    throw Error(where(), what, expected);
  }

 private:
  bool take_line() {
    if (text_.empty()) return false;
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    line_ = text_.substr(0, end);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++number_;
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    return true;
  }
  void split() {
    words_.clear();
    for (std::size_t at = line_.find_first_not_of(" \t"); at < line_.size(); at = line_.find_first_not_of(" \t", at)) {
      const std::size_t end = std::min(line_.find_first_of(" \t", at), line_.size());
      if (words_.size() == limits_.words && !words_[0].starts_with('#'))
        refuse(concat("more than ", limits_.words, " words"), "fewer");
      if (words_.size() < limits_.words) words_.push_back(line_.substr(at, end - at));
      at = end;
    }
  }
  void need(std::size_t words) const {
    if (words_.size() < words) refuse(concat(words_.size(), " words on the line"), concat("at least ", words));
  }

  std::string_view text_, line_;
  std::string where_;
  WordLimits limits_;
  std::vector<std::string_view> words_;
  std::size_t number_ = 0, count_ = 0;
};

}  // namespace vantage
