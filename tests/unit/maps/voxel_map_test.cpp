// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/loop/carry.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

#include "message_of.hpp"
#include "voxel_scenes.hpp"

namespace vantage {
namespace {

using test::small_room;

template <class M>
typename M::Config room_config(double voxel_m = 0.1) {
  typename M::Config config;
  config.bounds = small_room;
  config.voxel_m = voxel_m;
  config.clearance_m = 0.17;
  return config;
}

template <class F>
void for_voxels(const VoxelGrid& grid, F&& f) {
  for (int z = 0; z < grid.size().z(); ++z)
    for (int y = 0; y < grid.size().y(); ++y)
      for (int x = 0; x < grid.size().x(); ++x) f(Eigen::Vector3i(x, y, z));
}

template <class M>
std::vector<std::byte> bytes(const M& map) {
  Sink sink;
  map.save(sink);
  return std::move(sink).take();
}

// What both updates say of one frame, in double precision and voxel by voxel. Pixels whose point is so near a border of
// voxels that rounding decides are struck out of the frame first.
struct SlowFrame {
  SlowFrame(const VoxelGrid& g, Frame& f) : grid(g), frame(f) {
    for (int v = 0; v < f.camera.height; ++v)
      for (int u = 0; u < f.camera.width; ++u) {
        if (std::isnan(f.depth(v, u))) continue;
        const Eigen::Vector3d at = (point(u, v) - grid.origin()).cwiseQuotient(grid.voxel_m());
        if (((at.array() - at.array().round()).abs() < 1e-3).any())
          f.depth(v, u) = std::numeric_limits<float>::quiet_NaN();
      }
  }
  [[nodiscard]] Eigen::Vector3d point(int u, int v) const {
    return frame.view.T_W_C * Eigen::Vector3d(frame.depth(v, u) * frame.camera.ray(u + 0.5, v + 0.5));
  }
  [[nodiscard]] bool hit(const Eigen::Vector3i& voxel) const {
    for (int v = 0; v < frame.camera.height; ++v)
      for (int u = 0; u < frame.camera.width; ++u)
        if (!std::isnan(frame.depth(v, u)) && grid.voxel_at(point(u, v)) == voxel) return true;
    return false;
  }
  [[nodiscard]] std::vector<Eigen::Vector3i> ends() const {
    std::vector<Eigen::Vector3i> found;
    for_voxels(grid, [&](const Eigen::Vector3i& voxel) {
      if (hit(voxel)) found.push_back(voxel);
    });
    return found;
  }
  // Does the segment from the camera to a voxel's centre cross another voxel, for more than rounding?
  [[nodiscard]] bool crosses(const Eigen::Vector3i& end, const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3d eye = frame.view.position(), along = grid.centre(end) - eye;
    const Box3 box = grid.box_of(voxel);
    const Eigen::Array3d a = (box.min() - eye).array() / along.array(), b = (box.max() - eye).array() / along.array();
    return std::min(a.max(b).minCoeff(), 1.0) - std::max(a.min(b).maxCoeff(), 0.0) > 1e-9;
  }
  // Whether its centre is nearer than its pixel's depth; none if rounding decides.
  [[nodiscard]] std::optional<bool> nearer(const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3d p = frame.view.T_W_C.inverse() * grid.centre(voxel);
    if (std::abs(p.z()) < 1e-4) return std::nullopt;
    if (p.z() < 0) return false;
    const double u = frame.camera.fx * p.x() / p.z() + frame.camera.cx,
                 v = frame.camera.fy * p.y() / p.z() + frame.camera.cy;
    if (std::abs(u - std::round(u)) < 1e-3 || std::abs(v - std::round(v)) < 1e-3) return std::nullopt;
    if (u < 0 || v < 0 || u >= frame.camera.width || v >= frame.camera.height) return false;
    const float d = frame.depth(static_cast<int>(v), static_cast<int>(u));
    if (std::isnan(d)) return false;
    if (std::abs(d - p.z()) < 1e-4) return std::nullopt;
    return p.z() < d;
  }
  const VoxelGrid& grid;
  Frame& frame;
};

TEST(VoxelMap, RayCastHitsAndPassesWhatRaysDo) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    auto config = room_config<VoxelMap<RayCast>>();
    config.bounds = Box3(small_room.min().array() - 0.3, small_room.max().array() + 0.3);  // no ray leaves it
    VoxelMap<RayCast> map(config);
    Frame frame = test::random_frame(Rng(seed), 30);
    const SlowFrame slow(map.grid(), frame);
    map.integrate(frame);
    const std::vector<Eigen::Vector3i> ends = slow.ends();
    ASSERT_GT(ends.size(), 50U);
    for_voxels(map.grid(), [&](const Eigen::Vector3i& voxel) {
      const bool hit = slow.hit(voxel);
      const bool pass =
          !hit && std::ranges::any_of(ends, [&](const Eigen::Vector3i& end) { return slow.crosses(end, voxel); });
      EXPECT_FLOAT_EQ(map.log_odds(voxel), hit ? 0.85F : pass ? -0.4F : 0.0F) << voxel.transpose();
      EXPECT_EQ(map.state(voxel), hit ? Space::occupied : pass ? Space::free : Space::unknown);
      EXPECT_EQ(map.explored(voxel), hit || pass);
    });
  }
}

TEST(VoxelMap, ProjectiveHitsPointsAndPassesNearerCentres) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    VoxelMap<Projective> map(room_config<VoxelMap<Projective>>());
    Frame frame = test::random_frame(Rng(seed), 30);
    const SlowFrame slow(map.grid(), frame);
    map.integrate(frame);
    int passed = 0;
    for_voxels(map.grid(), [&](const Eigen::Vector3i& voxel) {
      const bool hit = slow.hit(voxel);
      const std::optional<bool> nearer = slow.nearer(voxel);
      if (!hit && !nearer) return;
      const double gain = 2.8 * (1 - 0.1 * (map.grid().centre(voxel) - frame.view.position()).norm());
      EXPECT_NEAR(map.log_odds(voxel), hit ? gain : *nearer ? -gain : 0.0, 1e-5) << voxel.transpose();
      passed += !hit && *nearer;
    });
    EXPECT_GT(passed, 100);
  }
}

