// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <unordered_set>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/number.hpp>
#include <vantage/io/printable.hpp>

namespace vantage {

/// What a CSV file may cost; whatever is larger is refused before it is allocated.
struct CsvLimits {
  std::size_t bytes = std::size_t{256} << 20;
  std::size_t line_bytes = std::size_t{1} << 20;
  std::size_t columns = 4096;
  std::size_t values = std::size_t{1} << 25;  ///< rows times columns
};

/// Columns of numbers under a row of names. Columns that hold text may stand beside them, and are refused when asked
/// for.
class CsvTable {
 public:
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  [[nodiscard]] std::size_t rows() const { return lines_.size(); }
  [[nodiscard]] std::size_t columns() const { return names_.size(); }
  /// The line of the file (from 1) on which a row stands.
  [[nodiscard]] std::size_t line(std::size_t row) const { return lines_[row]; }
  /// File name or whatever the text was said to be, for errors.
  [[nodiscard]] const std::string& where() const { return where_; }

  /// The index of a column, by its name. Throws Error that lists the names there are.
  [[nodiscard]] std::size_t find(std::string_view name) const {
    const auto it = std::find(names_.begin(), names_.end(), name);
    if (it != names_.end()) return static_cast<std::size_t>(it - names_.begin());
    std::string all;
    for (const std::string& n : names_) all += (all.empty() ? "" : ", ") + printable(n, 40);
    throw Error(where_, concat("no column '", printable(name, 40), "'"), "one of " + all.substr(0, 400));
  }
  /// A column's numbers, one a row; NaN where the field was empty or NA. Throws Error, naming the line, if one of them
  /// is no finite number.
  [[nodiscard]] std::span<const double> column(std::size_t index) const {
    const Column& c = columns_.at(index);
    if (c.bad_line != 0)
      throw Error(concat(where_, ":", c.bad_line),
                  concat(c.complaint, " in column '", printable(names_[index], 40), "'"),
                  "a finite number, or nothing");
    return c.values;
  }
  [[nodiscard]] std::span<const double> column(std::string_view name) const { return column(find(name)); }

 private:
  friend class CsvParser;
  struct Column {
    std::vector<double> values;
    std::size_t bad_line = 0;  ///< of the first field that is no number
    std::string complaint;
  };
  std::string where_;
  std::vector<std::string> names_;
  std::vector<Column> columns_;
  std::vector<std::size_t> lines_;
};

/// Reads comma-separated text: lines end in LF or CRLF, fields may be quoted ("" is a quote; no line breaks inside),
/// blanks around a field and blank lines do not count, the first line names the columns.
class CsvParser {
 public:
  CsvParser(std::string_view text, std::string where, const CsvLimits& limits) : text_(text), limits_(limits) {
    table_.where_ = std::move(where);
  }

  CsvTable parse() && {
    if (text_.size() > limits_.bytes)
      throw Error(table_.where_, concat(text_.size(), " bytes"), concat("at most ", limits_.bytes));
    if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);  // byte order mark
    while (next_line())
      if (table_.names_.empty())
        header();
      else
        row();
    if (table_.names_.empty()) throw Error(table_.where_, "the file is empty", "a line of column names");
    if (table_.rows() == 0) throw Error(table_.where_, "no row after the column names", "at least one");
    return std::move(table_);
  }

 private:
  /// The next line that is not blank, checked for size and for bytes that no text has.
  bool next_line() {
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      line_ = text_.substr(0, end);
      text_.remove_prefix(std::min(end + 1, text_.size()));
      ++number_;
      if (line_.ends_with('\r')) line_.remove_suffix(1);
      if (line_.size() > limits_.line_bytes)
        refuse(concat("a line of ", line_.size(), " bytes"), concat("at most ", limits_.line_bytes));
      for (const char c : line_)
        if ((static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F)
          refuse(concat("byte ", static_cast<int>(static_cast<unsigned char>(c))), "text, not binary data");
      if (line_.find_first_not_of(" \t") != line_.npos) return true;
    }
    return false;
  }

  void header() {
    split([&](std::size_t index, std::string_view name) {
      if (index >= limits_.columns) refuse(concat("more than ", limits_.columns, " columns"), "fewer");
      if (name.empty()) refuse(concat("column ", index + 1, " has no name"), "a name for each column");
      table_.names_.emplace_back(name);
    });
    const auto is_number = [](std::string_view name) {
      double unused = 0;
      return take_number(name, unused) && name.empty();
    };
    if (std::all_of(table_.names_.begin(), table_.names_.end(), is_number))
      refuse("numbers only", "a line of column names");
    std::unordered_set<std::string_view> seen;
    for (const std::string& name : table_.names_)
      if (!seen.insert(name).second)
        refuse(concat("two columns are named '", printable(name, 40), "'"), "distinct names");
    if (table_.columns() == 1 && line_.find_first_of(";\t") != line_.npos)
      refuse("no comma in the line of names", "comma-separated columns");
    table_.columns_.resize(table_.columns());
  }

