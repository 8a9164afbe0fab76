// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include <vantage/core/rng.hpp>

namespace vantage {
namespace {

/// Philox4x32-10 as the paper writes it (Salmon et al., SC 2011, section 3.3), counter of 128 bits.
using Block = std::array<std::uint32_t, 4>;
Block philox(Block x, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = 0xD2511F53ull * x[0], b = 0xCD9E8D57ull * x[2];
    x = {static_cast<std::uint32_t>(b >> 32) ^ x[1] ^ key[0], static_cast<std::uint32_t>(b),
         static_cast<std::uint32_t>(a >> 32) ^ x[3] ^ key[1], static_cast<std::uint32_t>(a)};
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return x;
}

TEST(Rng, ReferenceGivesThePublishedVectors) {  // Random123's kat_vectors, "philox4x32 10"
  EXPECT_EQ(philox({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Rng, IsPhilox) {
  Rng zero = Rng::restored({0, 0});
  EXPECT_EQ(zero(), 0xe169c58d6627e8d5ull);
  std::mt19937_64 any(1);
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t key = any(), counter = any();
    const Block x = philox({static_cast<std::uint32_t>(counter), static_cast<std::uint32_t>(counter >> 32), 0, 0},
                           {static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)});
    Rng rng = Rng::restored({key, counter});
    EXPECT_EQ(rng(), (static_cast<std::uint64_t>(x[1]) << 32) | x[0]);
    EXPECT_EQ(rng.state(), (std::array<std::uint64_t, 2>{key, counter + 1}));
  }
}

TEST(Rng, SeedsAndRestores) {
  Rng a(7), b(7), c(8);
  EXPECT_EQ(a(), b());
  EXPECT_NE(a(), c());
  for (int i = 0; i < 10; ++i) a();
  Rng restored = Rng::restored(a.state());
  EXPECT_EQ(restored, a);
  EXPECT_EQ(restored(), a());
}

TEST(Rng, AForkDoesNotAdvanceAndDependsOnWhere) {
  Rng a(7);
  const Rng before = a;
  const Rng first = a.fork(0);
  EXPECT_EQ(a, before);
  EXPECT_EQ(a.fork(0), first);
  EXPECT_NE(a.fork(1), first);
  a();
  EXPECT_NE(a.fork(0), first);
}

TEST(Rng, ForksAreDistinct) {
  std::set<std::uint64_t> keys;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Rng a(seed);
    for (std::uint64_t i = 0; i < 500; ++i) {
      keys.insert(a.fork(i).state()[0]);
      keys.insert(a.fork(i).fork(i).state()[0]);
    }
  }
  EXPECT_EQ(keys.size(), 20u * 500 * 2);
}

double correlation(Rng a, Rng b, int n) {
  double sum = 0;
  for (int i = 0; i < n; ++i) sum += (a.uniform() - 0.5) * (b.uniform() - 0.5);
  return 12 * sum / n;
}
TEST(Rng, ForksAreUncorrelated) {
  const int n = 10000;
  const double bound = 5 / std::sqrt(n);  // five standard errors
  const Rng a(7);
  for (std::uint64_t i = 0; i < 50; ++i) {
    EXPECT_LT(std::abs(correlation(a, a.fork(i), n)), bound) << "parent and " << i;
    EXPECT_LT(std::abs(correlation(a.fork(i), a.fork(i + 1), n)), bound) << "siblings from " << i;
    EXPECT_LT(std::abs(correlation(Rng(i), Rng(i + 1), n)), bound) << "seeds from " << i;
  }
}

TEST(Rng, UniformIsUniform) {
  const int n = 100000, bins = 100;
  Rng rng(3);
  std::vector<int> count(bins);
  for (int i = 0; i < n; ++i) {
    const double u = rng.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    ++count[static_cast<std::size_t>(u * bins)];
  }
  double chi_square = 0;
  for (const int c : count) chi_square += (c - n / bins) * (c - n / bins) / static_cast<double>(n / bins);
  EXPECT_LT(chi_square, 99 + 4 * std::sqrt(2.0 * 99));
  EXPECT_GT(chi_square, 99 - 4 * std::sqrt(2.0 * 99));
  for (int i = 0; i < 1000; ++i) {
    const double u = rng.uniform(-2, 3);
    EXPECT_TRUE(u >= -2 && u < 3);
  }
}

TEST(Rng, FirstNumbersOfForksAreUniform) {  // what a candidate's own stream is used for
  const int n = 100000, bins = 100;
  const Rng rng(3);
  std::vector<int> count(bins);
  for (std::uint64_t i = 0; i < n; ++i) ++count[static_cast<std::size_t>(rng.fork(i).uniform() * bins)];
  double chi_square = 0;
  for (const int c : count) chi_square += (c - n / bins) * (c - n / bins) / static_cast<double>(n / bins);
  EXPECT_LT(chi_square, 99 + 4 * std::sqrt(2.0 * 99));
}

TEST(Rng, IndexCoversItsRange) {
  Rng rng(4);
  std::vector<int> count(7);
  for (int i = 0; i < 70000; ++i) {
    const std::uint64_t k = rng.index(7);
    ASSERT_LT(k, 7u);
    ++count[k];
  }
  for (const int c : count) EXPECT_NEAR(c, 10000, 4 * std::sqrt(10000.0 * 6 / 7));
  EXPECT_EQ(rng.index(1), 0u);
  EXPECT_LT(rng.index(~std::uint64_t{0}), ~std::uint64_t{0});
}

TEST(Rng, NormalHasItsMoments) {
  Rng rng(5);
  const int n = 200000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0;
  for (int i = 0; i < n; ++i) {
    const double x = rng.normal();
    ASSERT_TRUE(std::isfinite(x));
    m1 += x / n, m2 += x * x / n, m3 += x * x * x / n, m4 += x * x * x * x / n;
  }
  EXPECT_NEAR(m1, 0, 4 / std::sqrt(n));
  EXPECT_NEAR(m2, 1, 4 * std::sqrt(2.0 / n));
  EXPECT_NEAR(m3, 0, 4 * std::sqrt(15.0 / n));
  EXPECT_NEAR(m4, 3, 4 * std::sqrt(96.0 / n));
}

TEST(Rng, IsAStandardGenerator) {
  static_assert(std::uniform_random_bit_generator<Rng>);
  std::vector<int> v = {0, 1, 2, 3, 4, 5, 6, 7};
  std::shuffle(v.begin(), v.end(), Rng(1));
  std::sort(v.begin(), v.end());
  EXPECT_EQ(v, (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
}

}  // namespace
}  // namespace vantage
