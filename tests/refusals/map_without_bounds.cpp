// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A map that does not say where it is: bounds() is not const.
// expect: MyMap
// expect: this map does not say where it is
// expect: give it `Box3 bounds() const`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MyMap {
  using Measurement = int;
  void integrate(int, vantage::Rng&) {}
  vantage::Box3 bounds() { return {}; }
};

vantage::NbvLoop loop{MyMap{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
