// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The beliefs that keep all measurements: Batch (exact regression) and Committee.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/maps/field/matern.hpp>
#include <vantage/maps/field/methods.hpp>

#include "lawnmower.hpp"

namespace {

using namespace vantage;

static_assert(FieldMap<ArGprIk<>> && ForecastMap<ArGprIk<>> && UncertainMap<ArGprIk<>>);
static_assert(FieldMap<ArBcm<>> && ForecastMap<ArBcm<>> && UncertainMap<ArBcm<>>);
static_assert(Persistent<ArGprIk<>> && Persistent<ArBcm<>>);

template <class Map>
typename Map::Config config(int depth) {
  auto c = configured<Map, preset::reference>();
  c.kernel.variance = 1;
  c.kernel.length_m = 2.36;
  c.sensor.alpha = 0.05;
  c.tree.depth = depth;
  return c;
}
const std::vector<FieldImage>& images() {
  static const std::vector<FieldImage> all = testing_::lawnmower(0.125, 3);
  return all;
}
template <class A, class B>
void expect_same(const A& a, const B& b, double mean_tolerance, double variance_tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a.mean(i), b.mean(i), mean_tolerance) << "cell " << i;
    EXPECT_NEAR(a.variance(i), b.variance(i), variance_tolerance) << "cell " << i;
  }
}

TEST(NodePrior, IsTheKernelBetweenCellsOfAnyLevels) {
  const NdTree tree({.area = {Eigen::Vector2d(-2, 1), Eigen::Vector2d(10, 9)}, .branching = 3, .depth = 2});
  const Matern32 kernel{.variance = 2, .length_m = 1.5};
  std::vector<NdTree::Leaf> cells;
  for (int level = 0; level <= 2; ++level)
    for (int i = 0; i < tree.side(level); ++i) cells.push_back({level, i, (i * 5) % tree.side(level), false});
  const auto check = [&](auto rule) {
    using Rule = decltype(rule);
    const NodePrior prior(tree, Prior::make<Rule>(tree, 0, kernel));
    const Eigen::MatrixXd k = prior.covariance(cells, cells), lower = prior.covariance(cells);
    for (std::size_t i = 0; i < cells.size(); ++i)
      for (std::size_t j = 0; j < cells.size(); ++j) {
        const auto &a = cells[i], &b = cells[j];
        const double expected =
            kernel.variance *
            Rule::correlation(kernel, tree.x_interval(a.level, a.ix), tree.x_interval(b.level, b.ix)) *
            Rule::correlation(kernel, tree.y_interval(a.level, a.iy), tree.y_interval(b.level, b.iy));
        EXPECT_NEAR(k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), expected, 1e-13);
        EXPECT_EQ(prior(a, b), k(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
        if (i >= j) { EXPECT_EQ(lower(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)), prior(a, b)); }
      }
  };
  check(CellAverage{});
  check(CellCentre{});
  EXPECT_THROW(NodePrior(NdTree({.branching = 2, .depth = 11}), Prior{}), Error);
}

// Regression on everything is what the filter does step by step.
TEST(Batch, IsTheFilterWhereNothingMerges) {
  using Regression = IntegralGp<SquaredExponential, CellAverage, Batch, Fixed<>>;
  using Filter = IntegralGp<SquaredExponential, CellAverage, Full<>, Fixed<>>;
  auto c = config<Regression>(4);
  c.belief.jitter = 0;
  Regression regression(c);
  Filter filter(config<Filter>(4));
  Rng rng;
  std::vector<View> candidates;
  for (int i = 0; i < 8; ++i) candidates.push_back(nadir(2 + 2 * i, 18 - 2 * i, 2 + 0.3 * i));
  for (std::size_t step = 0; step < 16; ++step) {
    regression.integrate(images()[step], rng);
    filter.integrate(images()[step], rng);
    expect_same(regression, filter, 1e-11, 1e-11);
    if (step % 5 != 0) continue;
    std::vector<double> a(8), b(8);
    const std::vector<View> given = {nadir(9, 9, 4)};
    regression.forecast(given, candidates, a);
    filter.forecast(given, candidates, b);
    for (std::size_t k = 0; k < 8; ++k) EXPECT_NEAR(a[k], b[k], 1e-9);
  }
}

