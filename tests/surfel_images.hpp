// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>

#include <Eigen/Core>

#include <vantage/geometry/image.hpp>

// Images of any scalar, as the loss of a surfel map takes them.
namespace vantage::test {

template <class T>
struct SurfelImages {
  Image<T> r, g, b, depth, opacity, x, y, z;
};

template <class T>
struct SurfelGradientImages {
  struct {
    Image<T> r, g, b;
  } colour;
  Image<T> depth, normal_x, normal_y, normal_z;
};

/// What was measured: three planes of colour, and depth, 0 where there is none.
template <class T>
struct ColourDepth {
  std::array<Image<T>, 3> planes;
  Image<T> metres;

  void colour(int channel, Eigen::Index row, T* out) const {
    const Image<T>& p = planes[static_cast<std::size_t>(channel)];
    std::copy_n(p.data() + row * p.cols(), p.cols(), out);
  }
  void depth(Eigen::Index row, T* out) const { std::copy_n(metres.data() + row * metres.cols(), metres.cols(), out); }
};

}  // namespace vantage::test
