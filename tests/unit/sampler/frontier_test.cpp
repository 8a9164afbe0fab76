// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <tuple>
#include <vector>

#include <vantage/loop/nbv_loop.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/sampler/frontier.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/utility/unexplored.hpp>

#include "message_of.hpp"
#include "sampler_maps.hpp"
#include "tight_box.hpp"

namespace vantage {
namespace {

const View here = look_at({0.5, 1.5, 1}, {3, 1.5, 1});

/// The region that a view looks at; null if none.
const Region* target(const std::vector<Region>& regions, const View& v) {
  for (const Region& r : regions)
    if (ViewCone{}.contains(r, v.position()) && v.forward().isApprox((r.centre - v.position()).normalized(), 1e-12))
      return &r;
  return nullptr;
}
/// Whether a ray passes free voxels only, by small steps.
bool sees(const test::DrawnVoxels& map, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  for (int i = 1; i < 1000; ++i)
    if (map.at(from + i * 0.001 * (to - from)) != Space::free) return false;
  return true;
}

TEST(FrontierSampler, LooksAtFrontiersFromWhereTheyAreSeen) {
  const test::DrawnFrontiers map = test::two_rooms();
  const std::vector<Region> regions = map.regions(frontier{});
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const std::vector<View> views = test::sample(Frontier{}, map, {.here = here}, seed).views;
    EXPECT_GT(views.size(), 20u);
    std::set<const Region*> looked;
    for (const View& v : views) {
      const Region* region = target(regions, v);
      ASSERT_NE(region, nullptr);
      EXPECT_TRUE(looked.insert(region).second);  // each voxel once
      EXPECT_TRUE(map.navigable(map.grid().voxel_at(v.position())));
      EXPECT_TRUE(sees(map, v.position(), region->centre));
    }
  }
}

/// A corridor along x whose sides are unknown here and there: many frontiers, near and far.
test::DrawnFrontiers corridor() {
  test::DrawnFrontiers map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(16, 3, 2)}, 0.2), 0.2);
  const Eigen::Vector3i last = map.grid().size() - Eigen::Vector3i::Ones();
  for (int z = 0; z <= last.z(); ++z)
    for (int y = 0; y <= last.y(); ++y)
      for (int x = 0; x <= last.x(); ++x) {
        const bool shell = x == 0 || y == 0 || y == last.y() || z == 0 || z == last.z();
        if (y == last.y() && x % 20 >= 10 && x % 20 < 15) continue;  // five gaps of 1 m, 4 m apart
        map.draw({x, y, z}, shell ? Space::occupied : Space::free);
      }
  return map;
}

TEST(FrontierSampler, SpreadsOverNearAndFarFrontiers) {
  const test::DrawnFrontiers map = corridor();
  for (const int candidates : {8, 40, 100}) {
    const auto views = test::sample(Frontier({.candidates = candidates}), map, {.here = here}, 1).views;
    EXPECT_EQ(views.size(), static_cast<std::size_t>(candidates));
    std::set<int> gaps;
    for (const View& v : views) gaps.insert(static_cast<int>(v.position().x() / 4));
    EXPECT_EQ(gaps.size(), 4u);
  }
  // Fewer than there are clusters: the nearest ones.
  for (const View& v : test::sample(Frontier({.candidates = 2}), map, {.here = here}, 1).views)
    EXPECT_LT(v.position().x(), 5);
}

TEST(FrontierSampler, ProposesNothingInABoxThatIsSmallerThanTheBody) {
  const VoxelMap<> map = test::tight_box();
  ASSERT_EQ(map.counts().navigable, 0u);
  ASSERT_EQ(map.regions(frontier{}).size(), 16u);
  const View start = look_at({0.15, 0.25, 0.25}, {1, 0.25, 0.25});
  EXPECT_TRUE(test::sample(Frontier{}, map, {.here = start}, 1).views.empty());
  NbvLoop loop{map, Unexplored{}, Frontier{}, TravelTradeoff{AStar{}}};
  Rng rng(1);
  EXPECT_FALSE(loop.plan({.here = start}, rng));
}

TEST(FrontierSampler, LeavesCrumbsOut) {
  test::DrawnFrontiers map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 2)}, 0.2), 0.2);
  map.draw_all([](const Eigen::Vector3i&) { return Space::free; });
  EXPECT_TRUE(test::sample(Frontier{}, map, {.here = here}, 1).views.empty());  // all is known
  test::DrawnFrontiers holed(map.grid(), 0.2);
  for (int z = 0; z < map.grid().size().z(); ++z)
    for (int y = 0; y < map.grid().size().y(); ++y)
      for (int x = 0; x < map.grid().size().x(); ++x)
        if (!(x == 7 && y == 7 && z == 7) && !(x > 12 && x < 17 && y > 9)) holed.draw({x, y, z}, Space::free);
  const std::vector<Region> regions = holed.regions(frontier{});
  const auto count = [&](double smallest_m2) {
    const auto views = test::sample(Frontier({.smallest_m2 = smallest_m2}), holed, {.here = here}, 1).views;
    EXPECT_FALSE(views.empty());
    return std::count_if(views.begin(), views.end(), [&](const View& v) {
      return (target(regions, v)->centre - holed.grid().centre({7, 7, 7})).norm() < 0.25;
    });
  };
  EXPECT_GT(count(0), 0);
  EXPECT_EQ(count(0.5), 0);  // six voxels around the hole are 0.24 m^2
}

