// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/geometry/image.hpp>

namespace vantage {

/// A colour picture as three planes of one size, display-encoded (what an 8-bit picture stores, divided by 255).
struct ColourImage {
  Image<float> r, g, b;  ///< [0, 1]

  [[nodiscard]] Eigen::Index rows() const { return r.rows(); }
  [[nodiscard]] Eigen::Index cols() const { return r.cols(); }
  [[nodiscard]] bool empty() const { return r.size() == 0; }
  void resize(Eigen::Index rows, Eigen::Index cols) {
    for (Image<float>* plane : {&r, &g, &b}) plane->resize(rows, cols);
  }
};

}  // namespace vantage
