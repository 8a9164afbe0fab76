// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Views of where the known world ends, on a map with voxels that does not say where that is.
// expect: archetype::Navigable
// expect: Frontier
// expect: this policy needs a RegionMap
// expect: `std::vector<Region> regions(Kind) const` for this kind (frontier or low_confidence)
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/sampler/frontier.hpp>

vantage::NbvLoop loop{vantage::archetype::Navigable<>{}, vantage::archetype::ViewUtility{}, vantage::Frontier{},
                      vantage::archetype::Selector{}};
