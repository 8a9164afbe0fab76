// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include <Eigen/Core>

#include <vantage/core/rng.hpp>

namespace vantage {

/// Standard normal numbers for the pixels of a picture, many at once: a function of the stream, the row and the
/// channel, whoever asks first.
///
/// Philox 4x32 in seven rounds (the fewest that pass all tests: Salmon et al., SC 2011, Table 2), then Box and Muller's
/// transform. Loops over 16 lanes without a branch, for the compiler to vectorise: about 1 ns a number on one core with
/// AVX-512. Const members run concurrently.
class GaussianPixels {
 public:
  /// Takes one number of the stream as its key.
  explicit GaussianPixels(Rng stream) {
    const std::uint64_t key = stream();
    key_ = {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
  }

  /// Fills `out` with independent standard normal numbers. Whole blocks of 64 are made, the last one perhaps in vain.
  void normals(std::uint32_t row, std::uint32_t channel, std::span<float> out) const {
    for (std::size_t i = 0; i < out.size(); i += 4 * lanes) {
      alignas(64) std::array<float, 4 * lanes> block;
      fill(static_cast<std::uint32_t>(i / 4), row, channel, block);
      std::memcpy(out.data() + i, block.data(), sizeof(float) * std::min(block.size(), out.size() - i));
    }
  }

 private:
  static constexpr std::size_t lanes = 16;
  using Words = std::array<std::uint32_t, lanes>;

  void fill(std::uint32_t counter, std::uint32_t row, std::uint32_t channel, std::array<float, 4 * lanes>& out) const {
    alignas(64) Words x0, x1, x2, x3;
    for (std::size_t k = 0; k < lanes; ++k) {
      x0[k] = counter + static_cast<std::uint32_t>(k);
      x1[k] = row;
      x2[k] = channel;
      x3[k] = 0;
    }
    std::uint32_t k0 = key_[0], k1 = key_[1];
    for (int round = 0; round < 7; ++round) {
      alignas(64) std::array<std::uint64_t, lanes> p0, p1;
      for (std::size_t k = 0; k < lanes; ++k) p0[k] = 0xD2511F53ULL * x0[k];
      for (std::size_t k = 0; k < lanes; ++k) p1[k] = 0xCD9E8D57ULL * x2[k];
      for (std::size_t k = 0; k < lanes; ++k) x0[k] = static_cast<std::uint32_t>(p1[k] >> 32) ^ x1[k] ^ k0;
      for (std::size_t k = 0; k < lanes; ++k) x2[k] = static_cast<std::uint32_t>(p0[k] >> 32) ^ x3[k] ^ k1;
      for (std::size_t k = 0; k < lanes; ++k) x1[k] = static_cast<std::uint32_t>(p1[k]);
      for (std::size_t k = 0; k < lanes; ++k) x3[k] = static_cast<std::uint32_t>(p0[k]);
      k0 += 0x9E3779B9U;
      k1 += 0xBB67AE85U;
    }
    box_muller(x0, x1, out.data());
    box_muller(x2, x3, out.data() + 2 * lanes);
  }

  /// sqrt(-2 ln u) (cos, sin)(2 pi v): 16 cosines, then 16 sines.
  static void box_muller(const Words& u, const Words& v, float* out) {
    using Lanes = Eigen::Array<float, lanes, 1>;
    Lanes square, sine, cosine;
    for (Eigen::Index k = 0; k < square.size(); ++k) {
      // ln u with u in (0, 1]: exponent and mantissa m in [1/sqrt 2, sqrt 2), ln m = 2 artanh((m - 1) / (m + 1)).
      const float uniform =
          (static_cast<float>(static_cast<std::int32_t>(u[static_cast<std::size_t>(k)] >> 8)) + 0.5F) * 0x1p-24F;
      const std::uint32_t bits = std::bit_cast<std::uint32_t>(uniform) - 0x3F3504F3U;
      const auto exponent = static_cast<float>(static_cast<std::int32_t>(bits) >> 23);
      const auto m = std::bit_cast<float>((bits & 0x007FFFFFU) + 0x3F3504F3U);
      const float z = (m - 1) / (m + 1), z2 = z * z;
      square[k] = -2 * (exponent * 0.693147181F + 2 * z * (1 + z2 * (1.F / 3 + z2 * (1.F / 5 + z2 * (1.F / 7)))));
      // Taylor's series of sine and cosine at half the angle, in [-pi/2, pi/2).
      const float a = static_cast<float>(static_cast<std::int32_t>(v[static_cast<std::size_t>(k)])) *
                      (1.57079633F * 0x1p-31F),
                  a2 = a * a;
      sine[k] =
          a *
          (1 + a2 * (-1.F / 6 + a2 * (1.F / 120 + a2 * (-1.F / 5040 + a2 * (1.F / 362880 + a2 * (-1.F / 39916800))))));
      cosine[k] =
          1 + a2 * (-1.F / 2 + a2 * (1.F / 24 + a2 * (-1.F / 720 + a2 * (1.F / 40320 + a2 * (-1.F / 3628800)))));
    }
    const Lanes radius = square.max(0.F).sqrt();
    Eigen::Map<Lanes, Eigen::Aligned64> first(out), second(out + lanes);
    first = radius * (1 - 2 * sine.square());  // cos 2a
    second = radius * (2 * sine * cosine);     // sin 2a
  }

  std::array<std::uint32_t, 2> key_;
};

}  // namespace vantage
