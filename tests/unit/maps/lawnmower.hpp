// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/geometry/field_image.hpp>

namespace vantage::testing_ {

/// A smooth field over 20 m x 20 m with values in [0, 1] and one region above 0.7.
inline double hill(double x, double y) {
  const double a = (x - 14) * (x - 14) + (y - 6) * (y - 6), b = (x - 5) * (x - 5) + (y - 14) * (y - 14);
  return 0.15 + 0.8 * std::exp(-a / 18) + 0.3 * std::exp(-b / 30);
}

/// 16 noisy images of it, 20 x 20 pixels from 2.5 m, that cover it once.
inline std::vector<FieldImage> lawnmower(double deviation, std::uint64_t seed) {
  std::vector<FieldImage> images(16);
  Rng rng(seed);
  for (int step = 0; step < 16; ++step) {
    const int row = step / 4, column = row % 2 ? 3 - step % 4 : step % 4;
    FieldImage& image = images[static_cast<std::size_t>(step)];
    image.view = nadir(2.5 + 5 * column, 2.5 + 5 * row, 2.5);
    image.footprint = NadirSensor{}.footprint(image.view);
    image.values.resize(20, 20);
    for (int r = 0; r < 20; ++r)
      for (int c = 0; c < 20; ++c)
        image.values(r, c) = hill(5 * column + 0.25 * (c + 0.5), 5 * row + 0.25 * (r + 0.5)) + deviation * rng.normal();
  }
  return images;
}

}  // namespace vantage::testing_
