// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// The same need, inside a rule made of several.
// expect: archetype::Map
// expect: AnyOf<vantage::MissionTime, vantage::CoverageReached>
// expect: this policy needs a CoverageMap
// expect: give the map `double coverage() const`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

void mission() {
  vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                        vantage::archetype::Selector{}};
  vantage::archetype::World world;
  loop.run(world, vantage::View{}, {}, vantage::AnyOf{vantage::MissionTime{300}, vantage::CoverageReached{0.9}},
           vantage::ModelledClock{}, vantage::Rng{7});
}
