// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include <vantage/sampler/view_cone.hpp>

#include "drawn_voxels.hpp"

namespace vantage {
namespace {

using Voxel = std::array<int, 3>;

Eigen::Vector3d direction(Rng& rng) {
  const double x = rng.normal(), y = rng.normal();
  return Eigen::Vector3d(x, y, rng.normal()).normalized();
}
Voxel key(const Eigen::Vector3i& v) { return {v.x(), v.y(), v.z()}; }

/// Free everywhere but for some voxels here and there; edges differ.
test::DrawnVoxels speckled(std::uint64_t seed) {
  test::DrawnVoxels map(VoxelGrid::dividing({Eigen::Vector3d(-1, 2, 0), Eigen::Vector3d(3.3, 5.1, 2)}, 0.21), 0.25);
  Rng rng(seed);
  map.draw_all([&](const Eigen::Vector3i&) { return rng.uniform() < 0.02 ? Space::occupied : Space::free; });
  return map;
}
std::set<Voxel> reference(const test::DrawnVoxels& map, const Region& region, const ViewCone& cone) {
  std::set<Voxel> found;
  for (std::uint64_t i = 0; i < map.grid().count(); ++i) {
    const Eigen::Vector3i n = map.grid().size(), v(static_cast<int>(i) % n.x(), static_cast<int>(i) / n.x() % n.y(),
                                                   static_cast<int>(i) / n.x() / n.y());
    const Eigen::Vector3d d = map.grid().centre(v) - region.centre;
    if (map.navigable(v) && d.norm() >= cone.nearest_m && d.norm() <= cone.farthest_m &&
        d.dot(region.normal) >= cone.min_cosine * d.norm())
      found.insert(key(v));
  }
  return found;
}
ViewCone random_cone(Rng& rng) {
  const double nearest_m = rng.uniform(0.05, 0.8);
  return {nearest_m, nearest_m + rng.uniform(0, 2.5), rng.uniform(-1, 1)};
}
Region random_region(Rng& rng) {
  const double x = rng.uniform(-2, 4), y = rng.uniform(1, 6);
  const Eigen::Vector3d centre(x, y, rng.uniform(-1, 3));
  return {centre, direction(rng)};
}

TEST(ViewCone, FindsWhatASearchOfAllVoxelsFinds) {
  const test::DrawnVoxels map = speckled(1);
  Rng rng(2);
  std::size_t found = 0;
  for (int i = 0; i < 60; ++i) {
    const Region region = random_region(rng);
    const ViewCone cone = random_cone(rng);
    std::set<Voxel> named;
    for_each_in_cone(map, region, cone,
                     [&](const Eigen::Vector3i& v) { EXPECT_TRUE(named.insert(key(v)).second) << v.transpose(); });
    EXPECT_EQ(named, reference(map, region, cone));
    found += named.size();
  }
  EXPECT_GT(found, 1000u);
}

TEST(ViewCone, AroundAndOutsideOfTheGrid) {
  const test::DrawnVoxels map = speckled(1);
  int named = 0;
  const auto count = [&](const Eigen::Vector3i&) { ++named; };
  for_each_in_cone(map, {{1e12, -1e12, 5}, Eigen::Vector3d::UnitX()}, ViewCone{}, count);
  EXPECT_EQ(named, 0);
  for_each_in_cone(map, {{1, 3, 1}, Eigen::Vector3d::UnitX()}, {.nearest_m = 0.01, .farthest_m = 1e6, .min_cosine = -1},
                   count);
  EXPECT_EQ(static_cast<std::size_t>(named),
            reference(map, {{1, 3, 1}, Eigen::Vector3d::UnitX()}, {0.01, 1e6, -1}).size());
}

TEST(ViewCone, ItsBoundsHoldAllOfIt) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const Region region = random_region(rng);
    const ViewCone cone = random_cone(rng);
    const Eigen::Vector3d p = region.centre + rng.uniform(0, 3.5) * direction(rng);
    if (!cone.contains(region, p)) continue;
    EXPECT_TRUE(cone.box(region).contains(p));
    const double radius_m = rng.uniform(0, 1);
    EXPECT_TRUE(cone.may_contain(region, p + radius_m * direction(rng), radius_m));
  }
}

