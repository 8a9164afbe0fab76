// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/maps/surfel/surfels.hpp>

namespace vantage {

/// Learning rates a kind of parameter; Adam's own numbers are fixed, but for epsilon.
struct LearningRates {
  double position = 5e-4;  ///< [m]
  double rotation = 5e-4;
  double log_scale = 0.01;
  double colour = 1e-4;
  double logit = 0.01;  ///< of the opacity
  double epsilon = 1e-15;

  void validate() const {
    Check check("LearningRates");
    check.not_negative("position", position);
    check.not_negative("rotation", rotation);
    check.not_negative("log_scale", log_scale);
    check.not_negative("colour", colour);
    check.not_negative("logit", logit);
    check.positive("epsilon", epsilon);
    check.done();
  }
  [[nodiscard]] double of(std::size_t parameter) const {
    using namespace surfel;
    return parameter < qw              ? position
           : parameter < log_scale_x   ? rotation
           : parameter < red           ? log_scale
           : parameter < surfel::logit ? colour
                                       : this->logit;
  }
};

/// Adam (Kingma and Ba, ICLR 2015; betas 0.9 and 0.999) on the surfels that were touched since it was made anew. One
/// that never was has moments of 0 and does not move, so that this is exactly Adam on all of them; the work is done by
/// whole blocks of surfels that hold a touched one. 104 bytes a surfel.
class SurfelAdam {
 public:
  static constexpr std::size_t block = 256;  ///< surfels that are stepped together

  explicit SurfelAdam(const LearningRates& rates = {}) : rates_(rates) { rates.validate(); }

  /// Forgets everything: for n surfels. O(surfels touched before), if there were as many.
  void restart(std::size_t n) {
    steps_ = 0;
    const std::size_t blocks = (n + block - 1) / block;
    if (first_[0].size() != blocks * block) {
      for (auto* moments : {&first_, &second_})
        for (auto& m : *moments) m.assign(blocks * block, 0);
    } else {
      for (std::size_t b = 0; b < blocks; ++b) {
        if (!awake_[b]) continue;
        for (auto* moments : {&first_, &second_})
          for (auto& m : *moments) std::fill_n(m.begin() + static_cast<std::ptrdiff_t>(b * block), block, 0.0F);
      }
    }
    awake_.assign(blocks, 0);
  }

  /// One step down the gradient of as many surfels. Concurrently, by blocks.
  void step(Surfels& surfels, const SurfelGradient& gradient) {
    ++steps_;
    for (const std::uint32_t i : gradient.touched) awake_[i / block] = 1;
    const double unbias1 = 1 / (1 - std::pow(beta1, steps_)), unbias2 = 1 / (1 - std::pow(beta2, steps_));
    parallel_for(awake_.size(), [&](std::size_t b) {
      if (!awake_[b]) return;
      const std::size_t begin = b * block, count = std::min(block, surfels.size() - begin);
      for (std::size_t p = 0; p < surfel::parameters; ++p) {
        const float* const g = gradient.parameter[p].data() + begin;
        float *const m = first_[p].data() + begin, *const v = second_[p].data() + begin,
                     *const x = surfels.parameter[p].data() + begin;
        const auto rate = static_cast<float>(rates_.of(p) * unbias1);
        std::size_t i = 0;
        for (; i + lanes <= count; i += lanes) step(g + i, m + i, v + i, x + i, rate, static_cast<float>(unbias2));
        if (i == count) continue;
        std::array<float, lanes> last_g{}, last_x{};
        std::copy(g + i, g + count, last_g.begin());
        std::copy(x + i, x + count, last_x.begin());
        step(last_g.data(), m + i, v + i, last_x.data(), rate, static_cast<float>(unbias2));
        std::copy_n(last_x.begin(), count - i, x + i);
      }
    });
  }

 private:
  static constexpr std::size_t lanes = 16;
  static constexpr double beta1 = 0.9, beta2 = 0.999;

  // Sixteen at once wherever they lie: which are computed together must not depend on where memory was found, since a
  // vector's square root may round otherwise than a number's.
  void step(const float* gradient, float* first, float* second, float* parameter, float rate, float unbias2) const {
    using Sixteen = Eigen::Array<float, lanes, 1>;
    const Eigen::Map<const Sixteen> g(gradient);
    Eigen::Map<Sixteen> m(first), v(second), x(parameter);
    m = static_cast<float>(beta1) * m + static_cast<float>(1 - beta1) * g;
    v = static_cast<float>(beta2) * v + static_cast<float>(1 - beta2) * g.square();
    x -= rate * m / ((unbias2 * v).sqrt() + static_cast<float>(rates_.epsilon));
  }

  LearningRates rates_;
  int steps_ = 0;
  std::array<std::vector<float>, surfel::parameters> first_, second_;
  std::vector<std::uint8_t> awake_;  // by block
};

}  // namespace vantage
