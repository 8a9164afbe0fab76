// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <vantage/core/srgb.hpp>
#include <vantage/io/colour_map.hpp>

// Colours for pictures of maps. Values are drawn in viridis (io/colour_map.hpp); what follows is for how sure and how
// wrong a map is, so that no reader takes one kind of picture for another. Straight lines in OKLab with evenly spaced
// lightness, hence perceptually uniform; where sRGB cannot show a colour it is clipped.
namespace vantage {

/// From t in [0, 1] (clamped) to a colour; NaN is light grey.
using Palette = Rgb (*)(double t);

namespace detail {

/// OKLab (Ottosson 2020): lightness in [0, 1], and two opponent axes.
struct Oklab {
  double l, a, b;
};

inline Rgb srgb(const Oklab& c) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(c.l + 0.3963377774 * c.a + 0.2158037573 * c.b);
  const double m = cube(c.l - 0.1055613458 * c.a - 0.0638541728 * c.b);
  const double s = cube(c.l - 0.0894841775 * c.a - 1.2914855480 * c.b);
  const auto encode = [](double x) { return static_cast<std::uint8_t>(std::lround(255 * srgb_encoded(x))); };
  return {encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encode(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

/// The inverse of srgb, for colours that sRGB can show.
inline Oklab oklab(const Rgb& c) {
  const auto decode = [](std::uint8_t x) { return srgb_linear(x / 255.0); };
  const double r = decode(c[0]), g = decode(c[1]), b = decode(c[2]);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

inline Rgb along(std::span<const Oklab> stops, double t) {
  if (std::isnan(t)) return {224, 224, 224};
  const double at = std::clamp(t, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double f = at - static_cast<double>(i);
  const Oklab &p = stops[i], &q = stops[i + 1];
  return srgb({p.l + f * (q.l - p.l), p.a + f * (q.a - p.a), p.b + f * (q.b - p.b)});
}

}  // namespace detail

/// For uncertainty: from near black (sure) by plum to cream (unsure).
inline Rgb plum(double t) {
  static constexpr std::array<detail::Oklab, 3> stops = {
      {{0.16, 0.02, -0.04}, {0.56, 0.14, 0.005}, {0.96, 0.005, 0.045}}};
  return detail::along(stops, t);
}

/// For errors: blue (too low) by white (t = 0.5, right) to red (too high), symmetric in lightness.
inline Rgb blue_white_red(double t) {
  static constexpr std::array<detail::Oklab, 3> stops = {{{0.45, -0.035, -0.15}, {0.97, 0, 0}, {0.45, 0.155, 0.08}}};
  return detail::along(stops, t);
}

/// Colours evenly spread over a palette, for a legend.
inline std::vector<Rgb> colours_of(Palette palette, std::size_t count = 17) {
  std::vector<Rgb> colours;
  for (std::size_t i = 0; i < count; ++i)
    colours.push_back(palette(static_cast<double>(i) / static_cast<double>(count - 1)));
  return colours;
}

}  // namespace vantage
