// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A need of the user's own that nobody met.
// expect: archetype::Map
// expect: Thermometer
// expect: Temperature
// expect: this policy needs what the map does not offer
// expect: specialise vantage::offers<Map, Need> where it does
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct Temperature;
struct Thermometer {
  using MapNeeds = vantage::Needs<Temperature>;
  double operator()(const auto& map, const vantage::View& view) const { return map.temperature(view.position()); }
};

vantage::NbvLoop loop{vantage::archetype::Map{}, Thermometer{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
