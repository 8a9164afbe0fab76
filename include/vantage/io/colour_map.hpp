// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <vantage/core/error.hpp>
#include <vantage/geometry/image.hpp>
#include <vantage/io/png.hpp>

namespace vantage {

/// Viridis (Smith, van der Walt; CC0), t in [0, 1], clamped; linear between 17 of its colours; light grey for NaN. Blue
/// is low, yellow high; the colour-blind and a grey printer read it alike.
inline Rgb viridis(double t) {
  static constexpr std::array<Rgb, 17> colours = {{{68, 1, 84},
                                                   {72, 24, 106},
                                                   {71, 45, 123},
                                                   {66, 64, 134},
                                                   {59, 82, 139},
                                                   {51, 99, 141},
                                                   {44, 114, 142},
                                                   {38, 130, 142},
                                                   {33, 145, 140},
                                                   {31, 159, 136},
                                                   {39, 173, 129},
                                                   {61, 188, 116},
                                                   {92, 200, 99},
                                                   {129, 211, 77},
                                                   {170, 220, 50},
                                                   {213, 226, 26},
                                                   {253, 231, 37}}};
  if (std::isnan(t)) return {224, 224, 224};
  const double at = std::clamp(t, 0.0, 1.0) * static_cast<double>(colours.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), colours.size() - 2);
  const double f = at - static_cast<double>(i);
  Rgb out;
  for (std::size_t k = 0; k < 3; ++k)
    out[k] = static_cast<std::uint8_t>(std::lround((1 - f) * colours[i][k] + f * colours[i + 1][k]));
  return out;
}

/// A raster of a field as a picture with +y up: `low` is blue, `high` yellow, NaN grey; each pixel becomes zoom x zoom
/// of the picture's. Throws Error if low > high, or if the picture would be too large.
inline Picture draw(const Image<double>& values, double low, double high, int zoom = 1) {
  if (!(low <= high)) throw Error("draw", concat("low = ", low, ", high = ", high), "low <= high");
  if (zoom < 1 || values.rows() > 32768 / zoom || values.cols() > 32768 / zoom)
    throw Error("draw", concat(values.rows(), " x ", values.cols(), " pixels, zoom ", zoom),
                "at most 32768 px a side, zoom >= 1");
  Picture picture(static_cast<int>(values.cols()) * zoom, static_cast<int>(values.rows()) * zoom);
  for (int row = 0; row < picture.height(); ++row)
    for (int column = 0; column < picture.width(); ++column) {
      const double v = values(values.rows() - 1 - row / zoom, column / zoom);
      picture(row, column) = viridis(high > low ? (v - low) / (high - low) : v - low);
    }
  return picture;
}

}  // namespace vantage
