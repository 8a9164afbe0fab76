// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cctype>
#include <cmath>
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

// Fields from files: a CSV table whose first two columns are positions, and beside it, if there is one, a JSON file of
// the same name that tells the columns' units: {"units": {"x": "m", "elevation": "m"}}.
namespace vantage {

namespace detail {

/// The unit of a column by the JSON companion, or "".
class Units {
 public:
  explicit Units(const std::filesystem::path& file) {
    if (!std::filesystem::exists(file)) return;
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

/// Which way a column of positions runs.
enum class Along { plane, longitude, latitude };

inline Along along(std::string name, const std::string& unit, Along if_degrees) {
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (name == "lon" || name == "longitude" || name == "lng" || name == "long") return Along::longitude;
  if (name == "lat" || name == "latitude") return Along::latitude;
  return unit.starts_with("deg") || unit.starts_with("°") ? if_degrees : Along::plane;
}

}  // namespace detail

/// Makes samples of a table: positions in its first two columns, values in `column` (default: the last one). `unit_of`
/// tells the unit of a column, or "".
///
/// Longitude and latitude (known by their names, in either order, or by units in degrees) become lengths on the plane:
/// x = longitude cos(latitude of the middle), y = latitude, in degrees of a meridian. Rows without a value stay, as
/// blanks. Throws Error, with the line, for a missing position, an impossible latitude, or a column that is no number.
template <class UnitOf>
FieldSamples field_samples(const CsvTable& table, const std::optional<std::string>& column, const UnitOf& unit_of) {
  if (table.columns() < 3)
    throw Error(table.where(), concat(table.columns(), " columns"), "x, y and at least one column of values");
  const std::size_t index = column ? table.find(*column) : table.columns() - 1;
  if (index < 2)
    throw Error(table.where(), concat("column '", table.names()[index], "' holds positions"),
                "a column of values: the third or a later one");

  const auto kind = [&](std::size_t i, detail::Along if_degrees) {
    return detail::along(table.names()[i], unit_of(table.names()[i]), if_degrees);
  };
  detail::Along first = kind(0, detail::Along::longitude), second = kind(1, detail::Along::latitude);
  std::span<const double> x = table.column(std::size_t{0}), y = table.column(std::size_t{1});
  if (first == detail::Along::latitude && second == detail::Along::longitude) std::swap(x, y), std::swap(first, second);
  const std::span<const double> values = table.column(index);
  if ((first == detail::Along::longitude) != (second == detail::Along::latitude))
    throw Error(table.where(), concat("columns '", table.names()[0], "' and '", table.names()[1], "'"),
                "both or neither in degrees of longitude and latitude");
  const bool geographic = first == detail::Along::longitude;

  double south = 90, north = -90;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto refuse = [&](std::string_view what, std::string_view expected) {
      throw Error(concat(table.where(), ":", table.line(row)), what, expected);
    };
    if (std::isnan(x[row]) || std::isnan(y[row])) refuse("a position is missing", "numbers in the first two columns");
    if (!geographic) continue;
    if (std::abs(x[row]) > 360) refuse(concat("longitude ", x[row]), "-360 to 360 degrees");
    if (std::abs(y[row]) > 90) refuse(concat("latitude ", y[row]), "-90 to 90 degrees");
    south = std::min(south, y[row]);
    north = std::max(north, y[row]);
  }
  const double east = geographic ? std::cos(deg((south + north) / 2)) : 1.0;

  FieldSamples out{{}, {table.names()[index], unit_of(table.names()[index])}};
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
