// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/colour_image.hpp>
#include <vantage/geometry/image.hpp>

// How good pictures and depth images are. The same bits with any number of threads.
namespace vantage {

/// Which pixels count; an empty mask: all.
using Mask = Image<bool>;

namespace image_metrics {

template <class A, class B>
void check_sizes(std::string_view where, const A& a, const B& b, const Mask& mask = {}) {
  if (a.rows() == 0 || a.cols() == 0) throw Error(where, "an image is empty", "at least one pixel");
  if (a.rows() != b.rows() || a.cols() != b.cols())
    throw Error(where, concat("images of ", a.cols(), " x ", a.rows(), " and ", b.cols(), " x ", b.rows(), " px"),
                "the same size");
  if (mask.size() != 0 && (mask.rows() != a.rows() || mask.cols() != a.cols()))
    throw Error(where, concat("a mask of ", mask.cols(), " x ", mask.rows(), " px"),
                concat("the images' ", a.cols(), " x ", a.rows(), ", or none"));
}

struct SquaredError {
  double sum = 0;
  std::size_t values = 0;
  SquaredError& operator+=(const SquaredError& s) {
    sum += s.sum;
    values += s.values;
    return *this;
  }
};

inline SquaredError squared_error(const Image<float>& a, const Image<float>& b, const Mask& mask) {
  return parallel_sum(static_cast<std::size_t>(a.size()), 1 << 14, SquaredError{},
                      [&](std::size_t begin, std::size_t end) {
                        SquaredError s;
                        for (std::size_t i = begin; i < end; ++i) {
                          if (mask.size() != 0 && !mask.data()[i]) continue;
                          const double e = static_cast<double>(a.data()[i]) - static_cast<double>(b.data()[i]);
                          s.sum += e * e;
                          ++s.values;
                        }
                        return s;
                      });
}

inline double psnr_db(std::string_view where, const SquaredError& s) {
  if (s.values == 0) throw Error(where, "the mask has no pixel", "at least one");
  if (!std::isfinite(s.sum)) throw Error(where, "a value is not finite", "finite images");
  return -10 * std::log10(s.sum / static_cast<double>(s.values));
}

/// The 11 weights of a normal distribution with a deviation of 1.5 px, normalised.
inline std::array<float, 11> ssim_window() {
  std::array<double, 11> w{};
  double sum = 0;
  for (int i = 0; i < 11; ++i) sum += w[static_cast<std::size_t>(i)] = std::exp(-0.5 * (i - 5) * (i - 5) / (1.5 * 1.5));
  std::array<float, 11> window{};
  for (std::size_t i = 0; i < 11; ++i) window[i] = static_cast<float>(w[i] / sum);
  return window;
}

/// f(integral_constant<n>, i): chunks of n = 16 that the compiler keeps in registers, then single ones.
template <class F>
void in_chunks(std::size_t size, F&& f) {
  std::size_t i = 0;
  for (; i + 16 <= size; i += 16) f(std::integral_constant<int, 16>(), i);
  for (; i < size; ++i) f(std::integral_constant<int, 1>(), i);
}

template <int N>
using Chunk = Eigen::Array<float, N, 1>;

/// The weighted means of x, y, x^2 + y^2 and x y down N columns of a and b, each `width` after the one before. Of
/// values less one half, which changes no covariance and loses fewer digits in the differences.
template <int N>
void weigh_columns(const std::array<float, 11>& window, const float* a, const float* b, std::size_t width, float* to) {
  Chunk<N> x = Chunk<N>::Zero(), y = x, xx_yy = x, xy = x;
  for (std::size_t t = 0; t < 11; ++t) {
    const Chunk<N> p = Eigen::Map<const Chunk<N>>(a + t * width) - 0.5F;
    const Chunk<N> q = Eigen::Map<const Chunk<N>>(b + t * width) - 0.5F;
    x += window[t] * p;
    y += window[t] * q;
    xx_yy += window[t] * (p * p + q * q);
    xy += window[t] * (p * q);
  }
  for (const Chunk<N>* mean : {&x, &y, &xx_yy, &xy}) {
    Eigen::Map<Chunk<N>> out(to);
    out = *mean;
    to += width;
  }
}

/// The similarity of N windows in a row, from what weigh_columns left.
template <int N>
void similarity(const std::array<float, 11>& window, const float* columns, std::size_t width, float* to) {
  std::array<Chunk<N>, 4> mean;
  for (Chunk<N>& m : mean) {
    m = Chunk<N>::Zero();
    for (std::size_t t = 0; t < 11; ++t) m += window[t] * Eigen::Map<const Chunk<N>>(columns + t);
    columns += width;
  }
  constexpr float c1 = 0.01F * 0.01F, c2 = 0.03F * 0.03F;
  const auto& [x, y, xx_yy, xy] = mean;
  const Chunk<N> u = x + 0.5F, v = y + 0.5F, variances = xx_yy - x * x - y * y, covariance = xy - x * y;
  Eigen::Map<Chunk<N>> out(to);
  out = (2 * u * v + c1) * (2 * covariance + c2) / ((u * u + v * v + c1) * (variances + c2));
}

}  // namespace image_metrics

/// Peak signal-to-noise ratio [dB] of images in [0, 1]: -10 log10 of the mean squared difference; infinite for equal
/// images. Throws Error for images of different sizes or none, values that are not finite, or a mask without a pixel.
inline double psnr(const Image<float>& a, const Image<float>& b, const Mask& mask = {}) {
  image_metrics::check_sizes("psnr", a, b, mask);
  return image_metrics::psnr_db("psnr", image_metrics::squared_error(a, b, mask));
}
/// The same of colour images: the mean is over pixels and colours.
inline double psnr(const ColourImage& a, const ColourImage& b, const Mask& mask = {}) {
  image_metrics::SquaredError s;
  for (const auto& [x, y] : {std::pair{&a.r, &b.r}, std::pair{&a.g, &b.g}, std::pair{&a.b, &b.b}}) {
    image_metrics::check_sizes("psnr", *x, *y, mask);
    s += image_metrics::squared_error(*x, *y, mask);
  }
  return image_metrics::psnr_db("psnr", s);
}

/// Structural similarity of images in [0, 1], in [-1, 1] (Wang et al., "Image quality assessment: from error visibility
/// to structural similarity", IEEE TIP 2004): 11 x 11 Gaussian window with a deviation of 1.5 px, K1 = 0.01,
/// K2 = 0.03, population covariances, mean over the pixels whose window lies inside. As scikit-image's
/// structural_similarity(gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1). Throws Error for
/// images of different sizes, smaller than 11 x 11, or with values that are not finite. Separable: O(pixels x 22).
inline double ssim(const Image<float>& a, const Image<float>& b) {
  image_metrics::check_sizes("ssim", a, b);
  constexpr Eigen::Index taps = 11;
  if (a.rows() < taps || a.cols() < taps)
    throw Error("ssim", concat("images of ", a.cols(), " x ", a.rows(), " px"), "11 x 11 px at least");
  const std::array<float, 11> window = image_metrics::ssim_window();
  const auto width = static_cast<std::size_t>(a.cols()), out_width = width - taps + 1;
  const auto out_rows = static_cast<std::size_t>(a.rows() - taps + 1);
  const double sum = parallel_sum(out_rows, 16, 0.0, [&](std::size_t begin, std::size_t end) {
    double strip = 0;
    std::vector<float> columns(4 * width), row_of_similarity(out_width);
    for (std::size_t row = begin; row < end; ++row) {
      image_metrics::in_chunks(width, [&](auto chunk, std::size_t i) {
        image_metrics::weigh_columns<chunk()>(window, a.data() + row * width + i, b.data() + row * width + i, width,
                                              columns.data() + i);
      });
      image_metrics::in_chunks(out_width, [&](auto chunk, std::size_t i) {
        image_metrics::similarity<chunk()>(window, columns.data() + i, width, row_of_similarity.data() + i);
      });
      for (const float s : row_of_similarity) strip += static_cast<double>(s);
    }
    return strip;
  });
  if (!std::isfinite(sum)) throw Error("ssim", "a value is not finite", "finite images");
  return sum / static_cast<double>(out_rows * out_width);
}
/// The mean over the three colours.
inline double ssim(const ColourImage& a, const ColourImage& b) {
  return (ssim(a.r, b.r) + ssim(a.g, b.g) + ssim(a.b, b.b)) / 3;
}

/// How good a depth image is, over the pixels where the truth has a value.
struct DepthMetrics {
  double rmse_m = 0, mae_m = 0;  ///< over pixels that both know; NaN if there is none
  double known = 0;              ///< share of the truth's pixels where the estimate has a value, [0, 1]
  std::size_t pixels = 0;        ///< that the truth has
};

/// Compares depth images [m], NaN = no value. Throws Error for images of different sizes, infinite values, or if no
/// pixel of the mask has a true value.
inline DepthMetrics depth_metrics(const Image<float>& estimate, const Image<float>& truth, const Mask& mask = {}) {
  image_metrics::check_sizes("depth_metrics", estimate, truth, mask);
  struct Sums {
    double squared = 0, absolute = 0;
    std::size_t both = 0, truth = 0;
    Sums& operator+=(const Sums& s) {
      squared += s.squared;
      absolute += s.absolute;
      both += s.both;
      truth += s.truth;
      return *this;
    }
  };
  const auto n = static_cast<std::size_t>(truth.size());
  const Sums s = parallel_sum(n, 1 << 14, Sums{}, [&](std::size_t begin, std::size_t end) {
    Sums block;
    for (std::size_t i = begin; i < end; ++i) {
      const auto d = static_cast<double>(estimate.data()[i]), t = static_cast<double>(truth.data()[i]);
      if (std::isnan(t) || (mask.size() != 0 && !mask.data()[i])) continue;
      ++block.truth;
      if (std::isnan(d)) continue;
      ++block.both;
      block.squared += (d - t) * (d - t);
      block.absolute += std::abs(d - t);
    }
    return block;
  });
  if (s.truth == 0) throw Error("depth_metrics", "no pixel has a true depth", "at least one");
  if (!std::isfinite(s.squared)) throw Error("depth_metrics", "a depth is infinite", "finite depths, or NaN");
  const auto both = static_cast<double>(s.both);
  const double none = std::numeric_limits<double>::quiet_NaN();
  return {.rmse_m = s.both ? std::sqrt(s.squared / both) : none,
          .mae_m = s.both ? s.absolute / both : none,
          .known = both / static_cast<double>(s.truth),
          .pixels = s.truth};
}

}  // namespace vantage
