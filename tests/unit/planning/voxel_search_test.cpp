// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/planning/voxel_search.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

namespace vantage {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Voxels that are open or not, as the test says.
class Maze {
 public:
  explicit Maze(const VoxelGrid& grid) : grid_(grid), open_(grid.count(), true) {}
  /// Random obstacles: single voxels and boxes.
  static Maze random(const VoxelGrid& grid, Rng rng, double share) {
    Maze maze(grid);
    for (std::size_t i = 0; i < maze.open_.size(); ++i) maze.open_[i] = rng.uniform() >= share;
    return maze;
  }
  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  [[nodiscard]] std::size_t slot(const Eigen::Vector3i& v) const {
    return static_cast<std::size_t>((v.z() * grid_.size().y() + v.y()) * grid_.size().x() + v.x());
  }
  [[nodiscard]] Eigen::Vector3i voxel(std::size_t slot) const {
    const auto s = static_cast<int>(slot);
    const Eigen::Vector3i n = grid_.size();
    return {s % n.x(), s / n.x() % n.y(), s / n.x() / n.y()};
  }
  void set(const Eigen::Vector3i& v, bool open) { open_[slot(v)] = open; }
  [[nodiscard]] bool operator()(const Eigen::Vector3i& v) const { return grid_.contains(v) && open_[slot(v)]; }
  [[nodiscard]] VoxelBits in(const Eigen::Vector3i& block) const {
    VoxelBits bits;
    VoxelBits::inside(grid_, block).for_each([&](std::size_t local) {
      if ((*this)(voxel_of(block, local))) bits.set(local);
    });
    return bits;
  }
  [[nodiscard]] Eigen::Vector3i random_open(Rng& rng) const {
    for (;;) {
      const Eigen::Vector3i v = voxel(rng.index(open_.size()));
      if ((*this)(v)) return v;
    }
  }
  /// Dijkstra's algorithm as it is in the book: the lengths to all voxels.
  [[nodiscard]] std::vector<double> lengths_m(const Eigen::Vector3i& from) const {
    std::vector<double> length(open_.size(), infinity);
    std::set<std::pair<double, std::size_t>> ends = {{0, slot(from)}};
    length[slot(from)] = 0;
    while (!ends.empty()) {
      const auto [so_far, at] = *ends.begin();
      ends.erase(ends.begin());
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z) {
            const Eigen::Vector3i step(x, y, z), next = voxel(at) + step;
            if (!(*this)(next)) continue;
            const double there = so_far + step.cast<double>().cwiseProduct(grid_.voxel_m()).norm();
            if (!(there < length[slot(next)])) continue;
            ends.erase({length[slot(next)], slot(next)});
            length[slot(next)] = there;
            ends.insert({there, slot(next)});
          }
    }
    return length;
  }

 private:
  VoxelGrid grid_;
  std::vector<bool> open_;
};

double length_m(const Maze& maze, const std::vector<Eigen::Vector3i>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    sum += (path[i] - path[i - 1]).cast<double>().cwiseProduct(maze.grid().voxel_m()).norm();
  return sum;
}

/// 21 x 18 x 11 voxels that are no cubes, and cubes.
VoxelGrid odd_grid() { return VoxelGrid::dividing({Eigen::Vector3d(-1, 2, 0), Eigen::Vector3d(3.1, 5.4, 2.1)}, 0.2); }
VoxelGrid cubes() { return VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(17, 9, 10)}, 1); }

TEST(VoxelSearch, LengthsAreDijkstrasInRandomMazes) {
  for (const VoxelGrid& grid : {odd_grid(), cubes()})
    for (const double share : {0.0, 0.05, 0.3, 0.6, 0.8})
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        const Maze maze = Maze::random(grid, Rng(seed), share);
        Rng rng(100 + seed);
        const Eigen::Vector3i from = maze.random_open(rng);
        const std::vector<double> expected = maze.lengths_m(from);
        std::vector<Eigen::Vector3i> all;
        for (std::size_t i = 0; i < expected.size(); ++i) all.push_back(maze.voxel(i));
        const VoxelSearch everywhere(maze, from, all);
        std::size_t reached = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          if (std::isinf(expected[i]))
            ASSERT_EQ(everywhere.length_m(all[i]), infinity);
          else
            ASSERT_NEAR(everywhere.length_m(all[i]), expected[i], 1e-9) << share << " " << seed << " " << all[i];
          reached += std::isfinite(expected[i]);
        }
        EXPECT_EQ(everywhere.reached(), reached);
        for (int k = 0; k < 20; ++k) {  // towards a few: the heuristic is at work
          const std::vector<Eigen::Vector3i> few = {all[rng.index(all.size())], all[rng.index(all.size())]};
          const std::size_t n = 1 + static_cast<std::size_t>(k % 2);
          const VoxelSearch search(maze, from, std::span(few).first(n));
          for (std::size_t i = 0; i < n; ++i)
            if (std::isinf(expected[maze.slot(few[i])]))
              ASSERT_EQ(search.length_m(few[i]), infinity);
            else
              ASSERT_NEAR(search.length_m(few[i]), expected[maze.slot(few[i])], 1e-9) << share << " " << seed;
        }
      }
}

