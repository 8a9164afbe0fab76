// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Regions of both kinds, on a map that has frontiers only.
// expect: archetype::Navigable
// expect: RoiAndLocal
// expect: this policy needs a RegionMap
// expect: `std::vector<Region> regions(Kind) const` for this kind (frontier or low_confidence)
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/sampler/roi_and_local.hpp>

using Voxels = vantage::archetype::Frontiers<vantage::archetype::Navigable<>>;
vantage::NbvLoop loop{Voxels{}, vantage::archetype::ViewUtility{}, vantage::RoiAndLocal{},
                      vantage::archetype::Selector{}};
