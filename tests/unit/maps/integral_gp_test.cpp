// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/maps/field/integral_gp.hpp>

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

#include <tbb/task_arena.h>

#include <vantage/maps/field/diagonal.hpp>
#include <vantage/maps/field/latent.hpp>

namespace {

using namespace vantage;
using Sensor = CellSensor<DeviationGrowsWithHeight>;
template <class Belief, class Resolution, class Cells = CellAverage, class S = Sensor>
using Gp = IntegralGp<SquaredExponential, Cells, Belief, Resolution, S>;

FieldImage image(const View& view, Rng& rng, double noise = 0.1) {
  FieldImage z{view, NadirSensor{}.footprint(view), Image<double>(20, 20)};
  const Eigen::Vector2d pixel = z.footprint.sizes() / 20;
  for (int r = 0; r < 20; ++r)
    for (int c = 0; c < 20; ++c) {
      const double x = z.footprint.min().x() + pixel.x() * (c + 0.5), y = z.footprint.min().y() + pixel.y() * (r + 0.5);
      z.values(r, c) = 0.5 + 0.45 * std::sin(0.5 * x) * std::cos(0.4 * y) + noise * rng.normal();
    }
  return z;
}
View lawnmower(int k) { return nadir(2.5 + 5 * ((k / 4) % 2 ? 3 - k % 4 : k % 4), 2.5 + 5 * (k / 4), 2.5); }

template <class Map>
Map make(int depth, int branching = 2) {
  typename Map::Config c;
  c.tree.depth = depth;
  c.tree.branching = branching;
  c.sensor.alpha = 0.05;
  return Map(c);
}

template <class Map>
std::vector<std::byte> bytes(const Map& map) {
  Sink sink;
  map.save(sink);
  return std::move(sink).take();
}

// The same filter, written down slowly: dense matrices with H and M spelled out (eqs. 3.5 to 3.12).
struct SlowFilter {
  struct Cell {
    Box2 box;
    bool measured;
  };
  std::vector<Cell> cells;
  Eigen::VectorXd mean;
  Eigen::MatrixXd k;

  explicit SlowFilter(const auto& map) {
    const SquaredExponential& kernel = map.config().kernel;
    const auto n = static_cast<Eigen::Index>(map.size());
    mean = Eigen::VectorXd::Constant(n, map.config().prior_mean);
    k.resize(n, n);
    for (std::size_t i = 0; i < map.size(); ++i) cells.push_back({map.cell(i), false});
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) {
        const Box2 &a = cells[static_cast<std::size_t>(i)].box, &b = cells[static_cast<std::size_t>(j)].box;
        k(i, j) = kernel.variance * kernel.average({a.min().x(), a.max().x()}, {b.min().x(), b.max().x()}) *
                  kernel.average({a.min().y(), a.max().y()}, {b.min().y(), b.max().y()});
      }
  }
  void update(const CellMeasurements& z) {
    const auto l = static_cast<Eigen::Index>(z.cells.size());
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(l, mean.size());
    for (Eigen::Index a = 0; a < l; ++a) h(a, static_cast<Eigen::Index>(z.cells[static_cast<std::size_t>(a)])) = 1;
    const Eigen::MatrixXd s = h * k * h.transpose() + Eigen::MatrixXd(z.noise_variance.asDiagonal());
    const Eigen::MatrixXd gain = k * h.transpose() * s.inverse();
    mean += gain * (z.value - h * mean);
    k -= gain * h * k;
  }
  void merge(const auto& map) {  // into the map's cells
    const auto n = static_cast<Eigen::Index>(map.size());
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(n, mean.size());
    std::vector<Cell> merged;
    for (Eigen::Index g = 0; g < n; ++g) {
      const Box2 box = map.cell(static_cast<std::size_t>(g));
      merged.push_back({box, true});
      for (std::size_t i = 0; i < cells.size(); ++i)
        if (box.contains(cells[i].box.center())) m(g, static_cast<Eigen::Index>(i)) = area(cells[i].box) / area(box);
    }
    mean = m * mean;
    k = m * k * m.transpose();
    cells = merged;
  }
};

