// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <type_traits>
#include <vector>

#include <vantage/sampler/local.hpp>
#include <vantage/sampler/roi_and_local.hpp>

#include "message_of.hpp"
#include "sampler_maps.hpp"
#include "tight_box.hpp"

namespace vantage {
namespace {

const View here = look_at({2.5, 1.5, 1}, {3, 1.5, 1});

/// The two rooms with a badly reconstructed wall as well.
struct Walls : test::DrawnFrontiers {
  std::vector<Region> bad;
  Walls() : test::DrawnFrontiers(test::two_rooms()) {}
  using test::DrawnFrontiers::regions;
  [[nodiscard]] std::vector<Region> regions(low_confidence) const { return bad; }
};

/// The regions that views look at: in the order of the first view of each, and how many.
std::vector<std::pair<std::size_t, int>> targets(const std::vector<Region>& regions, Views views) {
  std::vector<std::pair<std::size_t, int>> found;
  for (const View& v : views) {
    const auto in = std::find_if(regions.begin(), regions.end(), [&](const Region& r) {
      return v.forward().isApprox((r.centre - v.position()).normalized(), 1e-12);
    });
    if (in == regions.end()) break;
    const auto i = static_cast<std::size_t>(in - regions.begin());
    if (found.empty() || found.back().first != i) found.push_back({i, 0});
    ++found.back().second;
  }
  return found;
}

TEST(RoiAndLocal, LooksAtTheNearestRegionsFromTheirCones) {
  const test::DrawnFrontiers map = test::two_rooms();
  std::vector<Region> regions = map.regions(frontier{});
  ASSERT_GT(regions.size(), 30u);
  const auto distance = [&](const Region& r) { return (r.centre - here.position()).norm(); };
  std::sort(regions.begin(), regions.end(),
            [&](const Region& a, const Region& b) { return distance(a) < distance(b) - 1e-12; });
  const std::vector<View> views = test::sample(RoiAndLocal<frontier>{}, map, {.here = here}, 1).views;
  ASSERT_EQ(views.size(), 100u);
  const auto looked = targets(regions, Views(views).first(30));
  ASSERT_EQ(looked.size(), 6u);
  double before = 0;
  std::size_t i = 0;
  for (const auto& [region, count] : looked) {
    EXPECT_EQ(count, 5);
    EXPECT_GE(distance(regions[region]), before - 1e-9);
    before = distance(regions[region]);
    for (int k = 0; k < count; ++k, ++i) {
      EXPECT_TRUE(ViewCone{}.contains(regions[region], views[i].position()));
      EXPECT_TRUE(map.navigable(map.grid().voxel_at(views[i].position())));
    }
  }
  // Nearer ones were left out only for want of a position.
  for (const Region& r : regions)
    if (distance(r) < before - 1e-9 && targets({r}, views).empty())
      for_each_in_cone(map, r, ViewCone{}, [&](const auto& v) {
        const bool looked_at = std::any_of(looked.begin(), looked.end(),
                                           [&](const auto& l) { return regions[l.first].centre == r.centre; });
        EXPECT_TRUE(looked_at) << v.transpose();
      });
  for (std::size_t k = 30; k < 100; ++k) EXPECT_LE(distance_m(views[k], here), 0.5 + 1e-9);
}

TEST(RoiAndLocal, KindsCountTogetherAndOnceAPlace) {
  Walls map;
  const std::vector<Region> frontiers = map.regions(frontier{});
  map.bad.push_back({map.grid().centre({15, 3, 5}), -Eigen::Vector3d::UnitX()});  // the wall beside the door
  for (const Region& r : frontiers) map.bad.push_back({r.centre, Eigen::Vector3d::UnitZ()});
  const RoiAndLocalConfig config{.candidates = 4000, .from_regions = 4000, .per_region = 2};
  std::vector<Region> all = frontiers;
  all.push_back(map.bad.front());
  const auto both =
      targets(all, test::sample(RoiAndLocal<frontier, low_confidence>(config), map, {.here = here}, 1).views);
  EXPECT_EQ(both.front().first, frontiers.size());  // the nearest
  const auto one = targets(all, test::sample(RoiAndLocal<frontier>(config), map, {.here = here}, 1).views);
  EXPECT_EQ(both.size(), one.size() + 1);
  for (const auto& [region, count] : both) EXPECT_LE(count, 2);
}

TEST(RoiAndLocal, LocalViewsWhereThereIsNoRegion) {
  Walls map;
  const std::vector<View> views = test::sample(RoiAndLocal<low_confidence>{}, map, {.here = here}, 1).views;
  ASSERT_EQ(views.size(), 100u);
  for (const View& v : views) EXPECT_LE(distance_m(v, here), 0.5 + 1e-9);
}

TEST(RoiAndLocal, TurnsOnTheSpotInABoxThatIsSmallerThanTheBody) {
  const VoxelMap<> map = test::tight_box();
  ASSERT_EQ(map.counts().navigable, 0u);
  ASSERT_FALSE(map.regions(frontier{}).empty());
  const View start = look_at({0.15, 0.25, 0.25}, {1, 0.25, 0.25});
  for (const std::vector<View>& views : {test::sample(RoiAndLocal<frontier>{}, map, {.here = start}, 1).views,
                                         test::sample(Local{}, map, {.here = start}, 1).views}) {
    EXPECT_EQ(views.size(), 100u);
    for (const View& v : views) EXPECT_TRUE(same_place(v, start));
  }
}

TEST(RoiAndLocal, TakesBothKindsUnlessToldOtherwise) {
  static_assert(std::is_same_v<decltype(RoiAndLocal{}), RoiAndLocal<frontier, low_confidence>>);
  static_assert(std::is_same_v<decltype(RoiAndLocal{RoiAndLocalConfig{}}), RoiAndLocal<frontier, low_confidence>>);
  static_assert(needs_met<Walls, RoiAndLocal<frontier, low_confidence>> &&
                !needs_met<test::DrawnFrontiers, RoiAndLocal<frontier, low_confidence>> &&
                needs_met<test::DrawnFrontiers, RoiAndLocal<frontier>> &&
                !needs_met<test::DrawnVoxels, RoiAndLocal<frontier>>);
  EXPECT_EQ(test::sample(RoiAndLocal{}, Walls(), {.here = here}, 1).views.size(), 100u);
}

TEST(RoiAndLocal, RefusesBadConfigsAllAtOnce) {
  const std::string message = test::message_of([] {
    RoiAndLocal<frontier>({.candidates = 10,
                           .from_regions = 11,
                           .per_region = 0,
                           .cone = {.nearest_m = 2, .farthest_m = 1, .min_cosine = 1.1},
                           .radius_m = 0});
  });
  for (const char* name : {"from_regions", "per_region", "cone.farthest_m", "cone.min_cosine", "radius_m"})
    EXPECT_NE(message.find(name), std::string::npos) << message;
  EXPECT_THROW(RoiAndLocal<frontier>({.cone = {.nearest_m = 0}}), Error);
}

}  // namespace
}  // namespace vantage
