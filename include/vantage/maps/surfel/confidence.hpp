// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/parallel.hpp>
#include <vantage/maps/surfel/surfel_normal.hpp>
#include <vantage/maps/surfel/surfels.hpp>

namespace vantage {

/// How sure a map is of a surfel, from where it was seen (section 6.1.3). `numbers` of state a surfel, 0 before it is
/// seen; observe() adds a view, so far away in the direction (unit) that leads from the surfel to it; value() is k, 0
/// for a surfel that was never seen.
template <class C>
concept SurfelConfidence = requires(std::span<double, C::numbers> state, std::span<const double, C::numbers> seen,
                                    const Eigen::Vector3d& unit, double distance_m, double far_m) {
  { C::name } -> std::convertible_to<std::string_view>;
  C::observe(state, unit, unit, distance_m, far_m);  // normal, direction
  { C::value(seen, unit) } -> std::convertible_to<double>;
};

/// The published code: as each view comes, with the normal of then,
///
///     n += 1,  mean += (v - mean) / n,  score += (1 - min(d / d_far, 1)) max(n . v, 0)
///     k = clamp(exp(1 - |mean|) score, 0, 1)
struct IncrementalConfidence {
  static constexpr std::string_view name = "IncrementalConfidence";
  static constexpr std::size_t numbers = 5;  ///< views, mean direction, score

  template <class T>
  static void observe(std::span<T, numbers> s, const Eigen::Matrix<T, 3, 1>& normal, const Eigen::Matrix<T, 3, 1>& v,
                      T distance_m, T far_m) {
    s[0] += 1;
    for (int a = 0; a < 3; ++a)
      s[static_cast<std::size_t>(1 + a)] += (v[a] - s[static_cast<std::size_t>(1 + a)]) / s[0];
    s[4] += (1 - std::clamp<T>(distance_m / far_m, 0, 1)) * std::clamp<T>(normal.dot(v), 0, 1);
  }
  template <class T>
  static T value(std::span<const T, numbers> s, const Eigen::Matrix<T, 3, 1>&) {
    return std::clamp<T>(std::exp(1 - std::sqrt(s[1] * s[1] + s[2] * s[2] + s[3] * s[3])) * s[4], 0, 1);
  }
};

/// Eqs. 6.6 to 6.9: the normal is that of now, for all views; distances are those of then. Not clamped: may be
/// negative, and grows with the views.
struct DispersionConfidence {
  static constexpr std::string_view name = "DispersionConfidence";
  static constexpr std::size_t numbers = 7;  ///< views, sum of v, sum of (1 - d / d_far) v

  template <class T>
  static void observe(std::span<T, numbers> s, const Eigen::Matrix<T, 3, 1>&, const Eigen::Matrix<T, 3, 1>& v,
                      T distance_m, T far_m) {
    const T weight = 1 - distance_m / far_m;
    s[0] += 1;
    for (int a = 0; a < 3; ++a) {
      s[static_cast<std::size_t>(1 + a)] += v[a];
      s[static_cast<std::size_t>(4 + a)] += weight * v[a];
    }
  }
  template <class T>
  static T value(std::span<const T, numbers> s, const Eigen::Matrix<T, 3, 1>& normal) {
    if (!(s[0] > 0)) return 0;
    const T gamma = normal[0] * s[4] + normal[1] * s[5] + normal[2] * s[6];
    return gamma * std::exp(1 - std::sqrt(s[1] * s[1] + s[2] * s[2] + s[3] * s[3]) / s[0]);
  }
};

/// The ablation of section 6.2: k = 1 - exp(-n) after n views.
struct ViewCountConfidence {
  static constexpr std::string_view name = "ViewCountConfidence";
  static constexpr std::size_t numbers = 1;

  template <class T>
  static void observe(std::span<T, numbers> s, const Eigen::Matrix<T, 3, 1>&, const Eigen::Matrix<T, 3, 1>&, T, T) {
    s[0] += 1;
  }
  template <class T>
  static T value(std::span<const T, numbers> s, const Eigen::Matrix<T, 3, 1>&) {
    return -std::expm1(-s[0]);
  }
};

/// A view from `eye` saw the surfels whose weight in it is above `threshold`: updates their state (C::numbers a surfel)
/// and the confidence of all. O(surfels), concurrently.
template <SurfelConfidence C>
void observe(Surfels& surfels, std::vector<float>& state, std::span<const float> weight, float threshold,
             const Eigen::Vector3f& eye, float far_m) {
  parallel_for_blocks(surfels.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::span<float, C::numbers> s(state.data() + i * C::numbers, C::numbers);
      const Eigen::Vector3f normal = normal_of(surfels, i), to_view = eye - position_of(surfels, i);
      const float distance_m = to_view.norm();
      if (weight[i] > threshold && distance_m > 0)
        C::template observe<float>(s, normal, Eigen::Vector3f(to_view / distance_m), distance_m, far_m);
      surfels.confidence[i] = C::template value<float>(s, normal);
    }
  });
}

}  // namespace vantage
