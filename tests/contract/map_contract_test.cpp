// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <thread>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/core/bytes.hpp>

#include "maps.hpp"
#include "suite.hpp"

// What the map concepts mean, over every map. Each capability has a suite of its own over the maps that offer it.
namespace vantage::test {
namespace {

constexpr std::size_t measured = 6;

using UncertainMaps = SuiteOf<PersistentMaps, need::Uncertainty>;
using DepthMaps = SuiteOf<PersistentMaps, need::Depth>;
using ForecastMaps = SuiteOf<PersistentMaps, need::Forecast>;
using CoverageMaps = SuiteOf<PersistentMaps, need::Coverage>;
using FieldMaps = SuiteOf<PersistentMaps, need::Field>;
using OccupancyMaps = SuiteOf<PersistentMaps, need::Occupancy>;
using RegionMaps = SuiteOf<PersistentMaps, need::Regions<frontier>>;
using LowConfidenceMaps = SuiteOf<PersistentMaps, need::Regions<low_confidence>>;
using SemanticMaps = SuiteOf<PersistentMaps, need::Channels<channel::Semantics>>;
using FisherMaps = SuiteOf<PersistentMaps, need::Fisher>;

template <class M>
std::vector<std::byte> bytes(const M& map) {
  Sink sink;
  map.save(sink);
  return std::move(sink).take();
}
template <class M>
M after(std::size_t measurements, M map = MapFixture<M>::make()) {
  for (std::size_t k = 0; k < measurements; ++k) {
    Rng rng = Rng(7).fork(k);
    map.integrate(MapFixture<M>::measurement(k), rng);
  }
  return map;
}
template <class M>
M large() {
  if constexpr (requires { MapFixture<M>::large(); })
    return MapFixture<M>::large();
  else
    return MapFixture<M>::make();
}
template <class M>
std::vector<double> forecast(const M& map, Views given, Views views) {
  std::vector<double> reduction(views.size(), -1);
  map.forecast(given, views, reduction);
  return reduction;
}
template <class M>
Image<float> uncertainty(const M& map, const View& view) {
  Rendering<channel::Uncertainty> out;
  map.render(view, Camera::from_fov(12, 9, deg(70)), out);
  return out.uncertainty;
}

template <class M>
std::vector<Image<float>> classes(const M& map, const View& view) {
  Rendering<channel::Semantics> out;
  map.render(view, Camera::from_fov(12, 9, deg(70)), out);
  return out.probability;
}

template <class M>
class MapContract : public testing::Test {};
TYPED_TEST_SUITE(MapContract, Suite<PersistentMaps>);

TYPED_TEST(MapContract, LearnsSomething) { EXPECT_NE(bytes(after<TypeParam>(0)), bytes(after<TypeParam>(1))); }

TYPED_TEST(MapContract, ARefusedMeasurementLeavesItUnchanged) {
  TypeParam map = after<TypeParam>(2);
  const auto before = bytes(map);
  ASSERT_FALSE(MapFixture<TypeParam>::refused().empty());
  for (const auto& [name, z] : MapFixture<TypeParam>::refused()) {
    Rng rng(1);
    EXPECT_THROW(map.integrate(z, rng), Error) << name;
    EXPECT_EQ(bytes(map), before) << name;
  }
  TypeParam undisturbed = after<TypeParam>(2);  // and it still learns as if nothing had happened
  Rng one(3), other(3);
  map.integrate(MapFixture<TypeParam>::measurement(2), one);
  undisturbed.integrate(MapFixture<TypeParam>::measurement(2), other);
  EXPECT_EQ(bytes(map), bytes(undisturbed));
}

TYPED_TEST(MapContract, BoundsAreFiniteAndNotEmpty) {
  const Box3 box = after<TypeParam>(1).bounds();
  EXPECT_TRUE(box.min().allFinite());
  EXPECT_TRUE(box.max().allFinite());
  EXPECT_FALSE(box.isEmpty());
}

TYPED_TEST(MapContract, SavesAndLoadsEverything) {
  const TypeParam map = after<TypeParam>(measured);
  const auto saved = bytes(map);
  TypeParam loaded = MapFixture<TypeParam>::make();
  Source source(saved);
  loaded.load(source);
  source.done();
  EXPECT_EQ(bytes(loaded), saved);
  TypeParam original = map;  // it goes on as the original does
  Rng one(5), other(5);
  original.integrate(MapFixture<TypeParam>::measurement(measured), one);
  loaded.integrate(MapFixture<TypeParam>::measurement(measured), other);
  EXPECT_EQ(bytes(loaded), bytes(original));
}

TYPED_TEST(MapContract, RefusesWhatIsCutShort) {
  const auto saved = bytes(after<TypeParam>(measured));
  TypeParam map = after<TypeParam>(1);
  const auto before = bytes(map);
  for (std::size_t k = 0; k < 24; ++k) {  // the first bytes, where the sizes are, and samples of the rest
    const std::size_t length =
        k < 12 ? k * std::min<std::size_t>(8, saved.size() / 12) : saved.size() - 1 - (k - 12) * (saved.size() / 13);
    Source source(std::span<const std::byte>(saved).first(length));
    EXPECT_THROW(map.load(source), Error) << length << " of " << saved.size() << " bytes";
    EXPECT_EQ(bytes(map), before) << length;
  }
}

TYPED_TEST(MapContract, TheSameBitsWithAnyNumberOfThreads) {
  const std::vector<View> views = MapFixture<TypeParam>::views();
  const auto mission = [&] {
    const TypeParam map = after(measured, large<TypeParam>());
    std::vector<float> pixels;
    std::vector<double> reductions;
    for (const View& v : views) {
      if constexpr (UncertainMap<TypeParam>) {
        const Image<float> image = uncertainty(map, v);
        pixels.insert(pixels.end(), image.data(), image.data() + image.size());
      }
    }
    if constexpr (ForecastMap<TypeParam>) reductions = forecast(map, {}, views);
    return std::tuple(bytes(map), pixels, reductions);
  };
  const auto one = with_threads(1, mission);
  EXPECT_TRUE(one == with_threads(2, mission));
  EXPECT_TRUE(one == with_threads(8, mission));
}

TYPED_TEST(MapContract, MayBeAskedFromSeveralThreads) {
  const TypeParam map = after<TypeParam>(measured);
  const std::vector<View> views = MapFixture<TypeParam>::views();
  const auto ask = [&] {
    std::vector<double> answers;
    for (const View& v : views) {
      if constexpr (UncertainMap<TypeParam>) answers.push_back(uncertainty(map, v).sum());
      if constexpr (ForecastMap<TypeParam>) answers.push_back(forecast(map, {}, {&v, 1}).front());
      if constexpr (CoverageMap<TypeParam>) answers.push_back(map.coverage());
    }
    return answers;
  };
  const std::vector<double> alone = ask();
  std::vector<std::vector<double>> answers(3);
  std::vector<std::thread> threads;
  for (auto& a : answers) threads.emplace_back([&] { a = ask(); });
  for (auto& t : threads) t.join();
  for (const auto& a : answers) EXPECT_EQ(a, alone);
}

template <class M>
class UncertainMapContract : public testing::Test {};
TYPED_TEST_SUITE(UncertainMapContract, UncertainMaps);

TYPED_TEST(UncertainMapContract, RendersUncertaintyFiniteAndNotNegative) {
  for (const std::size_t n : {std::size_t{0}, measured}) {
    const TypeParam map = after<TypeParam>(n);
    for (const View& v : MapFixture<TypeParam>::views()) {
      const Image<float> image = uncertainty(map, v);
      ASSERT_EQ(image.rows(), 9);
      ASSERT_EQ(image.cols(), 12);
      EXPECT_TRUE(image.isFinite().all());
      EXPECT_GE(image.minCoeff(), 0);
    }
  }
}

TYPED_TEST(UncertainMapContract, IsLessUncertainWhereItHasMeasured) {
  const View v = MapFixture<TypeParam>::measurement(0).view;
  EXPECT_LT(uncertainty(after<TypeParam>(1), v).mean(), uncertainty(after<TypeParam>(0), v).mean());
}

template <class M>
class DepthMapContract : public testing::Test {};
TYPED_TEST_SUITE(DepthMapContract, DepthMaps);

TYPED_TEST(DepthMapContract, RendersDepthInFrontOfTheCamera) {
  for (const View& v : MapFixture<TypeParam>::views()) {
    Rendering<channel::Depth> out;
    after<TypeParam>(measured).render(v, Camera::from_fov(12, 9, deg(70)), out);
    ASSERT_EQ(out.depth.rows(), 9);
    ASSERT_EQ(out.depth.cols(), 12);
    EXPECT_TRUE((out.depth.isNaN() || out.depth > 0).all());
  }
}

template <class M>
class SemanticMapContract : public testing::Test {};
TYPED_TEST_SUITE(SemanticMapContract, SemanticMaps);

TYPED_TEST(SemanticMapContract, RendersADistributionOverClasses) {
  for (const std::size_t n : {std::size_t{0}, measured}) {
    const TypeParam map = after<TypeParam>(n);
    for (const View& v : MapFixture<TypeParam>::views()) {
      const std::vector<Image<float>> images = classes(map, v);
      ASSERT_GE(images.size(), 2u);
      Image<float> sum = Image<float>::Zero(9, 12);
      for (const Image<float>& of_class : images) {
        ASSERT_EQ(of_class.rows(), 9);
        ASSERT_EQ(of_class.cols(), 12);
        EXPECT_TRUE((of_class >= 0 && of_class <= 1).all());
        sum += of_class;
      }
      EXPECT_TRUE(((sum - 1).abs() < 1e-4F).all());
    }
  }
}

TYPED_TEST(SemanticMapContract, TheSameBitsWithAnyNumberOfThreadsAndAskedBySeveral) {
  const View v = MapFixture<TypeParam>::views().front();
  const auto same = [](const std::vector<Image<float>>& a, const std::vector<Image<float>>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const Image<float>& x, const Image<float>& y) { return (x == y).all(); });
  };
  const auto mission = [&] { return classes(after(measured, large<TypeParam>()), v); };
  const auto one = with_threads(1, mission);
  for (const int n : {2, 8}) EXPECT_TRUE(same(one, with_threads(n, mission)));
  const TypeParam map = after(measured, large<TypeParam>());
  std::vector<std::vector<Image<float>>> answers(3);
  std::vector<std::thread> threads;
  for (auto& a : answers) threads.emplace_back([&] { a = classes(map, v); });
  for (auto& t : threads) t.join();
  for (const auto& a : answers) EXPECT_TRUE(same(one, a));
}

