// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <vantage/core/error.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/scalar_field.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/printable.hpp>

// Fields from files: a CSV table of positions and values, and beside it, if there is one, a JSON file of the same name
// that tells the columns' units: {"units": {"x": "m", "elevation": "m"}}.
namespace vantage {

namespace detail {

/// The unit of a column by the JSON companion, or "".
class Units {
 public:
  explicit Units(const std::filesystem::path& file) {
    if (!file_exists(file)) return;
    const std::string text = read_file(file, std::size_t{1} << 20);
    json_ = nlohmann::json::parse(text, nullptr, false);
    if (json_.is_discarded())
      throw Error(file.string(), "this is no JSON", R"({"units": {"column": "unit"}}, or no such file)");
  }
  [[nodiscard]] std::string of(const std::string& column) const {
    if (!json_.is_object() || !json_.contains("units")) return "";
    const auto& units = json_["units"];
    if (!units.is_object() || !units.contains(column) || !units[column].is_string()) return "";
    return units[column].get<std::string>().substr(0, 64);
  }

 private:
  nlohmann::json json_;
};

/// A column's name in lower case, with one name for longitude, "lon", and one for latitude, "lat".
inline std::string axis_name(std::string name) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (name == "longitude" || name == "lng" || name == "long") return "lon";
  return name == "latitude" ? "lat" : name;
}

/// The columns of positions: x and y, or longitude and latitude, whichever pair is complete first; else the first two.
inline std::pair<std::size_t, std::size_t> position_columns(const std::vector<std::string>& names) {
  const auto find = [&](std::string_view axis) {
    const auto is_it = [&](const std::string& name) { return axis_name(name) == axis; };
    return static_cast<std::size_t>(std::find_if(names.begin(), names.end(), is_it) - names.begin());
  };
  const auto last = [](const auto& pair) { return std::max(pair.first, pair.second); };
  const std::pair plane(find("x"), find("y")), sphere(find("lon"), find("lat"));
  const std::pair first = last(plane) <= last(sphere) ? plane : sphere;
  return last(first) < names.size() ? first : std::pair<std::size_t, std::size_t>(0, 1);
}

/// Which way a column of positions runs.
enum class Along { plane, longitude, latitude };

inline Along along(const std::string& name, const std::string& unit, Along if_degrees) {
  const std::string axis = axis_name(name);
  if (axis == "lon") return Along::longitude;
  if (axis == "lat") return Along::latitude;
  return unit.starts_with("deg") || unit.starts_with("°") ? if_degrees : Along::plane;
}

}  // namespace detail

/// Makes samples of a table: positions in the columns named x and y, or longitude and latitude (or lon, lat; in any
/// case and order; whichever pair is complete first), else in its first two; values in `column` (default: the last one
/// of the others). `unit_of` tells the unit of a column, or "".
///
/// Longitude and latitude (known by their names, or by units in degrees) become lengths on the plane: x = longitude
/// cos(latitude of the middle), y = latitude, in degrees of a meridian. Rows without a value stay, as blanks. Throws
/// Error, with the line, for a missing position, an impossible latitude, or a column that is no number.
template <class UnitOf>
FieldSamples field_samples(const CsvTable& table, const std::optional<std::string>& column, const UnitOf& unit_of) {
  if (table.columns() < 3)
    throw Error(table.where(), concat(table.columns(), " columns"), "x, y and at least one column of values");
  const auto named = [&](std::size_t i) { return concat("'", printable(table.names()[i], 40), "'"); };
  const auto [a, b] = detail::position_columns(table.names());
  std::size_t last = table.columns() - 1;
  while (last == a || last == b) --last;
  const std::size_t index = column ? table.find(*column) : last;
  if (index == a || index == b)
    throw Error(table.where(), concat("column ", named(index), " holds positions"), "a column of values");

  const auto kind = [&](std::size_t i, detail::Along if_degrees) {
    return detail::along(table.names()[i], unit_of(table.names()[i]), if_degrees);
  };
  const detail::Along first = kind(a, detail::Along::longitude), second = kind(b, detail::Along::latitude);
  const std::span<const double> x = table.column(a), y = table.column(b), values = table.column(index);
  if ((first == detail::Along::longitude) != (second == detail::Along::latitude))
    throw Error(table.where(), concat("columns ", named(a), " and ", named(b)),
                "both or neither in degrees of longitude and latitude");
  const bool geographic = first == detail::Along::longitude;

  double south = 90, north = -90;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto refuse = [&](std::string_view what, std::string_view expected) {
      throw Error(concat(table.where(), ":", table.line(row)), what, expected);
    };
    if (std::isnan(x[row]) || std::isnan(y[row]))
      refuse("a position is missing", concat("numbers in columns ", named(a), " and ", named(b)));
    if (!geographic) continue;
    if (std::abs(x[row]) > 360) refuse(concat("longitude ", x[row]), "-360 to 360 degrees");
    if (std::abs(y[row]) > 90) refuse(concat("latitude ", y[row]), "-90 to 90 degrees");
    south = std::min(south, y[row]);
    north = std::max(north, y[row]);
  }
  FieldSamples out{{}, {table.names()[index], unit_of(table.names()[index])}};
  if (geographic) out.latitude_deg = (south + north) / 2;
  const double east = geographic ? std::cos(deg(*out.latitude_deg)) : 1.0;
  out.samples.reserve(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) out.samples.push_back({{east * x[row], y[row]}, values[row]});
  return out;
}

/// Reads the samples of a field from a CSV file, and the units from the JSON file beside it if there is one.
inline FieldSamples read_field(const std::filesystem::path& path, const std::optional<std::string>& column = {},
                               const CsvLimits& limits = {}) {
  const detail::Units units(std::filesystem::path(path).replace_extension(".json"));
  return field_samples(read_csv(path, limits), column, [&](const std::string& name) { return units.of(name); });
}

}  // namespace vantage