template <class Map>
void expect_equal_to_slow_filter(int depth, int branching, double tolerance) {
  Map map = make<Map>(depth, branching);
  SlowFilter slow(map);
  Rng rng(4), unused;
  for (int step = 0; step < 10; ++step) {
    const FieldImage z = image(nadir(rng.uniform(2, 18), rng.uniform(2, 18), rng.uniform(1.5, 4)), rng);
    const CellMeasurements m = map.config().sensor.measure(map.tree(), z);
    ASSERT_FALSE(m.cells.empty());
    slow.update(m);
    map.integrate(z, unused);
    slow.merge(map);
    for (std::size_t i = 0; i < map.size(); ++i) {
      const auto r = static_cast<Eigen::Index>(i);
      ASSERT_NEAR(map.mean(i), slow.mean[r], tolerance) << step;
      ASSERT_NEAR(map.variance(i), slow.k(r, r), tolerance) << step;
      if constexpr (requires { map.belief().covariance(i, i); }) {
        for (std::size_t j = 0; j <= i; ++j)
          ASSERT_NEAR(map.belief().covariance(i, j), slow.k(r, static_cast<Eigen::Index>(j)), tolerance);
      }
    }
  }
  EXPECT_LT(map.size(), static_cast<std::size_t>(std::pow(branching, 2 * depth)) + 1);
}

TEST(IntegralGp, EqualsTheFilterWrittenDownSlowly) {
  expect_equal_to_slow_filter<Gp<Full<>, Merging<>>>(4, 2, 1e-11);
  expect_equal_to_slow_filter<Gp<Full<>, Merging<>>>(2, 3, 1e-11);
  expect_equal_to_slow_filter<Gp<Full<>, Fixed<>>>(3, 2, 1e-11);
  expect_equal_to_slow_filter<Gp<Full<float>, Fixed<>>>(3, 2, 2e-4);
  expect_equal_to_slow_filter<Gp<Latent<>, Merging<>>>(4, 2, 1e-7);
}

TEST(IntegralGp, MergesWhatIsDullAndKeepsTheRest) {
  auto map = make<Gp<Full<>, Merging<>>>(5);
  Rng rng(4), unused;
  for (int k = 0; k < 16; ++k) map.integrate(image(lawnmower(k), rng), unused);
  EXPECT_LT(map.size(), 700u);
  const double finest = 20.0 / 32;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const bool merged = map.cell(i).sizes().x() > 1.01 * finest;
    EXPECT_FALSE(merged && map.mean(i) > 0.8) << "merged at " << map.cell(i).center().transpose();
  }
  for (const double x : {3.0, 16.0})  // the crests of the field
    EXPECT_NEAR(map.cell(map.cell_at({x, 0.5})).sizes().x(), finest, 1e-9);
  EXPECT_NEAR(map.coverage(), 1, 1e-12);
}

TEST(IntegralGp, BelowIsTheMirrorOfAbove) {
  using Low = Gp<Full<>, Merging<Below<>>>;
  using High = Gp<Full<>, Merging<Above<>>>;
  typename Low::Config low;
  typename High::Config high;
  low.tree.depth = high.tree.depth = 4;
  low.resolution.interest.threshold = 0.3;
  high.resolution.interest.threshold = 0.7;
  Low a(low);
  High b(high);
  Rng rng(4), unused;
  for (int k = 0; k < 16; ++k) {
    FieldImage z = image(lawnmower(k), rng);
    b.integrate(z, unused);
    z.values = 1 - z.values;
    a.integrate(z, unused);
  }
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a.mean(i), 1 - b.mean(i), 1e-12);
}

template <class Map>
class ForecastOf : public testing::Test {};
using Forecasters = testing::Types<Gp<Full<>, Fixed<>>, Gp<Full<>, Merging<>>, Gp<Diagonal, Fixed<>>,
                                   Gp<Latent<>, Fixed<>>, Gp<Latent<>, Merging<>>>;
TYPED_TEST_SUITE(ForecastOf, Forecasters);

// Eq. 3.13 by its definition: measure, and look what the targets lost. A map that merges is measured with its copy
// fixed.
template <class Map>
double lost(const Map& map, const CellMeasurements& z) {
  auto belief = map.belief();
  CellMeasurements made = z;
  made.value = Eigen::VectorXd::Zero(z.noise_variance.size());
  belief.fuse(map.tree(), made);
  belief.settle();
  double sum = 0;
  for (std::size_t i = 0; i < map.size(); ++i)
    if (map.interest().target(map.mean(i), map.variance(i))) sum += map.variance(i) - belief.variance(i);
  return sum;
}

