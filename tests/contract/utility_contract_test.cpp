// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/loop/nbv_loop.hpp>

#include "policies.hpp"
#include "suite.hpp"

// What a utility must mean: finite numbers that depend on the view, not on the batch, the order or the threads.
namespace vantage::test {
namespace {

/// Takes the loop's scores as they come, for every view of a list.
struct Recording {
  std::vector<View> views;
  template <Map M>
  Candidates sample(const M&, const Situation&, const Score&, Rng&) const {
    return {.views = views};
  }
};
struct Reporting {
  std::vector<double>* scores;
  std::vector<double>* again;
  template <Map M>
  std::optional<Decision> select(const M&, const Situation&, const Candidates& c, const Score& score, Rng&) const {
    *scores = c.utilities;
    again->clear();
    for (const View& v : c.views) {  // one by one
      double one = 0;
      score({&v, 1}, {&one, 1});
      again->push_back(one);
    }
    return std::nullopt;
  }
};

struct Scores {
  std::vector<double> batch, one_by_one;
  bool operator==(const Scores&) const = default;
};

template <class U>
Scores scores(const std::vector<View>& views, const std::vector<View>& visited, std::uint64_t seed = 3) {
  archetype::FullMap map;
  for (const View& v : visited) {
    Rng rng;
    map.integrate({v}, rng);
  }
  Scores s;
  NbvLoop loop{map, make<U>(), Recording{views}, Reporting{&s.batch, &s.one_by_one}};
  Rng rng(seed);
  loop.plan({.here = visited.empty() ? View{} : visited.back(), .visited = visited, .step = visited.size()}, rng);
  return s;
}
std::vector<View> some_views() {
  std::vector<View> views;
  Rng rng(11);
  for (int i = 0; i < 100; ++i) views.push_back(nadir(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0.5, 2)));
  return views;
}

template <class U>
class UtilityContract : public testing::Test {};
TYPED_TEST_SUITE(UtilityContract, Suite<Utilities>);

TYPED_TEST(UtilityContract, IsFiniteWithAndWithoutHistory) {
  for (const std::vector<View>& visited :
       {std::vector<View>{}, std::vector<View>{nadir(0.5, 0, 1), nadir(-0.5, 0.2, 1)}})
    for (const double u : scores<TypeParam>(some_views(), visited).batch) EXPECT_TRUE(std::isfinite(u));
}

TYPED_TEST(UtilityContract, DependsOnTheViewAndNotOnTheBatch) {
  const std::vector<View> views = some_views(), visited = {nadir(0.5, 0, 1)};
  const Scores s = scores<TypeParam>(views, visited);
  ASSERT_EQ(s.batch.size(), views.size());
  EXPECT_EQ(s.batch, s.one_by_one);
  const std::vector<View> backward(views.rbegin(), views.rend());
  const std::vector<double> reversed = scores<TypeParam>(backward, visited).batch;
  EXPECT_EQ(s.batch, std::vector<double>(reversed.rbegin(), reversed.rend()));
}

TYPED_TEST(UtilityContract, RanksSomething) {
  const std::vector<double> u = scores<TypeParam>(some_views(), {nadir(0.5, 0, 1)}).batch;
  EXPECT_NE(*std::min_element(u.begin(), u.end()), *std::max_element(u.begin(), u.end()));
}

TYPED_TEST(UtilityContract, TheSameBitsWithAnyNumberOfThreads) {
  const auto ask = [] { return scores<TypeParam>(some_views(), {nadir(0.5, 0, 1), nadir(-1, 0, 1)}); };
  const Scores one = with_threads(1, ask);
  EXPECT_EQ(one, with_threads(2, ask));
  EXPECT_EQ(one, with_threads(8, ask));
}

TEST(Uninformed, IsUniformAndDrawsAnewEachStep) {
  std::vector<View> views;
  for (int i = 0; i < 20000; ++i) views.push_back(nadir(i, 0, 1));
  const std::vector<double> u = scores<Uninformed>(views, {}, 1).batch;
  double mean = 0, square = 0;
  for (const double x : u) {
    ASSERT_GE(x, 0);
    ASSERT_LT(x, 1);
    mean += x / 20000, square += x * x / 20000;
  }
  EXPECT_NEAR(mean, 0.5, 4 * std::sqrt(1.0 / 12 / 20000));  // four standard errors
  EXPECT_NEAR(square, 1.0 / 3, 4 * std::sqrt(4.0 / 45 / 20000));
  EXPECT_NE(u, scores<Uninformed>(views, {}, 2).batch);
}

TEST(ViewDistance, MeasuresToTheViewsSoFar) {
  const std::vector<View> visited = {nadir(0, 0, 1), nadir(3, 4, 1)}, views = {nadir(3, 0, 1), nadir(0, 0, 1)};
  EXPECT_EQ(scores<ViewDistance<Nearest>>(views, visited).batch, (std::vector<double>{3, 0}));
  EXPECT_EQ(scores<ViewDistance<Mean>>(views, visited).batch, (std::vector<double>{3.5, 2.5}));
  EXPECT_EQ(scores<ViewDistance<Sum>>(views, visited).batch, (std::vector<double>{7, 5}));
  EXPECT_EQ(scores<ViewDistance<Nearest>>(views, {}).batch, (std::vector<double>{0, 0}));
}

TEST(ViewDistance, CountsTheViewsOfASequence) {
  const std::vector<View> given = {nadir(0, 0, 1)}, views = {nadir(0, 2, 1)};
  std::vector<double> out(1);
  ViewDistance<>{}.prepare(archetype::Map{}, Situation{}, Rng{})(given, views, out);
  EXPECT_EQ(out[0], 2);
}

TEST(VarianceReduction, IsTheMapsForecast) {
  const std::vector<View> given = {nadir(1, 0, 1)}, views = {nadir(0.5, 0, 1), nadir(-0.5, 0, 1)};
  std::vector<double> out(2), forecast(2);
  const archetype::Forecasting<> map;
  map.forecast(given, views, forecast);
  VarianceReduction{}.prepare(map, Situation{}, Rng{})(given, views, out);
  EXPECT_EQ(out, forecast);
}

/// Uncertain on one half of the image.
struct Halved : archetype::Map {
  void render(const View&, const Camera& camera, Rendering<channel::Uncertainty>& out) const {
    out.uncertainty.setZero(camera.height, camera.width);
    out.uncertainty.leftCols(camera.width / 2) = 3;
  }
};
TEST(MeanUncertainty, IsTheMeanOverTheImage) {
  EXPECT_DOUBLE_EQ(MeanUncertainty(Camera::from_fov(10, 7, 1))(Halved{}, View{}), 1.5);
}
TEST(MeanUncertainty, RefusesABadCamera) {
  EXPECT_THROW(MeanUncertainty(Camera{}), Error);
  EXPECT_NO_THROW(MeanUncertainty{});
}

}  // namespace
}  // namespace vantage::test
