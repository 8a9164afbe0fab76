// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A utility that looks at the map's uncertainty, on a map that cannot be rendered.
// expect: archetype::Map
// expect: MeanUncertainty
// expect: this policy needs an UncertainMap
// expect: give the map `void render(const View&, const Camera&, Rendering<channel::Uncertainty>&) const`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/utility/mean_uncertainty.hpp>

vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::MeanUncertainty{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
