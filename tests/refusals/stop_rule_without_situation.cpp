// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A stop rule that is a number: a budget of what?
// expect: double
// expect: the stop rule does not say when
// expect: give it `bool operator()(const MapT&, const Situation&) const`
// expect: or take MissionTime or Measurements
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

void mission() {
  vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                        vantage::archetype::Selector{}};
  vantage::archetype::World world;
  loop.run(world, vantage::View{}, {}, 300.0, vantage::ModelledClock{}, vantage::Rng{7});
}
