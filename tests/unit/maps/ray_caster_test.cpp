// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/maps/voxel/ray_caster.hpp>

#include <optional>

#include <gtest/gtest.h>

#include <vantage/core/rng.hpp>

#include "drawn_voxels.hpp"

namespace vantage {
namespace {

using test::DrawnVoxels;
using Hit = RayCaster<DrawnVoxels>::Hit;

/// The same map, with blocks that can be pointed to.
struct InPlace : DrawnVoxels {
  struct Block {
    VoxelBits free, occupied;
  };
  using DrawnVoxels::DrawnVoxels;
  [[nodiscard]] const Block* block(const Eigen::Vector3i& b) const {
    thread_local Block copy;
    copy = {free_in(b), occupied_in(b)};
    return copy.free.any() || copy.occupied.any() ? &copy : nullptr;
  }
};

template <class Wanted>
std::optional<Hit> step_by_step(const DrawnVoxels& map, const Eigen::Vector3d& from, const Eigen::Vector3d& direction,
                                double most, Wanted&& wanted) {
  for (GridRay ray(map.grid(), from, direction, most); ray; ray.step())
    if (wanted(map.state(ray.voxel()))) return Hit{ray.voxel(), ray.enter()};
  return std::nullopt;
}
template <class Found>
void expect_same(const Found& found, const std::optional<Hit>& expected) {
  ASSERT_EQ(found.has_value(), expected.has_value());
  if (!found) return;
  EXPECT_EQ(found->voxel, expected->voxel);
  EXPECT_EQ(found->t, expected->t);
}

TEST(RayCaster, FindsWhatStepsFind) {
  const VoxelGrid grid = VoxelGrid::dividing({Eigen::Vector3d(-2, -3, 0), Eigen::Vector3d(3, 2.4, 2.5)}, 0.1);
  InPlace map(grid, 0.1);
  Rng rng(1);
  map.draw_all([&](const Eigen::Vector3i& v) {  // whole blocks of each kind, and mixed ones
    const auto kind = (block_of(v).x() + 2 * block_of(v).y() + block_of(v).z()) % 4;
    return kind < 2             ? Space::free
           : kind == 2          ? Space::unknown
           : rng.index(30) == 0 ? Space::occupied
                                : static_cast<Space>(rng.index(2));
  });
  const DrawnVoxels& plain = map;
  const RayCaster<DrawnVoxels> caster(plain);
  const RayCaster<InPlace> in_place(map);
  std::size_t found = 0;
  for (int n = 0; n < 2000; ++n) {
    const Eigen::Vector3d from(rng.uniform(-3, 4), rng.uniform(-4, 3), rng.uniform(-1, 3)),
        direction(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1));
    const double most = rng.index(2) == 0 ? 5 : rng.uniform(0, 5);
    const auto occupied = step_by_step(map, from, direction, most, [](Space s) { return s == Space::occupied; });
    const auto not_free = step_by_step(map, from, direction, most, [](Space s) { return s != Space::free; });
    found += occupied.has_value();
    expect_same(caster.first_occupied(from, direction, most), occupied);
    expect_same(caster.first_not_free(from, direction, most), not_free);
    expect_same(in_place.first_occupied(from, direction, most), occupied);
    expect_same(in_place.first_not_free(from, direction, most), not_free);
  }
  EXPECT_GT(found, 100u);
}

TEST(RayCaster, NothingKnownIsNothingOccupiedAndNothingFree) {
  const DrawnVoxels map(VoxelGrid::on_lattice({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 2, 2)}, 0.1), 0.1);
  const RayCaster caster(map);
  EXPECT_FALSE(caster.first_occupied({-1, 1.05, 1.05}, {1, 0, 0}));
  const auto hit = caster.first_not_free({-1, 1.05, 1.05}, {1, 0, 0});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->voxel, Eigen::Vector3i(0, 10, 10));
  EXPECT_EQ(hit->t, 1);
}

}  // namespace
}  // namespace vantage