// Merging as the definition has it: measurements replaced by their means, then one regression on all of them.
TEST(Batch, InfersFromMergedMeasurements) {
  using Map = ArGprIk<preset::reference>;
  const auto c = config<Map>(4);
  Map map(c);
  Rng rng;
  struct Slow {
    Box2 box;
    double value, noise;
  };
  std::vector<Slow> history;
  const auto covariance = [&](const Box2& a, const Box2& b) {
    return c.kernel.variance * c.kernel.average({a.min().x(), a.max().x()}, {b.min().x(), b.max().x()}) *
           c.kernel.average({a.min().y(), a.max().y()}, {b.min().y(), b.max().y()});
  };
  std::size_t merges = 0;
  for (const FieldImage& image : images()) {
    const CellMeasurements z = c.sensor.measure(map.tree(), image);
    std::vector<Box2> before;
    for (std::size_t i = 0; i < map.size(); ++i) before.push_back(map.cell(i));
    for (std::size_t k = 0; k < z.cells.size(); ++k)
      history.push_back(
          {before[z.cells[k]], z.value[static_cast<Eigen::Index>(k)], z.noise_variance[static_cast<Eigen::Index>(k)]});
    map.integrate(image, rng);

    const auto l = static_cast<Eigen::Index>(history.size());
    Eigen::MatrixXd s(l, l);
    Eigen::VectorXd g(l);
    for (Eigen::Index i = 0; i < l; ++i) {
      const Slow& a = history[static_cast<std::size_t>(i)];
      for (Eigen::Index j = 0; j < l; ++j) s(i, j) = covariance(a.box, history[static_cast<std::size_t>(j)].box);
      s(i, i) += a.noise + 1e-8 * c.kernel.variance;
      g[i] = a.value - c.prior_mean;
    }
    const Eigen::MatrixXd inverse = s.inverse();
    for (std::size_t i = 0; i < map.size(); ++i) {  // by linearity, merged cells are what regression says of them
      const Box2 box = map.cell(i);
      const Eigen::VectorXd k = Eigen::VectorXd::NullaryExpr(
          l, [&](Eigen::Index j) { return covariance(box, history[static_cast<std::size_t>(j)].box); });
      EXPECT_NEAR(map.mean(i), c.prior_mean + k.dot(inverse * g), 1e-9);
      EXPECT_NEAR(map.variance(i), covariance(box, box) - k.dot(inverse * k), 1e-9);
    }
    // What has merged loses its measurements to its mean.
    std::vector<Slow> merged;
    for (std::size_t i = 0; i < map.size(); ++i) {
      std::vector<Slow> inside;
      for (const Slow& m : history)
        if (map.cell(i).contains(Eigen::Vector2d(m.box.center()))) inside.push_back(m);
      if (inside.empty()) continue;
      Slow mean{map.cell(i), 0, 0};
      double weight = 0;
      for (const Slow& m : inside) {
        weight += area(m.box);
        mean.value += area(m.box) * m.value;
        mean.noise += area(m.box) * area(m.box) * m.noise;
      }
      merges += inside.size() > 1;
      merged.push_back({mean.box, mean.value / weight, mean.noise / (weight * weight)});
    }
    history = merged;
    ASSERT_EQ(map.belief().history().size(), history.size());
  }
  EXPECT_GT(merges, 10u);
  EXPECT_LT(map.size(), 200u);
}

// Tresp's formula as it is written, with all its inverses; a kernel and cells for which they exist.
TEST(Committee, IsTrespsFormula) {
  using Map = ArBcm<preset::reference, detail::AboveThreshold<preset::reference>, Matern32>;
  auto c = config<Map>(4);
  c.kernel.length_m = 1.5;
  c.belief.jitter = 1e-12;
  Map map(c);
  Rng rng;
  struct Batch {
    Eigen::Matrix2Xd centre;
    Eigen::VectorXd value, noise;
  };
  std::vector<Batch> batches;
  const auto covariance = [&](const Eigen::Matrix2Xd& a, const Eigen::Matrix2Xd& b) {
    Eigen::MatrixXd k(a.cols(), b.cols());
    for (Eigen::Index i = 0; i < a.cols(); ++i)
      for (Eigen::Index j = 0; j < b.cols(); ++j)
        k(i, j) = c.kernel.variance * c.kernel.correlation(a(0, i) - b(0, j)) * c.kernel.correlation(a(1, i) - b(1, j));
    return k;
  };
  std::size_t pruned = 0;
  for (const FieldImage& image : images()) {
    const CellMeasurements z = c.sensor.measure(map.tree(), image);
    Batch batch{Eigen::Matrix2Xd(2, static_cast<Eigen::Index>(z.cells.size())), z.value, z.noise_variance};
    for (std::size_t k = 0; k < z.cells.size(); ++k)
      batch.centre.col(static_cast<Eigen::Index>(k)) = map.cell(z.cells[k]).center();
    batches.push_back(batch);
    const std::size_t before = map.size();
    map.integrate(image, rng);
    pruned += before - map.size();

    const auto n = static_cast<Eigen::Index>(map.size());
    Eigen::Matrix2Xd query(2, n);
    for (Eigen::Index i = 0; i < n; ++i) query.col(i) = map.cell(static_cast<std::size_t>(i)).center();
    const Eigen::MatrixXd prior = covariance(query, query), prior_inverse = prior.inverse();
    Eigen::MatrixXd information = -(static_cast<double>(batches.size()) - 1) * prior_inverse;
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
    for (const Batch& b : batches) {
      Eigen::MatrixXd s = covariance(b.centre, b.centre);
      s.diagonal() += b.noise;
      const Eigen::MatrixXd cross = covariance(query, b.centre);
      const Eigen::VectorXd mean = cross * s.inverse() * (b.value.array() - c.prior_mean).matrix();
      const Eigen::MatrixXd inverse = (prior - cross * s.inverse() * cross.transpose()).inverse();
      information += inverse;
      sum += inverse * mean;
    }
    const Eigen::MatrixXd posterior = information.inverse();
    const Eigen::VectorXd mean = (posterior * sum).array() + c.prior_mean;
    for (std::size_t i = 0; i < map.size(); ++i) {
      EXPECT_NEAR(map.mean(i), mean[static_cast<Eigen::Index>(i)], 1e-7);
      EXPECT_NEAR(map.variance(i), posterior(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)), 1e-7);
    }
  }
  EXPECT_GT(pruned, 50u);
}