// Frontier and navigable voxels against their definitions over the whole grid, after every frame.
template <class M>
void expect_exact(const M& map, auto&& fits) {
  std::uint64_t frontier = 0, navigable = 0, explored = 0;
  for_voxels(map.grid(), [&](const Eigen::Vector3i& voxel) {
    bool beside_unexplored = false;
    for (int a = 0; a < 3; ++a)
      for (const int step : {-1, 1}) {
        Eigen::Vector3i next = voxel;
        next[a] += step;
        beside_unexplored |= map.grid().contains(next) && !map.explored(next);
      }
    const bool is_frontier = map.state(voxel) == Space::free && beside_unexplored;
    const std::size_t local = local_of(voxel);
    ASSERT_EQ(map.frontier_in(block_of(voxel))[local], is_frontier) << voxel.transpose();
    const bool is_navigable = map.state(voxel) == Space::free && fits(voxel);
    ASSERT_EQ(map.navigable(voxel), is_navigable) << voxel.transpose();
    ASSERT_EQ(map.navigable_in(block_of(voxel))[local], is_navigable);
    ASSERT_EQ(map.free_in(block_of(voxel))[local], map.state(voxel) == Space::free);
    ASSERT_EQ(map.occupied_in(block_of(voxel))[local], map.state(voxel) == Space::occupied);
    ASSERT_EQ(map.unexplored_in(block_of(voxel))[local], !map.explored(voxel));
    ASSERT_EQ(map.at(map.grid().centre(voxel)), map.state(voxel));
    frontier += is_frontier, navigable += is_navigable, explored += map.explored(voxel);
  });
  EXPECT_EQ(map.counts().frontier, frontier);
  EXPECT_EQ(map.counts().navigable, navigable);
  EXPECT_EQ(map.counts().explored, explored);
  EXPECT_EQ(map.coverage(), static_cast<double>(explored) / static_cast<double>(map.grid().count()));
  EXPECT_EQ(map.regions(vantage::frontier{}).size(), frontier);
}

// Does the open ball around a voxel's centre, a millionth smaller, lie in free voxels?
template <class M>
bool ball_in_free_voxels(const M& map, const Eigen::Vector3i& voxel) {
  const VoxelGrid& grid = map.grid();
  const double radius = map.clearance_m() * (1 - 1e-6);
  const Eigen::Vector3i reach = (radius / grid.voxel_m().array() + 1).template cast<int>();
  for (int z = -reach.z(); z <= reach.z(); ++z)
    for (int y = -reach.y(); y <= reach.y(); ++y)
      for (int x = -reach.x(); x <= reach.x(); ++x) {
        const Eigen::Vector3i other = voxel + Eigen::Vector3i(x, y, z);
        if (grid.box_of(other).exteriorDistance(grid.centre(voxel)) >= radius) continue;
        if (!grid.contains(other) || map.state(other) != Space::free) return false;
      }
  return true;
}
template <class M>
bool no_occupied_centre_in_ball(const M& map, const Eigen::Vector3i& voxel) {
  bool none = true;
  for_voxels(map.grid(), [&](const Eigen::Vector3i& other) {
    none &= map.state(other) != Space::occupied ||
            (map.grid().centre(other) - map.grid().centre(voxel)).norm() > map.clearance_m();
  });
  return none;
}

TEST(VoxelMap, FrontierAndNavigableAreExactAfterEveryFrame) {
  using M = VoxelMap<RayCast>;
  for (const double clearance_m : {0.0, 0.05, 0.17, 0.3}) {
    M::Config config = room_config<M>(0.07);
    config.clearance_m = clearance_m;
    M map(config);
    for (std::uint64_t k = 0; k < 6; ++k) {
      map.integrate(test::random_frame(Rng(5).fork(k)));
      expect_exact(map, [&](const Eigen::Vector3i& v) { return ball_in_free_voxels(map, v); });
      if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GT(map.counts().navigable, clearance_m < 0.2 ? 100U : 0U);
  }
}

TEST(VoxelMap, FrontierAndNavigableAreExactByThePublishedRule) {
  using M = VoxelMap<Projective, NoClasses, NoOccupiedCentreInBall>;
  M map(room_config<M>(0.1));
  for (std::uint64_t k = 0; k < 6; ++k) {
    map.integrate(test::random_frame(Rng(6).fork(k)));
    expect_exact(map, [&](const Eigen::Vector3i& v) { return no_occupied_centre_in_ball(map, v); });
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(map.counts().navigable, 100U);
}

TEST(VoxelMap, ALargeClearanceReachesOverSeveralBlocks) {
  using M = VoxelMap<Projective>;
  M::Config config = room_config<M>(0.04);
  config.clearance_m = 0.35;
  config.range.no_return_m = 5;
  M map(config);
  for (std::uint64_t k = 0; k < 16; ++k) map.integrate(test::random_frame(Rng(7).fork(k)));
  ASSERT_GT(map.counts().navigable, 20U);
  for (const Eigen::Vector3i& block : map.known_blocks())
    map.free_in(block).for_each([&](std::size_t local) {
      const Eigen::Vector3i voxel = voxel_of(block, local);
      EXPECT_EQ(map.navigable(voxel), ball_in_free_voxels(map, voxel)) << voxel.transpose();
    });
}

}  // namespace
}  // namespace vantage