TYPED_TEST(ForecastOf, IsWhatTheTargetsLose) {
  for (const int depth : {3, 5}) {
    auto map = make<TypeParam>(depth);
    Rng rng(4), unused;
    for (int k = 0; k < 6; ++k) map.integrate(image(lawnmower(k), rng), unused);
    std::vector<View> views;
    for (int k = 0; k < 12; ++k)
      views.push_back(nadir(rng.uniform(0, 20), rng.uniform(0, 20), rng.uniform(1, k < 6 ? 3 : 12)));
    views.push_back(nadir(100, 100, 2));
    std::vector<double> reduction(views.size());
    map.forecast({}, views, reduction);
    EXPECT_EQ(reduction.back(), 0);
    views.pop_back();
    for (std::size_t k = 0; k < views.size(); ++k) {
      const auto z = map.config().sensor.covered(map.tree(), map.config().sensor.camera.footprint(views[k]),
                                                 views[k].position().z());
      EXPECT_NEAR(reduction[k], lost(map, z), 1e-7 * (1 + reduction[k])) << k;
    }
    std::vector<double> after(views.size());
    map.forecast(std::span(views).first(3), views, after);
    for (std::size_t k = 0; k < views.size(); ++k) {
      EXPECT_GE(after[k], 0);
      EXPECT_LE(after[k], reduction[k] + 1e-9) << k;
    }
  }
}

TYPED_TEST(ForecastOf, GivenViewsCountAsMeasured) {
  auto map = make<TypeParam>(4);
  Rng rng(4), unused;
  map.integrate(image(lawnmower(5), rng), unused);
  const std::vector<View> views = {nadir(4, 4, 2), nadir(5, 5, 3), nadir(16, 14, 2)};
  std::vector<double> given(1), first(1), both(2);
  map.forecast(std::span(views).first(1), std::span(views).subspan(1, 1), given);
  // The variance lost to both in a row is the loss to the first and, given it, to the second.
  auto belief = map.belief();
  double sum = 0;
  std::vector<double> before(map.size());
  for (std::size_t i = 0; i < map.size(); ++i) before[i] = map.variance(i);
  for (const View& v : {views[0], views[1]}) {
    CellMeasurements z =
        map.config().sensor.covered(map.tree(), map.config().sensor.camera.footprint(v), v.position().z());
    z.value = Eigen::VectorXd::Zero(z.noise_variance.size());
    belief.fuse(map.tree(), z);
    belief.settle();
  }
  for (std::size_t i = 0; i < map.size(); ++i)
    if (map.interest().target(map.mean(i), map.variance(i))) sum += before[i] - belief.variance(i);
  map.forecast({}, std::span(views).first(1), first);
  EXPECT_NEAR(first[0] + given[0], sum, 1e-7 * sum);
}

TEST(Latent, IsTheFullBeliefWithinTheErrorThatTheUserAllows) {
  auto full = make<Gp<Full<>, Merging<>>>(6);
  auto latent = make<Gp<Latent<>, Merging<>>>(6);
  Rng a(4), b(4), unused;
  for (int k = 0; k < 16; ++k) {
    full.integrate(image(lawnmower(k), a), unused);
    latent.integrate(image(lawnmower(k), b), unused);
    ASSERT_EQ(full.size(), latent.size()) << "merges differ in step " << k;
    for (std::size_t i = 0; i < full.size(); ++i) {
      ASSERT_TRUE(full.cell(i).isApprox(latent.cell(i)));
      ASSERT_NEAR(full.mean(i), latent.mean(i), 1e-6);
      ASSERT_NEAR(full.variance(i), latent.variance(i), 1e-8);
    }
  }
  EXPECT_LT(latent.bytes() * 20, static_cast<std::size_t>(4096) * 4096 * 8);
}

TEST(Latent, KeepsItsBound) {
  for (const double allowed : {1e-2, 1e-4, 1e-6}) {
    using Low = Gp<Latent<>, Fixed<>>;
    typename Low::Config c;
    c.tree.depth = 4;
    c.sensor.alpha = 0.05;
    c.belief = {.variance_error = allowed, .least_noise_variance = 0.05 * 0.05};
    Low latent(c);
    auto full = make<Gp<Full<>, Fixed<>>>(4);
    Rng a(9), b(9), unused;
    double worst = 0;
    for (int k = 0; k < 8; ++k) {
      const View v = lawnmower(k);
      full.integrate(image(v, a), unused);
      latent.integrate(image(v, b), unused);
      for (std::size_t i = 0; i < full.size(); ++i) {
        EXPECT_GE(full.variance(i), latent.variance(i) - 1e-11);
        worst = std::max(worst, full.variance(i) - latent.variance(i));
      }
    }
    EXPECT_LE(worst, allowed);
    EXPECT_GT(worst, 0);
  }
}