  void row() {
    if ((table_.rows() + 1) * table_.columns() > limits_.values)
      refuse(concat("more than ", limits_.values, " values"), "fewer");
    std::size_t count = 0;
    split([&](std::size_t index, std::string_view field) {
      ++count;
      if (index < table_.columns()) put(table_.columns_[index], field);
    });
    if (count != table_.columns())
      refuse(concat(count, " fields"), concat(table_.columns(), ", as in the line of names"));
    table_.lines_.push_back(number_);
  }

  void put(CsvTable::Column& column, std::string_view field) {
    double value = std::numeric_limits<double>::quiet_NaN();
    if (!field.empty() && field != "NA") {
      std::string_view digits = field;
      if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
      const auto [end, failed] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
      const bool whole = end == digits.data() + digits.size();
      if (failed != std::errc{} || !whole || !std::isfinite(value)) {
        value = std::numeric_limits<double>::quiet_NaN();
        if (column.bad_line == 0) {
          column.bad_line = number_;
          column.complaint = concat("'", printable(field, 40), "'",
                                    failed == std::errc::result_out_of_range && whole ? " (out of range)" : "");
        }
      }
    }
    column.values.push_back(value);
  }

  /// Calls take(index, field) for each field of the line, without quotes and the blanks around it.
  template <class Take>
  void split(Take&& take) {
    const auto skip = [&](std::size_t at) { return std::min(line_.find_first_not_of(" \t", at), line_.size()); };
    std::size_t at = 0;
    for (std::size_t index = 0;; ++index) {
      at = skip(at);
      if (at < line_.size() && line_[at] == '"') {
        unquoted_.clear();
        for (++at;; ++at) {
          if (at >= line_.size()) refuse("a quote is not closed", "a closing quote on the same line");
          if (line_[at] == '"' && (++at >= line_.size() || line_[at] != '"')) break;
          unquoted_ += line_[at];
        }
        at = skip(at);
        if (at < line_.size() && line_[at] != ',') refuse("text after a closing quote", "a comma");
        take(index, trim(unquoted_));
      } else {
        const std::size_t end = std::min(line_.find(',', at), line_.size());
        take(index, trim(line_.substr(at, end - at)));
        at = end;
      }
      if (at >= line_.size()) return;
      ++at;  // the comma
    }
  }

  static std::string_view trim(std::string_view s) {
    const std::size_t begin = std::min(s.find_first_not_of(" \t"), s.size());
    return s.substr(begin, s.find_last_not_of(" \t") + 1 - begin);
  }
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const {
    throw Error(concat(table_.where_, ":", number_), what, expected);
  }

  std::string_view text_, line_;
  CsvLimits limits_;
  std::size_t number_ = 0;
  std::string unquoted_;
  CsvTable table_;
};

/// Reads CSV text; `where` names it in errors. Throws Error naming the line and what was expected. O(bytes).
inline CsvTable parse_csv(std::string_view text, std::string where = "CSV", const CsvLimits& limits = {}) {
  return CsvParser(text, std::move(where), limits).parse();
}

/// Reads a CSV file.
inline CsvTable read_csv(const std::filesystem::path& path, const CsvLimits& limits = {}) {
  return parse_csv(read_file(path, limits.bytes), path.string(), limits);
}

/// CSV text of columns of equal length: numbers as short as they can be to be read back bit for bit, nothing for NaN.
/// Throws Error if sizes disagree, if a name holds a quote, a comma or a line break, or if a value is infinite.
inline std::string format_csv(std::span<const std::string> names, std::span<const std::vector<double>> columns) {
  if (names.size() != columns.size() || names.empty())
    throw Error("format_csv", concat(names.size(), " names for ", columns.size(), " columns"),
                "one each, at least one");
  std::string text;
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (names[c].empty() || names[c].find_first_of("\",\r\n") != std::string::npos)
      throw Error("format_csv", concat("the name '", printable(names[c], 40), "'"), "no quote, comma or line break");
    if (columns[c].size() != columns[0].size())
      throw Error("format_csv", concat("column '", printable(names[c], 40), "' has ", columns[c].size(), " rows"),
                  concat(columns[0].size()));
    (text += c ? "," : "") += names[c];
  }
  text += '\n';
  for (std::size_t row = 0; row < columns[0].size(); ++row) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c) text += ',';
      const double v = columns[c][row];
      if (std::isinf(v))
        throw Error("format_csv", concat("an infinite value in column '", printable(names[c], 40), "', row ", row),
                    "finite, or NaN");
      if (std::isnan(v)) continue;
      char digits[32];
      text.append(digits, std::to_chars(digits, digits + sizeof digits, v).ptr);
    }
    text += '\n';
  }
  return text;
}

}  // namespace vantage
