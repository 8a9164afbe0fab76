// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/planning/shortcut.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

#include "drawn_voxels.hpp"

namespace vantage {
namespace {

using Touched = std::set<std::tuple<int, int, int>>;
Touched touched(const VoxelGrid& grid, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Touched voxels;
  EXPECT_TRUE(every_voxel_on(grid, a, b, [&](const Eigen::Vector3i& v) {
    voxels.insert({v.x(), v.y(), v.z()});
    return true;
  }));
  return voxels;
}
/// Whether a segment comes within `margin` of a voxel's box (negative: passes so deep inside), by clipping.
bool meets(const VoxelGrid& grid, const Eigen::Vector3i& voxel, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
           double margin) {
  const Box3 box = grid.box_of(voxel);
  double enter = 0, leave = 1;
  for (int i = 0; i < 3; ++i) {
    const double low = box.min()[i] - margin, high = box.max()[i] + margin, d = b[i] - a[i];
    if (d == 0) {
      if (a[i] < low || a[i] > high) return false;
      continue;
    }
    enter = std::max(enter, std::min((low - a[i]) / d, (high - a[i]) / d));
    leave = std::min(leave, std::max((low - a[i]) / d, (high - a[i]) / d));
  }
  return enter <= leave;
}

TEST(LineOfSight, TouchesTheVoxelsThatTheSegmentMeets) {
  const VoxelGrid grid = VoxelGrid::dividing({Eigen::Vector3d(-1, 0, 2), Eigen::Vector3d(1.1, 2.3, 4)}, 0.25);
  Rng rng(1);
  const auto on_lattice = [&] {  // corners, edges and centres: half voxels
    const auto half = [&](int n) {
      return 0.5 * static_cast<double>(rng.index(static_cast<std::uint64_t>(2 * n + 1)));
    };
    const Eigen::Vector3d at(half(grid.size().x()), half(grid.size().y()), half(grid.size().z()));
    return Eigen::Vector3d(grid.origin() + grid.voxel_m().cwiseProduct(at));
  };
  const auto anywhere = [&] {
    const Box3 box = grid.box();
    return Eigen::Vector3d(rng.uniform(box.min().x(), box.max().x()), rng.uniform(box.min().y(), box.max().y()),
                           rng.uniform(box.min().z(), box.max().z()));
  };
  for (int k = 0; k < 400; ++k) {
    const bool lattice = k % 2 == 0;
    const Eigen::Vector3d a = lattice ? on_lattice() : anywhere(), b = k % 40 == 1 ? a
                                                                       : lattice   ? on_lattice()
                                                                                   : anywhere();
    const Touched found = touched(grid, a, b);
    for (int z = -1; z <= grid.size().z(); ++z)
      for (int y = -1; y <= grid.size().y(); ++y)
        for (int x = -1; x <= grid.size().x(); ++x) {
          const bool is_found = found.contains({x, y, z});
          if (meets(grid, {x, y, z}, a, b, 1e-10)) { EXPECT_TRUE(is_found) << k << ": " << x << " " << y << " " << z; }
          if (is_found) { EXPECT_TRUE(meets(grid, {x, y, z}, a, b, 1e-8)) << k << ": " << x << " " << y << " " << z; }
        }
    EXPECT_EQ(found, touched(grid, b, a));
  }
}

TEST(LineOfSight, DoesNotSlipThroughACorner) {
  const VoxelGrid grid = VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4, 4, 4)}, 1);
  // From voxel (1, 1, 1) to (2, 2, 1) along the diagonal: both others at that edge are touched.
  EXPECT_EQ(touched(grid, {1.5, 1.5, 1.5}, {2.5, 2.5, 1.5}), (Touched{{1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {2, 2, 1}}));
  EXPECT_EQ(touched(grid, {1.5, 1.5, 1.5}, {2.5, 2.5, 2.5}).size(), 8u);
  // Along a border: the voxels on either side of it.
  EXPECT_EQ(touched(grid, {1, 1.5, 1.5}, {1, 2.5, 1.5}), (Touched{{0, 1, 1}, {1, 1, 1}, {0, 2, 1}, {1, 2, 1}}));
}

