// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Collision checks: a ball against voxels, robots against the triangles of a room, and the overlap of views.
#include <cstdint>
#include <vector>

#include "peak.hpp"

#include <vantage/concepts/archetypes.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/planning/collision.hpp>
#include <vantage/planning/frustum_overlap.hpp>
#include <vantage/planning/voxel_collision.hpp>
#include <vantage/sim/room.hpp>

namespace {

using namespace vantage;

Eigen::Isometry3d random_pose(Rng& rng, const Box3& box) {
  const double w = rng.normal(), x = rng.normal(), y = rng.normal(), z = rng.normal();
  const double u = rng.uniform(), v = rng.uniform(), t = rng.uniform();
  Eigen::Isometry3d pose(Eigen::Quaterniond(w, x, y, z).normalized());
  pose.translation() = box.min() + box.sizes().cwiseProduct(Eigen::Vector3d(u, v, t));
  return pose;
}

/// A grid of 12 x 10 x 2.5 m: free, but for walls and one occupied voxel in a thousand.
class Apartment : public archetype::Map {
 public:
  explicit Apartment(double voxel_m)
      : grid_(VoxelGrid::dividing(Box3(Eigen::Vector3d::Zero(), Eigen::Vector3d(12, 10, 2.5)), voxel_m)),
        blocks_((grid_.size() + Eigen::Vector3i::Constant(block_edge - 1)) / block_edge),
        free_(static_cast<std::size_t>(blocks_.prod())) {
    Rng rng(1);
    for (int z = 0; z < grid_.size().z(); ++z)
      for (int y = 0; y < grid_.size().y(); ++y)
        for (int x = 0; x < grid_.size().x(); ++x) {
          const Eigen::Vector3i v(x, y, z);
          const bool wall = (v.array() == 0).any() || (v.array() == grid_.size().array() - 1).any();
          if (!wall && rng.uniform() > 0.001) free_[slot(block_of(v))].set(local_of(v));
        }
  }
  [[nodiscard]] Box3 bounds() const { return grid_.box(); }
  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  [[nodiscard]] Space state(const Eigen::Vector3i& v) const {
    return free_[slot(block_of(v))][local_of(v)] ? Space::free : Space::occupied;
  }
  [[nodiscard]] Space at(const Eigen::Vector3d& p) const {
    const Eigen::Vector3i v = grid_.voxel_at(p);
    return grid_.contains(v) ? state(v) : Space::unknown;
  }
  [[nodiscard]] std::span<const Eigen::Vector3i> known_blocks() const { return {}; }
  [[nodiscard]] const VoxelBits& free_in(const Eigen::Vector3i& block) const { return free_[slot(block)]; }
  [[nodiscard]] VoxelBits occupied_in(const Eigen::Vector3i& block) const {
    return ~free_in(block) & VoxelBits::inside(grid_, block);
  }
  [[nodiscard]] VoxelBits unexplored_in(const Eigen::Vector3i&) const { return {}; }

 private:
  [[nodiscard]] std::size_t slot(const Eigen::Vector3i& b) const {
    return static_cast<std::size_t>(b.x() + blocks_.x() * (b.y() + blocks_.y() * b.z()));
  }
  VoxelGrid grid_;
  Eigen::Vector3i blocks_;
  std::vector<VoxelBits> free_;
};

constexpr std::size_t many = 1024;

// One thread; items are queries, `free` the share of those that are.
template <class Query>
void queries(benchmark::State& state, std::size_t n, Query query) {
  std::size_t i = 0, free = 0;
  for (auto _ : state) {
    if (query(i % n)) ++free;
    ++i;
  }
  state.SetItemsProcessed(state.iterations());
  state.counters["free"] = static_cast<double>(free) / static_cast<double>(i);
}

void sphere_voxels(benchmark::State& state, double voxel_m, bool swept) {
  const Apartment map(voxel_m);
  Rng rng(2);
  const Box3 inner(Eigen::Vector3d(0.5, 0.5, 0.5), Eigen::Vector3d(11.5, 9.5, 2));
  std::vector<SweptBall> balls;
  for (std::size_t i = 0; i < many; ++i) {
    const Eigen::Vector3d from = random_pose(rng, inner).translation();
    const Eigen::Vector3d to =
        swept ? Eigen::Vector3d(from + Eigen::Vector3d(0.7, 0.7, 0).cwiseProduct(from / 12)) : from;
    balls.push_back({from, to, 0.3});
  }
  if (swept)
    queries(state, many, [&](std::size_t i) { return !collides(map, balls[i]); });
  else
    queries(state, many, [&](std::size_t i) { return !collides(map, Ball{balls[i].from, balls[i].radius_m}); });
}

// A procedural room of 300 k triangles.
const CollisionScene& room_scene() {
  static const CollisionScene scene(procedural_room({.edge_m = 0.04}, Rng(1)).scene.mesh);
  return scene;
}
void mesh(benchmark::State& state, const RobotShape& shape, bool motion) {
  static const Box3 box = [] {
    const Box3 all = procedural_room({.edge_m = 0.04}, Rng(1)).scene.mesh.bounds();
    return Box3(all.min().array() + 0.4, all.max().array() - 0.4);
  }();
  const CollisionChecker checker(room_scene(), shape);
  Rng rng(3);
  std::vector<Eigen::Isometry3d> poses;
  for (std::size_t i = 0; i <= many; ++i) poses.push_back(random_pose(rng, box));
  if (motion)
    queries(state, many, [&](std::size_t i) {
      Eigen::Isometry3d to = poses[i + 1];  // a step of 0.5 m and its turn
      to.translation() = poses[i].translation() + 0.5 * (to.translation() - poses[i].translation()).normalized();
      return checker.check(poses[i], to).free();
    });
  else
    queries(state, many, [&](std::size_t i) { return checker.check(poses[i]).free(); });
}
void frustum(benchmark::State& state) {
  const Camera camera = Camera::from_fov(640, 480, deg(60));
  Rng rng(4);
  std::vector<ViewFrustum> views;
  for (std::size_t i = 0; i <= many; ++i)
    views.push_back(ViewFrustum::of({random_pose(rng, Box3(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(12, 10, 2.5)))},
                                    camera, 0.1, 5));
  queries(state, many, [&](std::size_t i) { return !overlaps(views[i], views[i + 1]); });
}

BENCHMARK_CAPTURE(sphere_voxels, at_20cm, 0.2, false)->Name("planning/sphere_voxels/20cm");
BENCHMARK_CAPTURE(sphere_voxels, at_5cm, 0.05, false)->Name("planning/sphere_voxels/5cm");
BENCHMARK_CAPTURE(sphere_voxels, swept_at_20cm, 0.2, true)->Name("planning/swept_sphere_voxels/20cm");
BENCHMARK_CAPTURE(mesh, sphere, shape::Sphere{0.2}, false)->Name("planning/sphere_mesh/300k");
BENCHMARK_CAPTURE(mesh, box, shape::Box{{0.2, 0.2, 0.1}}, false)->Name("planning/box_mesh/300k");
BENCHMARK_CAPTURE(mesh, sphere_motion, shape::Sphere{0.2}, true)->Name("planning/sphere_mesh_motion/300k");
BENCHMARK_CAPTURE(mesh, box_motion, shape::Box{{0.2, 0.2, 0.1}}, true)->Name("planning/box_mesh_motion/300k");
BENCHMARK(frustum)->Name("planning/frustum_overlap");

}  // namespace

BENCHMARK_MAIN();