template <class M>
class ForecastMapContract : public testing::Test {};
TYPED_TEST_SUITE(ForecastMapContract, ForecastMaps);

TYPED_TEST(ForecastMapContract, ForecastsFiniteAndNotNegative) {
  const std::vector<View> views = MapFixture<TypeParam>::views();
  for (const std::size_t n : {std::size_t{0}, measured}) {
    const TypeParam map = after<TypeParam>(n);
    const auto before = bytes(map);
    for (const Views given : {Views{}, Views(views).first(2)})
      for (const double r : forecast(map, given, views)) {
        EXPECT_TRUE(std::isfinite(r));
        EXPECT_GE(r, 0);
      }
    EXPECT_TRUE(forecast(map, views, {}).empty());
    EXPECT_EQ(bytes(map), before);
  }
  const std::vector<double> promising = forecast(after<TypeParam>(0), {}, views);
  EXPECT_GT(*std::max_element(promising.begin(), promising.end()), 0);
}

TYPED_TEST(ForecastMapContract, ForecastsOneViewAsInABatch) {
  const std::vector<View> views = MapFixture<TypeParam>::views();
  const TypeParam map = after<TypeParam>(measured);
  const std::vector<double> batch = forecast(map, {}, views);
  for (std::size_t i = 0; i < views.size(); ++i)
    EXPECT_NEAR(forecast(map, {}, Views(views).subspan(i, 1)).front(), batch[i], 1e-9 * (1 + batch[i]));
}

