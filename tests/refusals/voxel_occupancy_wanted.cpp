// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A policy that reads voxels, on a map that knows occupancy at points only.
// expect: archetype::Occupied
// expect: FreeVoxels
// expect: this policy needs a VoxelOccupancy
// expect: free_in(block), occupied_in(block) and unexplored_in(block), or pair it with a VoxelMap
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/nbv_loop.hpp>

struct FreeVoxels {
  using MapNeeds = vantage::Needs<vantage::need::Voxels>;
  double operator()(const auto& map, const vantage::View&) const {
    return static_cast<double>(map.known_blocks().size());
  }
};

vantage::NbvLoop loop{vantage::archetype::Occupied<>{}, FreeVoxels{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
