// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Views around the robot, levelled, on a map that knows no voxels.
// expect: archetype::Map
// expect: Local
// expect: this policy needs a NavigableMap
// expect: clearance_m(), navigable(voxel) and navigable_in(block), or pair it with a VoxelMap
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/sampler/level.hpp>
#include <vantage/sampler/local.hpp>

vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, vantage::Level{vantage::Local{}},
                      vantage::archetype::Selector{}};
