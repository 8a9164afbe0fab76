// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vantage/geometry/scalar_field.hpp>
#include <vantage/io/field_file.hpp>
#include <vantage/mission/text.hpp>
#include <vantage/sim/random_field.hpp>
#include <vantage/sim/sampled_field.hpp>

#include "options.hpp"

namespace field {

/// What is to be mapped.
struct Input {
  ScalarField truth;
  std::vector<FieldSample> held_out;        ///< scattered data: where the map is judged
  std::string name, note;                   ///< note: how it came to its place, for the report
  std::optional<double> scale = {};         ///< of a file: metres of the flight area per unit of its positions
  std::optional<double> latitude_deg = {};  ///< see FieldSamples
};

/// A rectangle of the field's proportions whose longer side is `side_m`: a grid fills it, nothing is masked for its
/// shape.
inline Box2 flight_area(const FieldSamples& data, double side_m) {
  Box2 extent;
  for (const FieldSample& s : data.samples)
    if (s.position.allFinite()) extent.extend(s.position);
  Eigen::Vector2d size = extent.isEmpty() ? Eigen::Vector2d::Ones() : Eigen::Vector2d(extent.sizes());
  const double longer = size.maxCoeff();
  size =
      (longer > 0 && std::isfinite(longer) ? Eigen::Vector2d(size / longer) : Eigen::Vector2d::Ones()).cwiseMax(0.05) *
      side_m;
  return {Eigen::Vector2d::Zero(), size};
}

inline Input sampled(const std::filesystem::path& file, const Options& o) {
  const FieldSamples data = read_field(file, o.column);
  SampledField f = sampled_field(data, Rng(o.seed).fork(2), {.area_m = flight_area(data, o.side_m)});
  const std::size_t held = f.held_out.size();
  std::string note = f.gridded
                         ? "A grid of samples, interpolated bilinearly."
                         : concat("Scattered samples, interpolated linearly between neighbours; the error is measured ",
                                  held > 0 ? concat("at ", held, " samples that were held out.")
                                           : "against this interpolation: no held-out sample lies between the others.");
  note +=
      concat(" Their bounding box is fitted into the flight area, both axes by the same scale: ", short_number(f.scale),
             " m per ",
             data.latitude_deg ? concat("degree of latitude, where x is longitude times the cosine of ",
                                        short_number(*data.latitude_deg), " degrees.")
                               : "unit of their positions.");
  if (f.truth.valid_pixels() < f.truth.rows() * f.truth.columns())
    note += " Where there are no data the field is masked.";
  return {std::move(f.truth), std::move(f.held_out), file.stem().string(), std::move(note), f.scale, data.latitude_deg};
}

inline Input random(std::uint64_t seed, const Options& o) {
  return {random_field(Rng(seed), {.area_m = Box2(Eigen::Vector2d::Zero(), Eigen::Vector2d::Constant(o.side_m))}),
          {},
          "random_field_" + std::to_string(seed),
          "A Gaussian random field, scaled to [0, 1]."};
}

/// Where examples/data/fetch_fields puts the real fields.
inline std::filesystem::path default_field() {
  return std::filesystem::path(__FILE__).parent_path().parent_path() / "data" / "fields" / "volcano_elevation.csv";
}

/// The file that was asked for, else a random field if that was, else the volcano if it is there, else a random field
/// with a note.
inline Input load(const Options& o) {
  if (!o.file.empty()) return sampled(o.file, o);
  if (o.random) return random(*o.random, o);
  if (std::filesystem::exists(default_field())) return sampled(default_field(), o);
  Input input = random(o.seed, o);
  input.note += " No real field was at hand: examples/data/fetch_fields gets some when there is a network.";
  return input;
}

}  // namespace field
