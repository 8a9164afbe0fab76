// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vantage {

/// What is trained of a surfel, as the optimiser sees it: position [m], a quaternion of any length, the logarithms of
/// the scales over SurfelScale::unit_m, colour, and the logit of the opacity.
namespace surfel {
enum Parameter : std::size_t { x, y, z, qw, qx, qy, qz, log_scale_x, log_scale_y, red, green, blue, logit };
inline constexpr std::size_t parameters = 13;
}  // namespace surfel

/// One surfel: a flat Gaussian of a surface (section 6.1.1). Its normal is the third axis of its rotation.
struct Surfel {
  std::array<float, surfel::parameters> parameter{};
  float confidence = 0;  ///< k_i (eq. 6.6); never trained
};

/// From a trained logarithm to a scale: s = min(unit_m exp(raw), max_m).
struct SurfelScale {
  float unit_m = 0.01F;  ///< > 0
  float max_m = 0.05F;   ///< > 0, infinity for none
};

/// Surfels as a structure of arrays, so that a kernel loads of 16 of them one parameter at once.
struct Surfels {
  std::array<std::vector<float>, surfel::parameters> parameter;
  std::vector<float> confidence;
  SurfelScale scale = {};

  [[nodiscard]] std::size_t size() const { return confidence.size(); }
  [[nodiscard]] Surfel operator[](std::size_t i) const {
    Surfel s{.confidence = confidence[i]};
    for (std::size_t p = 0; p < surfel::parameters; ++p) s.parameter[p] = parameter[p][i];
    return s;
  }
  void push_back(const Surfel& s) {
    for (std::size_t p = 0; p < surfel::parameters; ++p) parameter[p].push_back(s.parameter[p]);
    confidence.push_back(s.confidence);
  }
};

/// Derivatives of a loss by the trained parameters of surfels: those that a rendering touched, the rest are 0.
struct SurfelGradient {
  std::array<std::vector<float>, surfel::parameters> parameter;  ///< one number a surfel
  std::vector<std::uint32_t> touched;                            ///< ascending, each once

  /// Zero, for n surfels. O(touched) if there were as many before.
  void reset(std::size_t n);

  std::vector<std::uint8_t> is_touched;
};

inline void SurfelGradient::reset(std::size_t n) {
  if (is_touched.size() == n) {
    for (const std::uint32_t i : touched) {
      for (auto& values : parameter) values[i] = 0;
      is_touched[i] = 0;
    }
  } else {
    for (auto& values : parameter) values.assign(n, 0);
    is_touched.assign(n, 0);
  }
  touched.clear();
}

}  // namespace vantage
