// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Paths over the voxels in which a robot fits, on a map without voxels.
// expect: archetype::Occupied
// expect: AStar
// expect: this policy needs a NavigableMap
// expect: clearance_m(), navigable(voxel) and navigable_in(block)
// expect: or pair it with a VoxelMap
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/planning/a_star.hpp>
#include <vantage/selector/travel_tradeoff.hpp>

vantage::NbvLoop loop{vantage::archetype::Occupied<>{}, vantage::archetype::ViewUtility{},
                      vantage::archetype::Sampler{}, vantage::TravelTradeoff{vantage::AStar{}}};
