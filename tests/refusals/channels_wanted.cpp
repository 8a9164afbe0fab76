// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A utility that looks at entropy along rays, on a map that draws uncertainty only.
// expect: archetype::Uncertain
// expect: RayEntropy
// expect: this policy needs a map that draws the channels
// expect: give the map `void render(const View&, const Camera&, Rendering<...>&) const`
// expect: channel::Entropy
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/utility/ray_entropy.hpp>

vantage::NbvLoop loop{vantage::archetype::Uncertain<>{}, vantage::RayEntropy{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