template <class Map>
class IntegralGpOf : public testing::Test {};
using Maps = testing::Types<
    Gp<Full<>, Merging<>>, Gp<Full<float>, Fixed<>>, Gp<Diagonal, Merging<>>, Gp<Latent<>, Merging<>>,
    Gp<Full<>, Merging<Above<DeviationMargin>, true>, CellAverage, CellSensor<DeviationGrowsWithHeight, SkipPartial>>>;
TYPED_TEST_SUITE(IntegralGpOf, Maps);

TYPED_TEST(IntegralGpOf, RefusesBadImagesUnchanged) {
  auto map = make<TypeParam>(4);
  Rng rng(4), unused;
  map.integrate(image(lawnmower(0), rng), unused);
  const auto before = bytes(map);
  const FieldImage good = image(lawnmower(1), rng);
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  std::vector<FieldImage> bad(8, good);
  bad[0].values(3, 3) = inf;
  bad[1].values.resize(0, 0);
  bad[2].footprint.max().x() = nan;
  bad[3].footprint = Box2(Eigen::Vector2d(5, 5), Eigen::Vector2d(5, 9));
  bad[4].footprint = Box2(Eigen::Vector2d(25, 5), Eigen::Vector2d(29, 9));
  bad[5].view = nadir(2, 2, -1);
  bad[6].view = nadir(2, 2, nan);
  bad[7].footprint.setEmpty();
  for (std::size_t i = 0; i < bad.size(); ++i) {
    EXPECT_THROW(map.integrate(bad[i], unused), Error) << i;
    EXPECT_EQ(bytes(map), before) << i;
  }
  CellMeasurements z{{1, 0}, Eigen::VectorXd::Zero(2), Eigen::VectorXd::Ones(2)};
  EXPECT_THROW(map.fuse(z), Error);
  z.cells = {0, 100000};
  EXPECT_THROW(map.fuse(z), Error);
  z.cells = {0, 1};
  z.noise_variance[1] = 0;
  EXPECT_THROW(map.fuse(z), Error);
  EXPECT_EQ(bytes(map), before);
  std::vector<double> reduction(1);
  for (const View& v : {nadir(1, 1, nan), nadir(1, 1, -2), look_at({5, 5, 2}, {9, 5, 0})})
    EXPECT_THROW(map.forecast({}, std::vector<View>{v}, reduction), Error);
}

TYPED_TEST(IntegralGpOf, SkipsPixelsWithoutAValue) {
  auto map = make<TypeParam>(4);
  const std::size_t size = map.size();
  const auto prior = make<TypeParam>(4);
  Rng rng(4), unused;
  FieldImage z = image(lawnmower(5), rng);
  z.values.setConstant(std::numeric_limits<double>::quiet_NaN());
  map.integrate(z, unused);
  ASSERT_EQ(map.size(), size);
  for (std::size_t i = 0; i < size; ++i) {
    ASSERT_EQ(map.mean(i), prior.mean(i));
    ASSERT_EQ(map.variance(i), prior.variance(i));
  }
  const std::vector<View> there = {lawnmower(5)};
  std::vector<double> reduction(1, -1);
  map.forecast({}, there, reduction);
  EXPECT_EQ(reduction[0], 0) << "nothing is expected where no value was";
  const auto before = bytes(map);
  z = image(lawnmower(5), rng);
  z.values.leftCols(10).setConstant(std::numeric_limits<double>::quiet_NaN());
  map.integrate(z, unused);
  EXPECT_NE(bytes(map), before);
}

