// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A sampler that wants to know where the robot may fly, on a map that does not know.
// expect: archetype::Map
// expect: FreeSpace
// expect: this policy needs an OccupancyMap
// expect: give the map `Space at(const Eigen::Vector3d&) const`
// expect: or pair it with a VoxelMap
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct FreeSpace {
  using MapNeeds = vantage::Needs<vantage::need::Occupancy>;
  template <vantage::OccupancyMap M>
  vantage::Candidates sample(const M& map, const vantage::Situation& q, const vantage::Score&, vantage::Rng&) const {
    vantage::Candidates c;
    if (map.at(q.here.position()) == vantage::Space::free) c.views.push_back(q.here);
    return c;
  }
};

vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, FreeSpace{},
                      vantage::archetype::Selector{}};
