// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

#include <Eigen/Core>

#include <vantage/geometry/image.hpp>

namespace vantage {

/// A few rows of several planes, each row with a border on both sides, so that its neighbours to the left and to the
/// right are the same row, shifted. Rows are what the image kernels here compute with: whole rows at once are
/// vectorised whatever the compiler, and stay in the nearest cache.
template <class T>
class PaddedRows {
 public:
  using Row = Eigen::Map<Eigen::Array<T, 1, Eigen::Dynamic>>;
  static constexpr Eigen::Index border = 16;

  /// Rows hold what they held before, if the sizes are the same; otherwise 0.
  void resize(Eigen::Index planes, Eigen::Index rows, Eigen::Index width) {
    const Eigen::Index stride = (width + border - 1) / border * border + 2 * border;
    if (rows_ == rows && width_ == width && data_.rows() == planes * rows) return;
    rows_ = rows;
    width_ = width;
    data_.setZero(planes * rows, stride);
  }
  [[nodiscard]] Eigen::Index width() const { return width_; }
  /// A row of a plane, from column `shift` on; |shift| <= border. The border is 0.
  [[nodiscard]] Row operator()(Eigen::Index plane, Eigen::Index row, Eigen::Index shift = 0) {
    return Row(data_.data() + (plane * rows_ + row) * data_.cols() + border + shift, width_);
  }

 private:
  Eigen::Index rows_ = 0, width_ = 0;
  Image<T> data_;
};

}  // namespace vantage