TYPED_TEST(ForecastMapContract, ForecastsNoMoreFromTheSameViewAgain) {
  const TypeParam map = after<TypeParam>(2);
  for (const View& v : MapFixture<TypeParam>::views()) {
    const std::vector<View> twice = {v, v};
    const Views once = Views(twice).first(1);
    const double first = forecast(map, {}, once).front(), second = forecast(map, once, once).front(),
                 third = forecast(map, twice, once).front();
    EXPECT_LE(second, first * (1 + 1e-9));
    EXPECT_LE(third, second * (1 + 1e-9));
    EXPECT_TRUE(first == 0 || third < first);
  }
}

template <class M>
class CoverageMapContract : public testing::Test {};
TYPED_TEST_SUITE(CoverageMapContract, CoverageMaps);

TYPED_TEST(CoverageMapContract, CoverageIsAShareThatGrows) {
  TypeParam map = after<TypeParam>(0);
  double before = map.coverage();
  EXPECT_EQ(before, 0);
  for (std::size_t k = 0; k < measured; ++k) {
    Rng rng(k);
    map.integrate(MapFixture<TypeParam>::measurement(k), rng);
    const double now = map.coverage();
    EXPECT_GE(now, before);
    EXPECT_LE(now, 1);
    before = now;
  }
  EXPECT_GT(before, 0);
}

