// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A map that does not learn: its integrate takes no random numbers.
// expect: MyMap
// expect: this map does not learn
// expect: give it `void integrate(const Measurement&, Rng&)`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MyMap {
  using Measurement = int;
  void integrate(int) {}
  vantage::Box3 bounds() const { return {}; }
};

vantage::NbvLoop loop{MyMap{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
