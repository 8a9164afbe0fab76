// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/maps/surfel/rasteriser.hpp>

namespace vantage::test {

/// n surfels of all sizes, opacities and directions in a box before, beside and behind `any_raster_view`.
inline Surfels any_surfels(std::size_t n, std::uint64_t seed) {
  Rng rng(seed);
  Surfels s;
  for (std::size_t i = 0; i < n; ++i) {
    Surfel one;
    auto& p = one.parameter;
    const auto uniform = [&](double low, double high) { return static_cast<float>(rng.uniform(low, high)); };
    p[surfel::x] = uniform(-2, 2);
    p[surfel::y] = uniform(-2, 2);
    p[surfel::z] = uniform(-2, 4);
    for (const auto q : {surfel::qw, surfel::qx, surfel::qy, surfel::qz}) p[q] = static_cast<float>(rng.normal());
    p[surfel::log_scale_x] = uniform(-1, 2.5);
    p[surfel::log_scale_y] = uniform(-1, 2.5);
    for (const auto c : {surfel::red, surfel::green, surfel::blue}) p[c] = uniform(0, 1);
    p[surfel::logit] = uniform(-3, 6);
    one.confidence = uniform(0, 1);
    s.push_back(one);
  }
  s.scale = {0.02F, 0.2F};
  return s;
}

/// The surfels of a table: their parameters first, in their order, and their `confidence`.
inline Surfels surfels_of(const CsvTable& t) {
  Surfels s;
  for (std::size_t i = 0; i < t.rows(); ++i) {
    Surfel one;
    for (std::size_t p = 0; p < surfel::parameters; ++p) one.parameter[p] = static_cast<float>(t.column(p)[i]);
    one.confidence = static_cast<float>(t.column("confidence")[i]);
    s.push_back(one);
  }
  return s;
}

/// Along z from two metres behind the middle of `any_surfels`, off the axis, with unequal focal lengths.
inline RasterView any_raster_view(int width, int height) {
  RasterView v;
  v.view.T_W_C.linear() = Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  v.view.T_W_C.translation() << 0.1, -0.2, -1.5;
  v.camera = {width, height, 0.8 * width, 0.9 * width, 0.45 * width, 0.55 * height};
  v.background = {0.1F, 0.2F, 0.3F};
  return v;
}

}  // namespace vantage::test