template <class M>
class FieldMapContract : public testing::Test {};
TYPED_TEST_SUITE(FieldMapContract, FieldMaps);

TYPED_TEST(FieldMapContract, CellsTileTheField) {
  for (const std::size_t n : {std::size_t{0}, measured}) {
    const TypeParam map = after<TypeParam>(n);
    const Box3 b = map.bounds();
    const Box2 ground(b.min().template head<2>(), b.max().template head<2>());
    double total = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
      const Box2 cell = map.cell(i);
      total += area(cell);
      EXPECT_TRUE(ground.contains(cell));
      EXPECT_EQ(map.cell_at(cell.center()), i);
      EXPECT_TRUE(std::isfinite(map.mean(i)));
      EXPECT_TRUE(std::isfinite(map.variance(i)));
      EXPECT_GT(map.variance(i), 0);
    }
    EXPECT_NEAR(total, area(ground), 1e-9 * area(ground));
    EXPECT_THROW((void)map.cell_at(ground.max() + Eigen::Vector2d::Ones()), Error);
    EXPECT_THROW((void)map.cell_at({nan, 0}), Error);
  }
}

template <class M>
class OccupancyMapContract : public testing::Test {};
TYPED_TEST_SUITE(OccupancyMapContract, OccupancyMaps);

TYPED_TEST(OccupancyMapContract, KnowsWhatIsOutsideItsBounds) {
  const TypeParam map = after<TypeParam>(measured);
  EXPECT_EQ(map.at(map.bounds().max() + Eigen::Vector3d::Ones()), Space::unknown);
}

template <class M>
class RegionMapContract : public testing::Test {};
TYPED_TEST_SUITE(RegionMapContract, RegionMaps);

TYPED_TEST(RegionMapContract, RegionsHaveUnitNormals) {
  std::size_t found = 0;
  for (const std::size_t n : {std::size_t{0}, std::size_t{1}})
    for (const Region& r : after<TypeParam>(n).regions(frontier{})) {
      EXPECT_TRUE(r.centre.allFinite());
      EXPECT_NEAR(r.normal.norm(), 1, 1e-9);
      ++found;
    }
  EXPECT_GT(found, 0u);
}

template <class M>
class LowConfidenceMapContract : public testing::Test {};
TYPED_TEST_SUITE(LowConfidenceMapContract, LowConfidenceMaps);

TYPED_TEST(LowConfidenceMapContract, RegionsAreVoxelsOfTheGridWithUnitNormals) {
  EXPECT_TRUE(after<TypeParam>(0).regions(low_confidence{}).empty());
  const TypeParam map = after<TypeParam>(measured);
  for (const Region& r : map.regions(low_confidence{})) {
    EXPECT_TRUE(map.bounds().contains(r.centre));
    EXPECT_NEAR(r.normal.norm(), 1, 1e-9);
  }
}

template <class M>
class FisherMapContract : public testing::Test {};
TYPED_TEST_SUITE(FisherMapContract, FisherMaps);

TYPED_TEST(FisherMapContract, FisherInformationIsAddedAndNotNegative) {
  const TypeParam map = after<TypeParam>(measured);
  std::vector<double> diagonal(map.parameters(), 2.0);
  for (const View& v : MapFixture<TypeParam>::views()) map.fisher(v, Camera::from_fov(12, 9, deg(70)), diagonal);
  for (const double d : diagonal) EXPECT_TRUE(std::isfinite(d) && d >= 2.0);
}

}  // namespace
}  // namespace vantage::test
