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

// Eigen computes a row without vectors as soon as an expression compares, so comparisons stand alone, as loops that
// compilers vectorise.

/// 1 where a row is above a bound, else 0 (also for NaN). Rows of n, apart or the same.
template <class T>
void mark_above(const T* from, T bound, Eigen::Index n, T* to) {
  for (Eigen::Index i = 0; i < n; ++i) to[i] = from[i] > bound ? T(1) : T(0);
}
/// -1, 0 or 1.
template <class T>
void take_sign(const T* from, Eigen::Index n, T* to) {
  for (Eigen::Index i = 0; i < n; ++i) to[i] = (from[i] > 0 ? T(1) : T(0)) - (from[i] < 0 ? T(1) : T(0));
}

}  // namespace vantage
