// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>

// What the field kernels run on: the mission of section 3.2.1, 16 images of a Gaussian random field.
namespace bench {

using Sensor = vantage::CellSensor<vantage::DeviationGrowsWithHeight>;

/// Images along a lawnmower over 20 m x 20 m, 2.5 m high, 5 m apart; noise of deviation 0.05 h.
inline const std::vector<vantage::FieldImage>& images() {
  static const std::vector<vantage::FieldImage> all = [] {
    vantage::FieldWorld world(vantage::random_field(vantage::Rng(1)), vantage::DeviationByHeight{0.05},
                              vantage::Rng(2));
    std::vector<vantage::FieldImage> out;
    for (int row = 0; row < 4; ++row)
      for (int k = 0; k < 4; ++k)
        out.push_back(*world.observe(vantage::nadir(2.5 + 5 * (row % 2 ? 3 - k : k), 2.5 + 5 * row, 2.5)));
    return out;
  }();
  return all;
}

/// A map with 2^depth cells an axis for those images.
template <class Gp>
typename Gp::Config config(int depth) {
  typename Gp::Config c;
  c.tree.depth = depth;
  c.sensor.alpha = 0.05;
  return c;
}

template <class Gp>
Gp flown(int depth, std::size_t measurements = 16) {
  Gp map(config<Gp>(depth));
  vantage::Rng rng;
  for (std::size_t i = 0; i < measurements; ++i) map.integrate(images()[i], rng);
  return map;
}

}  // namespace bench
