// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/core/dense.hpp>
#include <vantage/core/large_matrix.hpp>

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

namespace {

using namespace vantage;
using Matrix = Eigen::MatrixXd;

Matrix positive_definite(Eigen::Index n) {
  std::srand(5);
  const Matrix a = Matrix::Random(n, n);
  return a * a.transpose() + Matrix::Identity(n, n) * static_cast<double>(n) * 0.1;
}

class Dense : public testing::TestWithParam<Eigen::Index> {};
INSTANTIATE_TEST_SUITE_P(Sizes, Dense, testing::Values(1, 2, 95, 96, 97, 300, 700));

TEST_P(Dense, CholeskySolvesAndInverts) {
  const Matrix a = positive_definite(GetParam());
  Matrix l = a;
  dense::cholesky<double>(l);
  const Matrix lower = l.triangularView<Eigen::Lower>();
  EXPECT_LT((lower * lower.transpose() - a).norm(), 1e-12 * a.norm());

  const Matrix b = Matrix::Random(GetParam(), 301);
  Matrix x = b;
  dense::solve_lower<double>(l, x);
  EXPECT_LT((lower * x - b).norm(), 1e-11 * b.norm());

  Matrix inverse;
  dense::inverse_from_cholesky<double>(l, inverse);
  EXPECT_LT((inverse * a - Matrix::Identity(a.rows(), a.cols())).norm(), 1e-9);
  EXPECT_EQ(inverse, Matrix(inverse.transpose()));
}

TEST_P(Dense, GramAddsToTheLowerTriangle) {
  const Matrix a = Matrix::Random(37, GetParam()), before = Matrix::Random(GetParam(), GetParam());
  Matrix c = before;
  dense::add_gram<double>(c, a, -2.0);
  const Matrix expected = before - 2 * a.transpose() * a;
  EXPECT_LT(Matrix((c - expected).triangularView<Eigen::Lower>()).norm(), 1e-11 * (1 + expected.norm()));
}

TEST(Dense, RefusesWhatIsNotPositiveDefinite) {
  Matrix a = positive_definite(300);
  a(250, 250) = -1;
  EXPECT_THROW(dense::cholesky<double>(a), Error);
  Matrix nan = positive_definite(300);
  nan(299, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(dense::cholesky<double>(nan), Error);
}

TEST(LargeMatrix, CopiesMovesAndShrinks) {
  LargeMatrix<double> a(700, 700);  // more than a huge page
  EXPECT_EQ(a.map().squaredNorm(), 0);
  a.map().setRandom();
  const LargeMatrix<double> copy = a;
  EXPECT_NE(copy.map().data(), a.map().data());
  EXPECT_EQ(copy.map(), a.map());
  const double* data = a.map().data();
  LargeMatrix<double> moved = std::move(a);
  EXPECT_EQ(moved.map().data(), data);
  const Matrix head = Eigen::Map<const Matrix>(moved.map().data(), 300, 300);
  moved.shrink(300, 300);
  EXPECT_EQ(Matrix(moved.map()), head);
  EXPECT_EQ(moved.bytes(), 300u * 300u * 8u);
  moved.shrink(0, 0);
  EXPECT_EQ(moved.bytes(), 0u);
  const LargeMatrix<float> empty(0, 7);
  EXPECT_EQ(empty.bytes(), 0u);
}

}  // namespace