TYPED_TEST(IntegralGpOf, GoesOnFromASavedMap) {
  auto map = make<TypeParam>(4);
  Rng a(4), b(4), unused;
  for (int k = 0; k < 5; ++k) map.integrate(image(lawnmower(k), a), unused);
  const auto saved = bytes(map);
  auto other = make<TypeParam>(4);
  Source source(saved);
  other.load(source);
  source.done();
  EXPECT_EQ(bytes(other), saved);
  for (int k = 5; k < 9; ++k) {
    const FieldImage z = image(lawnmower(k), a);
    map.integrate(z, unused);
    other.integrate(z, unused);
  }
  EXPECT_EQ(bytes(other), bytes(map));

  auto another = make<TypeParam>(3);
  const auto before = bytes(another);
  Source wrong(saved);
  EXPECT_THROW(another.load(wrong), Error);
  for (std::size_t size = 0; size < saved.size(); size += 1 + saved.size() / 97) {
    Source cut(std::span<const std::byte>(saved).first(size));
    EXPECT_THROW(other.load(cut), Error);
  }
  EXPECT_EQ(bytes(another), before);
}

TYPED_TEST(IntegralGpOf, SameBitsWithAnyNumberOfThreads) {
  const auto fly = [](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([] {
      auto map = make<TypeParam>(5);
      Rng rng(4), unused;
      for (int k = 0; k < 5; ++k) map.integrate(image(lawnmower(k), rng), unused);
      std::vector<View> views = {nadir(4, 4, 2), nadir(15, 15, 5), nadir(10, 10, 7)};
      std::vector<double> reduction(3);
      map.forecast({}, views, reduction);
      return std::pair(bytes(map), reduction);
    });
  };
  const auto one = fly(1);
  EXPECT_EQ(fly(2), one);
  EXPECT_EQ(fly(8), one);
}

TEST(IntegralGp, RendersTheDeviationUnderEachPixel) {
  auto map = make<Gp<Full<>, Merging<>>>(4);
  Rng rng(4), unused;
  map.integrate(image(lawnmower(0), rng), unused);
  const Camera camera = Camera::from_fov(40, 30, deg(60));
  Rendering<channel::Uncertainty> out;
  map.render(look_at({10, -5, 8}, {10, 10, 0}), camera, out);
  EXPECT_EQ(out.uncertainty.rows(), 30);
  EXPECT_EQ(out.uncertainty.cols(), 40);
  EXPECT_TRUE(out.uncertainty.allFinite());
  EXPECT_GT(out.uncertainty.maxCoeff(), 0.9);
  map.render(nadir(2.5, 2.5, 1), Camera::from_fov(3, 3, deg(60)), out);
  EXPECT_NEAR(out.uncertainty(1, 1), std::sqrt(map.variance(map.cell_at({2.5, 2.5}))), 1e-6);
  View away = nadir(5, 5, 3);
  away.T_W_C.linear() = Eigen::Matrix3d::Identity();  // looks up
  map.render(away, camera, out);
  EXPECT_EQ(out.uncertainty.maxCoeff(), 0);
  View broken;
  broken.T_W_C.linear().setZero();
  EXPECT_THROW(map.render(broken, camera, out), Error);
  EXPECT_THROW(map.render(away, Camera{}, out), Error);
}

TEST(IntegralGp, NamesEveryBadValue) {
  Gp<Full<>, Merging<>>::Config c;
  c.kernel.length_m = -1;
  c.kernel.variance = std::nan("");
  try {
    const Gp<Full<>, Merging<>> map(c);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("length_m"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find("variance"), std::string::npos);
  }
  c = {};
  c.sensor.alpha = 0;
  EXPECT_THROW((Gp<Full<>, Merging<>>(c)), Error);
  c = {};
  c.resolution.interest.threshold = std::nan("");
  EXPECT_THROW((Gp<Full<>, Merging<>>(c)), Error);
}

// Cells a thousandth of the kernel's length apart are the same to working precision; without noise nothing can invert
// S.
TEST(IntegralGp, SaysWhenTheKernelIsNotPositiveDefinite) {
  Gp<Full<>, Fixed<>>::Config c;
  c.tree.depth = 4;
  c.kernel.length_m = 1e4;
  Gp<Full<>, Fixed<>> map(c);
  const auto before = bytes(map);
  CellMeasurements z;
  for (std::size_t i = 0; i < map.size(); ++i) z.cells.push_back(i);
  z.value = Eigen::VectorXd::Zero(256);
  z.noise_variance = Eigen::VectorXd::Constant(256, 1e-20);
  EXPECT_THROW(map.fuse(z), Error);
  EXPECT_EQ(bytes(map), before);
}

}  // namespace
