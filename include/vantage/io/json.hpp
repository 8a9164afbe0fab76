// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/printable.hpp>

// JSON that strangers wrote: bounded before it is parsed, and read through items that know where they stand. And JSON
// that holds what strangers named, as text.
namespace vantage {

/// What a JSON text may cost; whatever is larger is refused before it is allocated.
struct JsonLimits {
  std::size_t bytes = std::size_t{64} << 20;
  std::size_t depth = 64;                     ///< arrays and objects within each other
  std::size_t values = std::size_t{1} << 22;  ///< numbers, texts, arrays, ... in all
};

namespace detail {

/// Throws unless the text keeps to the limits: one pass, no allocation.
inline void check_json_limits(std::string_view text, const std::string& where, const JsonLimits& limits) {
  if (text.size() > limits.bytes) throw Error(where, concat(text.size(), " bytes"), concat("at most ", limits.bytes));
  std::size_t depth = 0, values = 1;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
      continue;
    }
    if (c == '"') quoted = true;
    if (c == '[' || c == '{') ++depth;
    if ((c == ']' || c == '}') && depth > 0) --depth;
    values += c == ',' || c == '[' || c == '{';
    if (depth > limits.depth)
      throw Error(where, concat("nested deeper than ", limits.depth, " at byte ", i), "a flatter JSON");
    if (values > limits.values)
      throw Error(where, concat("more than ", limits.values, " values at byte ", i), "a smaller JSON");
  }
}

}  // namespace detail

/// Parses a JSON text; `where` names it in errors, which tell the line and the byte. O(bytes).
inline nlohmann::json parse_json(std::string_view text, const std::string& where, const JsonLimits& limits = {}) {
  detail::check_json_limits(text, where, limits);
  try {
    return nlohmann::json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::parse_error& e) {
    const std::size_t byte = std::min(e.byte, text.size());
    const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
    if (byte >= text.size())
      throw Error(concat(where, ":", line), concat("ends at byte ", byte), "the rest of a JSON text");
    const std::string_view rest = text.substr(byte == 0 ? 0 : byte - 1);
    throw Error(concat(where, ":", line), concat("no JSON at byte ", byte, ", near '", printable(rest, 20), "'"),
                "a JSON text (UTF-8)");
  } catch (const nlohmann::json::exception&) {  // such as 1e999
    throw Error(where, "a number that is out of range", "finite numbers");
  }
}

/// JSON as text on one line. A string that is no UTF-8, such as a file's or a column's name, is written with U+FFFD for
/// what cannot be read.
template <class Json>
std::string json_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// A value of a JSON text with the way to it, so that a complaint names both: "scene.json: /boxes/3/min: ...".
/// Refers to the text's values, which must outlive it. Every getter throws Error if the value is of another kind.
class JsonItem {
 public:
  JsonItem(const nlohmann::json& value, std::string where, std::string path = {})
      : value_(&value), where_(std::move(where)), path_(std::move(path)) {}

  [[nodiscard]] const nlohmann::json& json() const { return *value_; }
  [[nodiscard]] bool is_object() const { return value_->is_object(); }
  [[nodiscard]] bool is_array() const { return value_->is_array(); }
  [[nodiscard]] bool is_text() const { return value_->is_string(); }
  [[nodiscard]] bool is_number() const { return value_->is_number(); }

  /// A member of an object.
  [[nodiscard]] JsonItem at(const std::string& key) const {
    if (auto item = find(key)) return *std::move(item);
    refuse(concat("no '", key, "'"), "an object that has it");
  }
  /// A member of an object, or none; null counts as none.
  [[nodiscard]] std::optional<JsonItem> find(const std::string& key) const {
    if (!is_object()) refuse(kind(), "an object");
    const auto it = value_->find(key);
    if (it == value_->end() || it->is_null()) return std::nullopt;
    return JsonItem(*it, where_, path_ + "/" + printable(key));
  }
  /// How many elements an array has.
  [[nodiscard]] std::size_t size() const {
    if (!is_array()) refuse(kind(), "an array");
    return value_->size();
  }
  [[nodiscard]] JsonItem at(std::size_t index) const {
    if (index >= size()) refuse(concat(size(), " elements"), concat("more than ", index));
    return {(*value_)[index], where_, concat(path_, "/", index)};
  }
  /// f(item) for each element of an array.
  template <class F>
  void each(F&& f) const {
    const std::size_t n = size();
    for (std::size_t i = 0; i < n; ++i) f(at(i));
  }
  /// f(key, item) for each member of an object, by name.
  template <class F>
  void each_member(F&& f) const {
    if (!is_object()) refuse(kind(), "an object");
    for (auto it = value_->begin(); it != value_->end(); ++it)
      f(it.key(), JsonItem(*it, where_, path_ + "/" + printable(it.key())));
  }

  [[nodiscard]] double number(double low = std::numeric_limits<double>::lowest(),
                              double high = std::numeric_limits<double>::max()) const {
    if (!is_number()) refuse(kind(), "a number");
    const double x = value_->get<double>();
    if (!(x >= low && x <= high)) refuse(concat(x), concat("a number from ", low, " to ", high));
    return x;
  }
  /// A whole number from 0 to `most`.
  [[nodiscard]] std::size_t count(std::size_t most) const {
    if (!is_number()) refuse(kind(), concat("a whole number from 0 to ", most));
    const double x = value_->get<double>();
    if (!(x >= 0 && x <= static_cast<double>(most) && x == std::floor(x) && x < 9.007199254740992e15))
      refuse(concat(x), concat("a whole number from 0 to ", most));
    return static_cast<std::size_t>(x);
  }
  /// An array of N numbers.
  template <int N>
  [[nodiscard]] Eigen::Matrix<double, N, 1> vector() const {
    if (size() != N) refuse(concat(size(), " elements"), concat(N, " numbers"));
    Eigen::Matrix<double, N, 1> v;
    for (int i = 0; i < N; ++i) v[i] = at(static_cast<std::size_t>(i)).number();
    return v;
  }
  [[nodiscard]] const std::string& text() const {
    if (!is_text()) refuse(kind(), "a text");
    return value_->get_ref<const std::string&>();
  }
  [[nodiscard]] bool flag() const {
    if (!value_->is_boolean()) refuse(kind(), "true or false");
    return value_->get<bool>();
  }
  /// Throws Error about this value.
  [[noreturn]] void refuse(std::string_view what, std::string_view expected) const {
    throw Error(path_.empty() ? where_ : concat(where_, ": ", path_), what, expected);
  }

 private:
  [[nodiscard]] std::string kind() const { return concat("a value of kind ", value_->type_name()); }

  const nlohmann::json* value_;
  std::string where_, path_;
};

/// Reads a JSON file. Use it through `JsonItem(json, path.string())`.
inline nlohmann::json read_json(const std::filesystem::path& path, const JsonLimits& limits = {}) {
  return parse_json(read_file(path, limits.bytes), path.string(), limits);
}

}  // namespace vantage