TEST(FrontierSampler, NothingWhereNoPositionSeesIt) {
  // A free pocket behind the wall, of which the robot cannot see the frontier.
  test::DrawnFrontiers map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 2)}, 0.2), 0.2);
  for (int z = 0; z < 10; ++z)
    for (int y = 0; y < 15; ++y)
      for (int x = 0; x < 20; ++x)
        if (x < 12) map.draw({x, y, z}, x < 11 ? Space::free : Space::occupied);
  for (int z = 3; z < 7; ++z)
    for (int y = 2; y < 8; ++y)
      for (int x = 12; x < 14; ++x) map.draw({x, y, z}, Space::free);
  ASSERT_GT(map.regions(frontier{}).size(), 20u);
  EXPECT_TRUE(test::sample(Frontier{}, map, {.here = here}, 1).views.empty());
}

TEST(FrontierSampler, NothingWhereTheRobotCannotGo) {
  // A window between two rooms: what is unknown in the far one can be seen, but only from there.
  test::DrawnFrontiers map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(6, 3, 2)}, 0.2), 0.2);
  for (int z = 0; z < 10; ++z)
    for (int y = 0; y < 15; ++y)
      for (int x = 0; x < 26; ++x) map.draw({x, y, z}, x == 11 && (y != 7 || z > 5) ? Space::occupied : Space::free);
  EXPECT_TRUE(test::sample(Frontier{}, map, {.here = here}, 1).views.empty());
  const View there = look_at({3.5, 1.5, 1}, {5, 1.5, 1});
  EXPECT_FALSE(test::sample(Frontier{}, map, {.here = there}, 1).views.empty());
  EXPECT_TRUE(test::sample(Frontier{}, map, {.here = look_at({-1, 1.5, 1}, {5, 1.5, 1})}, 1).views.empty());
}

TEST(FrontierSampler, ARobotThatDoesNotFitLeavesItsPlace) {
  // Unknown around the robot: its own ball leads out.
  test::DrawnFrontiers map = test::two_rooms();
  const Eigen::Vector3i start(4, 7, 5);
  for (int k = 0; k < 27; ++k) map.draw(start + Eigen::Vector3i(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1), Space::unknown);
  const View stuck = look_at(map.grid().centre(start), {5, 1.5, 1});
  EXPECT_FALSE(test::sample(Frontier({.own_ball_m = 0.5}), map, {.here = stuck}, 1).views.empty());
  EXPECT_TRUE(test::sample(Frontier({.own_ball_m = 0}), map, {.here = stuck}, 1).views.empty());
}

TEST(FrontierSampler, FindsTheLittleThatIsSeenOfMuch) {
  // Of a wide frontier only little can be seen, through a hole in the wall before it.
  test::DrawnFrontiers map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 3, 2)}, 0.2), 0.3);
  for (int z = 0; z < 10; ++z)
    for (int y = 0; y < 15; ++y)
      for (int x = 0; x < 14; ++x) map.draw({x, y, z}, x == 11 && !(y == 7 && z == 5) ? Space::occupied : Space::free);
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto views = test::sample(Frontier{}, map, {.here = here}, seed).views;
    ASSERT_FALSE(views.empty());
    for (const View& v : views) EXPECT_LT(v.position().x(), 2.2);
  }
}

TEST(FrontierSampler, GivesUpWhatLookingDoesNotResolve) {
  const test::DrawnFrontiers map = test::two_rooms();
  std::vector<View> visited;
  std::size_t steps = 0;
  for (; steps < 500; ++steps) {
    const auto views = test::sample(Frontier{}, map, {.here = here, .visited = visited}, steps).views;
    if (views.empty()) break;
    visited.push_back(views.front());
  }
  EXPECT_LT(steps, 200u);  // a map that never changes is not looked at for ever
  EXPECT_GE(steps, 3u);
  for (const Region& r : map.regions(frontier{})) {
    const auto looks = [&](const View& v) {
      return v.forward().dot((r.centre - v.position()).normalized()) >= std::cos(deg(15)) - 1e-9 &&
             ViewCone{}.contains(r, v.position());
    };
    std::vector<Eigen::Vector3i> drawn;
    Rng rng(1);
    draw_in_cone(map, r, ViewCone{}, 1, rng, drawn);
    if (!drawn.empty() && sees(map, map.grid().centre(drawn[0]), r.centre)) {
      EXPECT_GE(std::count_if(visited.begin(), visited.end(), looks), 3);
    }
  }
  EXPECT_FALSE(test::sample(Frontier({.most_looks = 1000}), map, {.here = here, .visited = visited}, 1).views.empty());
}

TEST(FrontierSampler, SameSeedSameViewsOtherSeedOthers) {
  const test::DrawnFrontiers map = test::two_rooms();
  const auto views = [&](std::uint64_t seed) { return test::sample(Frontier{}, map, {.here = here}, seed).views; };
  const auto a = views(1), b = views(1), c = views(2);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].T_W_C.matrix(), b[i].T_W_C.matrix());
  EXPECT_FALSE(same_place(a[0], c[0]) && same_place(a[1], c[1]) && same_place(a[2], c[2]));
}

TEST(FrontierSampler, RefusesBadConfigsAllAtOnce) {
  const std::string message = test::message_of([] {
    Frontier({.candidates = 0,
              .cone = {.nearest_m = -1},
              .cell_m = 0,
              .smallest_m2 = -1,
              .own_ball_m = -1,
              .most_looks = 0,
              .looked_rad = 0});
  });
  for (const char* name :
       {"candidates", "cone.nearest_m", "cell_m", "smallest_m2", "own_ball_m", "most_looks", "looked_rad"})
    EXPECT_NE(message.find(name), std::string::npos) << message;
}

}  // namespace
}  // namespace vantage
