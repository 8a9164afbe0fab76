// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/utility/unexplored.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

#include "contract/suite.hpp"
#include "drawn_voxels.hpp"
#include "message_of.hpp"

namespace vantage {
namespace {

/// A DepthMap that is what the test draws: a wall at x = 1.1, seen where it is, and nothing else.
template <class Base>
class BeforeAWall : public Base {
 public:
  using Base::Base;
  void render(const View& view, const Camera& camera, Rendering<channel::Depth>& out) const {
    out.depth.resize(camera.height, camera.width);
    for (int row = 0; row < camera.height; ++row)
      for (int column = 0; column < camera.width; ++column) {
        const Eigen::Vector3d ray = view.T_W_C.linear() * camera.ray(column + 0.5, row + 0.5);
        const double z = (1.1 - view.position().x()) / ray.x();
        out.depth(row, column) = z > 0 ? static_cast<float>(z) : std::numeric_limits<float>::quiet_NaN();
      }
  }
};
using Voxels = BeforeAWall<test::DrawnVoxels>;
/// The same as a map that tells of points only.
class Points : public archetype::Map {
 public:
  explicit Points(const Voxels& voxels) : voxels_(&voxels) {}
  [[nodiscard]] Box3 bounds() const { return voxels_->bounds(); }
  [[nodiscard]] Space at(const Eigen::Vector3d& p) const { return voxels_->at(p); }
  void render(const View& view, const Camera& camera, Rendering<channel::Depth>& out) const {
    voxels_->render(view, camera, out);
  }

 private:
  const Voxels* voxels_;
};
static_assert(VoxelOccupancy<Voxels> && DepthMap<Voxels> && !VoxelOccupancy<Points> && OccupancyMap<Points>);

const VoxelGrid grid = VoxelGrid::dividing({Eigen::Vector3d(-2, -2, 0), Eigen::Vector3d(2, 2.3, 2.5)}, 0.2);

/// Half of the space explored, some blocks not at all; nothing explored is unknown.
Voxels some_voxels() {
  Rng rng(1);
  Voxels map(grid, 0.1);
  for (int z = 0; z < grid.size().z(); ++z)
    for (int y = 0; y < grid.size().y(); ++y)
      for (int x = 0; x < grid.size().x(); ++x)
        if (block_of({x, y, z}) != Eigen::Vector3i(1, 1, 0) && rng.index(2) == 0)
          map.draw({x, y, z}, rng.index(2) == 0 ? Space::free : Space::occupied);
  return map;
}
std::vector<View> some_views() {
  std::vector<View> views = {look_at({3.03, 0, 1}, {0, 0, 1}), look_at({-9, 0, 1}, {0, 0, 1}), nadir(0, 0, 2)};
  Rng rng(2);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d eye(rng.uniform(-2, 1), rng.uniform(-2, 2), rng.uniform(0, 2.5));
    views.push_back(look_at(eye, eye + Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal())));
  }
  return views;
}

using Seen = std::set<std::tuple<int, int, int>>;
/// Voxel by voxel.
Seen slowly(const Voxels& map, const Unexplored::Config& config, const View& view) {
  Rendering<channel::Depth> image;
  map.render(view, config.camera, image);
  Seen seen;
  for (int z = 0; z < grid.size().z(); ++z)
    for (int y = 0; y < grid.size().y(); ++y)
      for (int x = 0; x < grid.size().x(); ++x) {
        if (map.explored({x, y, z})) continue;
        const Eigen::Vector3d p = view.T_W_C.inverse() * grid.centre({x, y, z});
        if (p.z() <= 0) continue;
        const double u = std::floor(config.camera.fx * p.x() / p.z() + config.camera.cx),
                     v = std::floor(config.camera.fy * p.y() / p.z() + config.camera.cy);
        if (u < 0 || v < 0 || u >= config.camera.width || v >= config.camera.height) continue;
        const double depth = static_cast<double>(image.depth(static_cast<int>(v), static_cast<int>(u)));
        if (p.z() < (std::isnan(depth) ? config.far_m : std::min(depth, config.far_m))) seen.insert({x, y, z});
      }
  return seen;
}

TEST(Unexplored, CountsWhatIsSeenVoxelByVoxel) {
  const Voxels map = some_voxels();
  const std::vector<View> views = some_views();
  std::uint64_t sum = 0;
  for (const double far_m : {1.5, 5.0}) {
    const Unexplored::Config config{.camera = Camera::from_fov(40, 30, deg(80)), .far_m = far_m};
    const Unexplored utility(config);
    const auto counts = utility.count(map, views), by_points = utility.count(Points(map), views);
    for (std::size_t i = 0; i < views.size(); ++i) {
      EXPECT_EQ(counts[i], slowly(map, config, views[i]).size()) << i;
      sum += counts[i];
    }
    EXPECT_EQ(by_points, counts);
    std::vector<double> share(views.size());
    utility.prepare(map, Situation{}, Rng(1))({}, views, share);
    for (std::size_t i = 0; i < views.size(); ++i)
      EXPECT_EQ(share[i], static_cast<double>(counts[i]) / static_cast<double>(grid.count()));
  }
  EXPECT_GT(sum, 1000u);
}

TEST(Unexplored, WhatEarlierViewsOfASequenceSeeIsSeen) {
  const Voxels map = some_voxels();
  const Unexplored::Config config{.camera = Camera::from_fov(40, 30, deg(80))};
  const std::vector<View> views = some_views(), given = {views[4], views[7]};
  Seen before = slowly(map, config, given[0]);
  before.merge(slowly(map, config, given[1]));
  const auto counts = Unexplored(config).count(map, views, given);
  std::size_t fewer = 0;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const Seen seen = slowly(map, config, views[i]);
    const auto fresh = std::ranges::count_if(seen, [&](const auto& v) { return !before.contains(v); });
    EXPECT_EQ(counts[i], static_cast<std::uint64_t>(fresh));
    fewer += counts[i] < seen.size();
  }
  EXPECT_GT(fewer, 3u);
}

TEST(Unexplored, BlocksThatTheMapDoesNotKnowAreUnexplored) {
  const Voxels map(grid, 0.1);
  ASSERT_TRUE(map.known_blocks().empty());
  const View view = look_at({-1.9, 0, 1.2}, {1, 0, 1.2});
  const Unexplored utility;
  const auto count = utility.count(map, {&view, 1})[0];
  EXPECT_EQ(count, slowly(map, utility.config(), view).size());
  EXPECT_GT(count, 1000u);
}

TEST(Unexplored, ThreadsDoNotMatter) {
  const Voxels map = some_voxels();
  const std::vector<View> views = some_views();
  const auto ask = [&] { return Unexplored().count(map, views); };
  EXPECT_EQ(test::with_threads(1, ask), test::with_threads(4, ask));
}

TEST(Unexplored, BadConfigsAreRefused) {
  EXPECT_REFUSED(Unexplored({.far_m = 0, .voxel_m = -1}), "far_m");
  EXPECT_REFUSED(Unexplored({.far_m = 0, .voxel_m = -1}), "voxel_m");
  EXPECT_THROW(Unexplored({.camera = {}}), Error);
  EXPECT_THROW(VisibleVoxels(grid, nadir(0, 0, 1), Camera::from_fov(4, 3, 1), Image<float>::Zero(4, 4), 5), Error);
}

}  // namespace
}  // namespace vantage