// With all measured cells among the queried ones the committee is exact, however singular the prior: 32 x 32 at l
// = 2.36 m.
TEST(Committee, IsExactWhereNothingIsPruned) {
  using Machine = IntegralGp<SquaredExponential, CellCentre, Committee, Fixed<>>;
  using Filter = IntegralGp<SquaredExponential, CellCentre, Full<>, Fixed<>>;
  Machine machine(config<Machine>(5));
  Filter filter(config<Filter>(5));
  Rng rng;
  for (std::size_t step = 0; step < 4; ++step) {
    machine.integrate(images()[step], rng);
    filter.integrate(images()[step], rng);
    expect_same(machine, filter, 1e-5, 1e-6);
  }
}

template <class M>
struct AccumulatedMap : testing::Test {};
using Maps = testing::Types<ArGprIk<preset::reference>, ArBcm<preset::reference>, ArGprIk<>, ArBcm<>>;
TYPED_TEST_SUITE(AccumulatedMap, Maps);

TYPED_TEST(AccumulatedMap, MapsAFieldAndMergesWhatDoesNotMatter) {
  TypeParam map(config<TypeParam>(4));
  Rng rng;
  for (const FieldImage& image : images()) map.integrate(image, rng);
  EXPECT_EQ(map.coverage(), 1);
  EXPECT_LT(map.size(), 180u);
  double error = 0;
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      const Eigen::Vector2d p(0.2 * x + 0.1, 0.2 * y + 0.1);
      const double truth = testing_::hill(p.x(), p.y());
      if (truth > 0.7) error = std::max(error, std::abs(map.mean(map.cell_at(p)) - truth));
    }
  EXPECT_LT(error, 0.15);  // where it matters
  for (std::size_t i = 0; i < map.size(); ++i) EXPECT_GE(map.variance(i), 0);
  std::vector<double> reduction(1);
  map.forecast({}, std::vector<View>{nadir(14, 6, 2)}, reduction);
  EXPECT_GT(reduction[0], 0);
}

TYPED_TEST(AccumulatedMap, SavesAndLoadsItself) {
  TypeParam map(config<TypeParam>(3)), other(config<TypeParam>(3));
  Rng rng;
  for (std::size_t step = 0; step < 9; ++step) map.integrate(images()[step], rng);
  Sink sink;
  map.save(sink);
  Source source(sink.bytes());
  other.load(source);
  source.done();
  for (std::size_t step = 9; step < 16; ++step) {
    map.integrate(images()[step], rng);
    other.integrate(images()[step], rng);
  }
  ASSERT_EQ(map.size(), other.size());
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_EQ(map.mean(i), other.mean(i));
    EXPECT_EQ(map.variance(i), other.variance(i));
  }
  // Truncated anywhere, or with a byte turned: refused or loaded, never half.
  const TypeParam fresh(config<TypeParam>(3));
  for (std::size_t cut = 0; cut < sink.bytes().size(); cut += 37) {
    TypeParam victim = fresh;
    Source bad(sink.bytes().first(cut));
    EXPECT_THROW(victim.load(bad), Error);
    EXPECT_EQ(victim.size(), fresh.size());
    EXPECT_EQ(victim.mean(0), fresh.mean(0));
  }
}

TYPED_TEST(AccumulatedMap, RefusesWhatItCannotInvertUnchanged) {
  auto c = config<TypeParam>(5);
  c.sensor.alpha = 1e-200;
  c.sensor.partial = {};
  c.belief.jitter = 0;
  TypeParam map(c);
  CellMeasurements z;
  for (std::size_t i = 0; i < map.size(); ++i) z.cells.push_back(i);
  z.value.setZero(static_cast<Eigen::Index>(map.size()));
  z.noise_variance.setConstant(static_cast<Eigen::Index>(map.size()), 1e-30);
  const double before = map.variance(7);
  EXPECT_THROW(map.fuse(z), Error);
  EXPECT_EQ(map.variance(7), before);
  EXPECT_EQ(map.mean(7), c.prior_mean);
  EXPECT_EQ(map.coverage(), 0);
  c.belief.jitter = 1;
  EXPECT_THROW((void)TypeParam(c), Error);
}

}  // namespace
