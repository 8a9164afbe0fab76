// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A utility that looks how far the map can be seen, on a map that knows occupancy but renders no depth.
// expect: archetype::Occupied
// expect: Unexplored
// expect: this policy needs a DepthMap
// expect: give the map `void render(const View&, const Camera&, Rendering<channel::Depth>&) const`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/utility/unexplored.hpp>

using Voxels = vantage::archetype::Occupied<vantage::archetype::Uncertain<>>;
vantage::NbvLoop loop{Voxels{}, vantage::Unexplored{}, vantage::archetype::Sampler{}, vantage::archetype::Selector{}};
