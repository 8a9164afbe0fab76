// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A world that measures something else than the map learns from.
// expect: MyWorld
// expect: the world measures nothing for this map
// expect: give it `std::optional<Measurement> observe(const View&)` with the map's Measurement
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MyWorld {
  std::optional<int> observe(const vantage::View&) { return 1; }
};

void mission() {
  vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                        vantage::archetype::Selector{}};
  MyWorld world;
  loop.run(world, vantage::View{}, {}, vantage::Measurements{5}, vantage::ModelledClock{}, vantage::Rng{7});
}