TEST(VoxelSearch, PathsAreOpenConnectedAndAsLongAsStated) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Maze maze = Maze::random(odd_grid(), Rng(seed), 0.5);
    Rng rng(seed);
    const Eigen::Vector3i from = maze.random_open(rng);
    std::vector<Eigen::Vector3i> goals;
    for (int i = 0; i < 20; ++i) goals.push_back(maze.random_open(rng));
    const VoxelSearch search(maze, from, goals);
    for (const Eigen::Vector3i& goal : goals) {
      const std::vector<Eigen::Vector3i> path = search.path(goal);
      if (std::isinf(search.length_m(goal))) {
        EXPECT_TRUE(path.empty());
        continue;
      }
      ASSERT_EQ(path.front(), from);
      ASSERT_EQ(path.back(), goal);
      for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_TRUE(maze(path[i]));
        if (i > 0) { EXPECT_EQ((path[i] - path[i - 1]).cwiseAbs().maxCoeff(), 1); }
      }
      EXPECT_NEAR(length_m(maze, path), search.length_m(goal), 1e-9);
    }
  }
}

TEST(VoxelSearch, ThereAndBackAreEquallyLongAndNoDetourIsShorter) {
  const Maze maze = Maze::random(odd_grid(), Rng(3), 0.4);
  Rng rng(4);
  std::vector<Eigen::Vector3i> places;
  for (int i = 0; i < 8; ++i) places.push_back(maze.random_open(rng));
  std::vector<std::vector<double>> between;
  for (const Eigen::Vector3i& from : places) {
    const VoxelSearch search(maze, from, places);
    auto& row = between.emplace_back();
    for (const Eigen::Vector3i& to : places) row.push_back(search.length_m(to));
  }
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < places.size(); ++b) {
      EXPECT_EQ(between[a][b], between[b][a]);  // to the bit: lengths are integers inside
      for (std::size_t c = 0; c < places.size(); ++c) EXPECT_LE(between[a][c], between[a][b] + between[b][c] + 1e-9);
    }
}

TEST(VoxelSearch, KnowsWhenThereIsNoPath) {
  Maze maze(cubes());
  for (int y = 0; y < 9; ++y)
    for (int z = 0; z < 10; ++z) maze.set({8, y, z}, false);
  const std::vector<Eigen::Vector3i> goals = {{3, 3, 3}, {12, 3, 3}, {8, 4, 4}, {-1, 0, 0}, {17, 0, 0}};
  const VoxelSearch search(maze, {1, 1, 1}, goals);
  EXPECT_NEAR(search.length_m(goals[0]), 2 * std::sqrt(3.0), 1e-9);
  for (std::size_t i = 1; i < goals.size(); ++i) {
    EXPECT_EQ(search.length_m(goals[i]), infinity);
    EXPECT_TRUE(search.path(goals[i]).empty());
  }
  for (const Eigen::Vector3i& start : {goals[2], goals[3]})  // a start that is not open, and one outside
    EXPECT_EQ(VoxelSearch(maze, start, goals).length_m(goals[0]), infinity);
  EXPECT_EQ(VoxelSearch(maze, {1, 1, 1}, std::span<const Eigen::Vector3i>()).reached(), 0u);
  const std::vector<Eigen::Vector3i> here = {{1, 1, 1}};
  const VoxelSearch at_goal(maze, here[0], here);
  EXPECT_EQ(at_goal.length_m(here[0]), 0);
  EXPECT_EQ(at_goal.path(here[0]), here);
}

TEST(VoxelSearch, AGridOfOneVoxelAlongAnAxisIsAPlane) {
  const VoxelGrid grid = VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(5, 4, 1e-6)}, 0.5);
  ASSERT_EQ(grid.size(), Eigen::Vector3i(10, 8, 1));
  const Maze maze = Maze::random(grid, Rng(1), 0.2);
  Rng rng(2);
  const Eigen::Vector3i from = maze.random_open(rng);
  const std::vector<double> expected = maze.lengths_m(from);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const std::vector<Eigen::Vector3i> goal = {maze.voxel(i)};
    const double length_m = VoxelSearch(maze, from, goal).length_m(goal[0]);
    if (std::isinf(expected[i]))
      EXPECT_EQ(length_m, infinity);
    else
      EXPECT_NEAR(length_m, expected[i], 1e-9);
  }
}

}  // namespace
}  // namespace vantage
