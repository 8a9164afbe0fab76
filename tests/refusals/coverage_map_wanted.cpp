// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A mission that ends when all is seen, with a map that does not know how much it saw.
// expect: archetype::Map
// expect: CoverageReached
// expect: this policy needs a CoverageMap
// expect: give the map `double coverage() const`
// expect: or stop by MissionTime or Measurements
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

void mission() {
  vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                        vantage::archetype::Selector{}};
  vantage::archetype::World world;
  loop.run(world, vantage::View{}, {}, vantage::CoverageReached{0.9}, vantage::ModelledClock{}, vantage::Rng{7});
}
