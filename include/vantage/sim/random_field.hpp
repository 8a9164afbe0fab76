// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <complex>
#include <vector>

#include <Eigen/Core>
#include <unsupported/Eigen/FFT>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/scalar_field.hpp>

namespace vantage {

/// A Gaussian random field: its size, and how fast its spectrum falls.
struct RandomFieldConfig {
  Box2 area_m = {Eigen::Vector2d(0, 0), Eigen::Vector2d(20, 20)};
  int columns = 400, rows = 400;  ///< 2 to 16384 each; lengths whose factors are 2, 3 and 5 are fastest
  double exponent = 3;            ///< amplitudes fall with |k|^-exponent; 0 (white noise) to 16

  void validate() const {
    Check check("RandomFieldConfig");
    check(columns >= 2 && columns <= 16384, "columns", columns, "2 to 16384");
    check(rows >= 2 && rows <= 16384, "rows", rows, "2 to 16384");
    check(exponent >= 0 && exponent <= 16, "exponent", exponent, "0 to 16");
    check(!area_m.isEmpty() && area_m.sizes().allFinite() && area(area_m) > 0, "area_m", area(area_m),
          "finite and > 0 m^2");
    check.done();
  }
};

namespace detail {

using Spectrum = Eigen::Array<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Fourier transform of every row, forward or back. Rows go in blocks of fixed size: same bits with any thread count.
inline void transform_rows(Spectrum& s, bool forward) {
  parallel_for_blocks(static_cast<std::size_t>(s.rows()), 32, [&](std::size_t begin, std::size_t end) {
    Eigen::FFT<double> fft;  // holds the plan of one length; not to be shared
    std::vector<std::complex<double>> in(static_cast<std::size_t>(s.cols())), out(in.size());
    for (std::size_t row = begin; row < end; ++row) {
      auto line = s.row(static_cast<Eigen::Index>(row));
      std::copy(line.begin(), line.end(), in.begin());
      forward ? fft.fwd(out, in) : fft.inv(out, in);
      std::copy(out.begin(), out.end(), line.begin());
    }
  });
}

inline void transform(Spectrum& s, bool forward) {
  transform_rows(s, forward);
  Spectrum t = s.transpose();
  transform_rows(t, forward);
  s = t.transpose();
}

}  // namespace detail

/// A Gaussian random field as the thesis makes them (section 3.2.1): white noise, its Fourier transform multiplied by
/// |k|^-3 (k: whole waves along the field's longer side; mean 0), back, and scaled to [0, 1], both ends reached.
/// Periodic along both axes; the same bits for a seed, with any number of threads. O(n log n).
inline ScalarField random_field(const Rng& rng, const RandomFieldConfig& config = {}) {
  config.validate();
  const Eigen::Index rows = config.rows, columns = config.columns;
  detail::Spectrum s(rows, columns);
  parallel_for(static_cast<std::size_t>(rows), [&](std::size_t row) {
    Rng line = rng.fork(row);
    for (Eigen::Index column = 0; column < columns; ++column) s(static_cast<Eigen::Index>(row), column) = line.normal();
  });

  detail::transform(s, true);
  const Eigen::Vector2d waves =
      Eigen::Vector2d::Constant(config.area_m.sizes().maxCoeff()).cwiseQuotient(config.area_m.sizes());
  const auto frequency = [](Eigen::Index i, Eigen::Index n) { return static_cast<double>(2 * i <= n ? i : i - n); };
  for (Eigen::Index row = 0; row < rows; ++row)
    for (Eigen::Index column = 0; column < columns; ++column) {
      const double k = std::hypot(frequency(column, columns) * waves.x(), frequency(row, rows) * waves.y());
      s(row, column) *= k > 0 ? std::pow(k, -config.exponent) : 0.0;
    }
  detail::transform(s, false);

  Image<double> values = s.real();
  const double low = values.minCoeff(), high = values.maxCoeff();
  values = (values - low) / (high - low);
  return {config.area_m, std::move(values), {"value", ""}};
}

}  // namespace vantage