TEST(ViewCone, BordersBelongToIt) {
  const Region region{{1, 1, 1}, Eigen::Vector3d(1, 0, 1).normalized()};
  const ViewCone cone;
  EXPECT_TRUE(cone.contains(region, {1 + 0.3, 1, 1}) && cone.contains(region, {1 + 0.1 + 0.2, 1, 1}));
  EXPECT_TRUE(cone.contains(region, {1 + 2.0, 1, 1}));
  EXPECT_TRUE(cone.contains(region, {1.4, 1.4, 1}));  // 60 degrees off
  EXPECT_FALSE(cone.contains(region, {1.4, 1.41, 1}));
  EXPECT_FALSE(cone.contains(region, {1.299, 1, 1}) || cone.contains(region, {3.001, 1, 1}));
}

/// How often each voxel is drawn, each of them in how many rounds.
std::map<Voxel, int> draws(const test::DrawnVoxels& map, const Region& region, const ViewCone& cone, std::size_t n,
                           int rounds) {
  std::map<Voxel, int> count;
  std::vector<Eigen::Vector3i> drawn;
  for (int i = 0; i < rounds; ++i) {
    Rng rng(static_cast<std::uint64_t>(i));
    draw_in_cone(map, region, cone, n, rng, drawn);
    std::set<Voxel> different;
    for (const Eigen::Vector3i& v : drawn) ++count[key(v)], different.insert(key(v));
    EXPECT_EQ(different.size(), drawn.size());
  }
  return count;
}
void expect_uniform(const std::map<Voxel, int>& count, const std::set<Voxel>& all, std::size_t n, int rounds) {
  double chi_square = 0;
  const double p = static_cast<double>(n) / static_cast<double>(all.size()), expected = rounds * p;
  for (const Voxel& v : all) {
    const double times = count.contains(v) ? count.at(v) : 0;
    chi_square += (times - expected) * (times - expected) / (expected * (1 - p));
  }
  const double freedom = static_cast<double>(all.size() - 1);
  EXPECT_LT(std::abs(chi_square - freedom), 5 * std::sqrt(2 * freedom));
  for (const auto& [v, times] : count) EXPECT_TRUE(all.contains(v));
}

TEST(DrawInCone, EveryVoxelIsAsLikelyWhereManyWillDo) {
  const test::DrawnVoxels map = speckled(4);
  const Region region{{1, 3.5, 0.6}, Eigen::Vector3d(0.2, -0.1, 1).normalized()};
  const ViewCone cone{.nearest_m = 0.3, .farthest_m = 1.2, .min_cosine = 0.5};
  const std::set<Voxel> all = reference(map, region, cone);
  ASSERT_GT(all.size(), 20u);
  expect_uniform(draws(map, region, cone, 3, 1000), all, 3, 1000);
}

TEST(DrawInCone, EveryVoxelIsAsLikelyWhereFewWillDo) {
  // Free in one corner of the cone only: guesses fail, and the reservoir draws.
  test::DrawnVoxels map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(8, 8, 8)}, 0.2), 0.01);
  map.draw_all([](const Eigen::Vector3i& v) {
    return v.x() > 30 && v.y() > 18 && v.y() < 22 && v.z() > 16 && v.z() < 22 ? Space::free : Space::unknown;
  });
  const Region region{{4, 4, 4}, Eigen::Vector3d::UnitX()};
  const ViewCone cone{.nearest_m = 0.3, .farthest_m = 3, .min_cosine = 0.5};
  const std::set<Voxel> all = reference(map, region, cone);
  ASSERT_GT(all.size(), 40u);
  ASSERT_LT(all.size(), 100u);
  expect_uniform(draws(map, region, cone, 4, 400), all, 4, 400);
  expect_uniform(draws(map, region, cone, 1, 1000), all, 1, 1000);
}

TEST(DrawInCone, AllWhereThereAreNoMore) {
  const test::DrawnVoxels map = speckled(5);
  const Region region{{1, 3.5, 0.6}, Eigen::Vector3d(0.2, -0.1, 1).normalized()};
  const ViewCone cone{.nearest_m = 0.3, .farthest_m = 0.5, .min_cosine = 0.5};
  const std::set<Voxel> all = reference(map, region, cone);
  ASSERT_FALSE(all.empty());
  Rng rng(6);
  std::vector<Eigen::Vector3i> drawn;
  draw_in_cone(map, region, cone, all.size() + 3, rng, drawn);
  std::set<Voxel> found;
  for (const Eigen::Vector3i& v : drawn) found.insert(key(v));
  EXPECT_EQ(found, all);
  EXPECT_EQ(drawn.size(), all.size());
}

}  // namespace
}  // namespace vantage
