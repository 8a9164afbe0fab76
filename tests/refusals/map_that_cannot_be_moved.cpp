// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A map with a constant member cannot be assigned, so it cannot be moved into place.
// expect: MyMap
// expect: this map cannot be moved into the loop
// expect: give it a move constructor and a move assignment
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MyMap {
  using Measurement = int;
  const int cells = 4;
  void integrate(int, vantage::Rng&) {}
  vantage::Box3 bounds() const { return {}; }
};

vantage::NbvLoop loop{MyMap{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
