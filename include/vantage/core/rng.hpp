// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace vantage {

/// Counter-based random numbers (Philox 4x32, 10 rounds: Salmon et al., "Parallel random numbers: as easy as 1, 2, 3",
/// SC 2011): a stream is a key and a counter, so a fork is free, never collides by accident, and results do not depend
/// on which thread draws. Satisfies UniformRandomBitGenerator. A value type of 16 bytes; not shared between threads.
class Rng {
 public:
  using result_type = std::uint64_t;
  constexpr Rng() = default;
  constexpr explicit Rng(std::uint64_t seed) : key_(mix(seed)) {}

  static constexpr result_type min() { return 0; }
  static constexpr result_type max() { return std::numeric_limits<result_type>::max(); }

  constexpr result_type operator()() {
    const std::array<std::uint32_t, 4> block = philox(counter_++);
    return (static_cast<std::uint64_t>(block[1]) << 32) | block[0];
  }

  /// An independent stream, named by `index`; does not advance this one. One per candidate, pixel block or step.
  [[nodiscard]] constexpr Rng fork(std::uint64_t index) const {
    Rng child;
    // The key is mixed once more than the index: otherwise Rng(a).fork(b - 1) would be Rng(b).fork(a - 1).
    child.key_ = mix(mix(key_) ^ mix(counter_ * 0xD1342543DE82EF95ull + index + 1));
    return child;
  }

  /// Uniform in [0, 1).
  constexpr double uniform() { return static_cast<double>((*this)() >> 11) * 0x1.0p-53; }
  /// Uniform in [low, high).
  constexpr double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform in {0, ..., n - 1}, n > 0 (multiply-shift; bias below n / 2^64).
  constexpr std::uint64_t index(std::uint64_t n) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>((static_cast<Wide>((*this)()) * n) >> 64);
  }
  /// Standard normal (Box-Muller, one value a call, so that the stream's position says everything).
  double normal() {
    const double u = 1.0 - uniform(), v = uniform();
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
  }

  /// The whole state, to save and restore a stream.
  [[nodiscard]] constexpr std::array<std::uint64_t, 2> state() const { return {key_, counter_}; }
  static constexpr Rng restored(std::array<std::uint64_t, 2> state) {
    Rng r;
    r.key_ = state[0];
    r.counter_ = state[1];
    return r;
  }
  constexpr bool operator==(const Rng&) const = default;

 private:
  static constexpr std::uint64_t mix(std::uint64_t x) {  // SplitMix64's finaliser
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
  }
  [[nodiscard]] constexpr std::array<std::uint32_t, 4> philox(std::uint64_t counter) const {
    std::array<std::uint32_t, 4> x = {static_cast<std::uint32_t>(counter), static_cast<std::uint32_t>(counter >> 32), 0,
                                      0};
    std::uint32_t k0 = static_cast<std::uint32_t>(key_), k1 = static_cast<std::uint32_t>(key_ >> 32);
    for (int round = 0; round < 10; ++round) {
      const std::uint64_t p0 = 0xD2511F53ull * x[0], p1 = 0xCD9E8D57ull * x[2];
      x = {static_cast<std::uint32_t>(p1 >> 32) ^ x[1] ^ k0, static_cast<std::uint32_t>(p1),
           static_cast<std::uint32_t>(p0 >> 32) ^ x[3] ^ k1, static_cast<std::uint32_t>(p0)};
      k0 += 0x9E3779B9u;
      k1 += 0xBB67AE85u;
    }
    return x;
  }
  std::uint64_t key_ = 0, counter_ = 0;
};

}  // namespace vantage
