// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Utilities are called concurrently: one that changes itself is refused.
// expect: MyUtility
// expect: UtilityT scores no view of this map
// expect: give it `double operator()(const MapT&, const View&) const`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MyUtility {
  int calls = 0;
  double operator()(const auto&, const vantage::View&) { return ++calls; }
};

vantage::NbvLoop loop{vantage::archetype::Map{}, MyUtility{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