TEST(Shortcut, PathsAreNotLongerEndTheSameAndStayWhereTheRobotFits) {
  const VoxelGrid grid = VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5, 4, 2.4)}, 0.2);
  const AStar router;
  const Shortcut<> straightened;
  int shorter = 0;
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    test::DrawnVoxels map(grid, 0.2);
    Rng rng(seed);
    map.draw_all([&](const Eigen::Vector3i&) { return rng.uniform() < 0.02 ? Space::occupied : Space::free; });
    std::vector<View> views;
    while (views.size() < 8) {
      const Eigen::Vector3d p(rng.uniform(0, 5), rng.uniform(0, 4), rng.uniform(0, 2.4));
      if (map.navigable(grid.voxel_at(p))) views.push_back(look_at(p, p + Eigen::Vector3d(1, rng.normal(), 0.2)));
    }
    const std::vector<double> graph_m = router.lengths_m(map, views[0], views);
    const std::vector<double> lengths_m = straightened.lengths_m(map, views[0], views);
    for (std::size_t i = 0; i < views.size(); ++i) {
      const std::vector<View> path = straightened.path(map, views[0], views[i]);
      if (std::isinf(graph_m[i])) {
        EXPECT_EQ(lengths_m[i], graph_m[i]);
        EXPECT_TRUE(path.empty());
        continue;
      }
      EXPECT_LE(lengths_m[i], graph_m[i] + 1e-9);
      EXPECT_GE(lengths_m[i], distance_m(views[0], views[i]) - 1e-9);
      shorter += lengths_m[i] < graph_m[i] - 1e-6;
      ASSERT_GE(path.size(), 2u);
      EXPECT_EQ(path.front().T_W_C.matrix(), views[0].T_W_C.matrix());
      EXPECT_EQ(path.back().T_W_C.matrix(), views[i].T_W_C.matrix());
      double sum_m = 0;
      for (std::size_t k = 1; k < path.size(); ++k) {
        sum_m += distance_m(path[k - 1], path[k]);
        const Eigen::Vector3d a = path[k - 1].position(), way = path[k].position() - a;
        for (double t = 0; t <= 1; t += 0.01)  // its own ball, or navigable
          EXPECT_TRUE(
              map.navigable(grid.voxel_at(a + t * way)) ||
              (grid.centre(grid.voxel_at(a + t * way)) - grid.centre(grid.voxel_at(views[0].position()))).norm() <
                  0.3 + 1e-9 ||
              map.navigable(grid.voxel_at(a + (t + 1e-6) * way)));
      }
      EXPECT_NEAR(sum_m, lengths_m[i], 1e-9);
    }
  }
  EXPECT_GT(shorter, 10);
}

/// The least distance of points on a polyline to any of others [m], by samples.
double least_distance_m(const std::vector<Eigen::Vector3d>& way, const std::vector<Eigen::Vector3d>& others) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < way.size(); ++k)
    for (int t = 0; t <= 60; ++t)
      for (const Eigen::Vector3d& o : others)
        least_m = std::min(least_m, (way[k - 1] + t / 60.0 * (way[k] - way[k - 1]) - o).norm());
  return least_m;
}

TEST(Shortcut, ItAndAStarKeepTheClearanceThatTheyState) {
  constexpr double clearance_m = 0.24, diagonal_m = 0.1 * std::numbers::sqrt3;
  const double between_centres_m = std::sqrt(clearance_m * clearance_m - diagonal_m * diagonal_m / 4);
  const VoxelGrid grid = VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, 3, 2)}, 0.1);
  double kept_m = 1, kept_anywhere_m = 1, kept_straightened_m = 1;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    test::DrawnVoxels map(grid, clearance_m);
    Rng rng(seed);
    std::vector<Eigen::Vector3d> obstacles;  // as this map counts them: centres of voxels
    map.draw_all([&](const Eigen::Vector3i& v) {
      if (rng.uniform() > 0.006) return Space::free;
      obstacles.push_back(grid.centre(v));
      return Space::occupied;
    });
    std::vector<View> centres, places;
    while (places.size() < 20) {
      const Eigen::Vector3d p(rng.uniform(0, 3), rng.uniform(0, 3), rng.uniform(0, 2));
      const Eigen::Vector3i voxel = grid.voxel_at(p);
      if (!map.navigable(voxel)) continue;
      places.push_back(look_at(p, {9, 9, 9}));
      centres.push_back(look_at(grid.centre(voxel), {9, 9, 9}));
    }
    const AStar router({.own_ball_m = 0});
    for (const auto& way : router.ways(map, centres[0], centres))
      kept_m = std::min(kept_m, least_distance_m(way, obstacles));
    for (const auto& way : router.ways(map, places[0], places))
      kept_anywhere_m = std::min(kept_anywhere_m, least_distance_m(way, obstacles));
    for (const auto& way : Shortcut(router).ways(map, places[0], places))
      kept_straightened_m = std::min(kept_straightened_m, least_distance_m(way, obstacles));
  }
  EXPECT_GE(kept_m, between_centres_m - 1e-9);
  EXPECT_LT(kept_m, clearance_m - 1e-3);  // less than at the centres
  EXPECT_GE(kept_anywhere_m, clearance_m - diagonal_m / 2 - 1e-9);
  EXPECT_GE(kept_straightened_m, clearance_m - diagonal_m / 2 - 1e-9);
  EXPECT_LT(kept_straightened_m, between_centres_m);
}

TEST(Shortcut, FreeSpaceIsStraight) {
  const VoxelGrid grid = VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5, 4, 2.4)}, 0.2);
  test::DrawnVoxels map(grid, 0.2);
  map.draw_all([](const Eigen::Vector3i&) { return Space::free; });
  const View from = look_at({0.5, 0.5, 0.5}, {1, 1, 1}), goal = look_at({4.4, 3.1, 1.7}, {0, 0, 0});
  EXPECT_EQ(Shortcut<>().path(map, from, goal).size(), 2u);
  EXPECT_NEAR(Shortcut<>().lengths_m(map, from, {&goal, 1}).front(), distance_m(from, goal), 1e-12);
  EXPECT_GT(AStar().lengths_m(map, from, {&goal, 1}).front(), distance_m(from, goal));
}

}  // namespace
}  // namespace vantage
