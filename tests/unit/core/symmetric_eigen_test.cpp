// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <vantage/core/rng.hpp>
#include <vantage/core/symmetric_eigen.hpp>

namespace vantage {
namespace {

template <int N>
using Square = Eigen::Matrix<double, N, N>;

// A = B^T B with columns of B of very different length, so that the eigenvalues are many orders apart.
template <int N>
Square<N> random_positive(Rng rng, double spread) {
  Square<N> b;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) b(i, j) = rng.normal() * std::pow(spread, j);
  return b.transpose() * b;
}

template <int N>
void expect_decomposes(const Square<N>& a) {
  const SymmetricEigen<N> eigen(a);
  Square<N> values = Square<N>::Zero();
  for (int i = 0; i < N; ++i) values(i, i) = eigen.values[static_cast<std::size_t>(i)];
  EXPECT_LE((eigen.V.transpose() * eigen.V - Square<N>::Identity()).norm(), 1e-14 * N);
  EXPECT_LE((eigen.V * values * eigen.V.transpose() - a).norm(), 1e-14 * N * a.norm());
}

TEST(SymmetricEigen, VectorsAreOrthonormalAndRestoreTheMatrix) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    expect_decomposes<2>(random_positive<2>(Rng(seed), 1e-3));
    expect_decomposes<3>(random_positive<3>(Rng(seed), 1));
    expect_decomposes<6>(random_positive<6>(Rng(seed), 0.1));
    expect_decomposes<6>(random_positive<6>(Rng(seed), 1) - 5 * Square<6>::Identity());  // of both signs
  }
}

TEST(SymmetricEigen, KnowsWhatIsKnownInClosedForm) {
  Square<2> a;
  a << 2, 1, 1, 2;
  EXPECT_NEAR(SymmetricEigen<2>(a).smallest(), 1, 1e-15);
  EXPECT_NEAR(SymmetricEigen<2>(a).largest(), 3, 1e-15);
  const SymmetricEigen<6> ones(Square<6>::Ones());
  EXPECT_NEAR(ones.largest(), 6, 1e-14);
  EXPECT_NEAR(ones.smallest(), 0, 1e-14);
  EXPECT_EQ(SymmetricEigen<3>(Square<3>::Zero()).largest(), 0);
}

TEST(SymmetricEigen, SolvesAndReadsTheLowerTriangleOnly) {
  Square<6> a = random_positive<6>(Rng(3), 0.5);
  Eigen::Matrix<double, 6, 1> x;
  for (int i = 0; i < 6; ++i) x[i] = i - 2.5;
  const Eigen::Matrix<double, 6, 1> b = a * x;
  a(0, 5) = a(1, 2) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_LE((SymmetricEigen<6>(a).solve(b) - x).norm(), 1e-8);
}

TEST(SymmetricEigen, NaNStaysNaN) {
  Square<3> a = Square<3>::Identity();
  a(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(SymmetricEigen<3>(a).solve(Eigen::Vector3d::Ones()).allFinite());
}

}  // namespace
}  // namespace vantage
