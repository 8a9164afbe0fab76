// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A map that does not say what it learns from.
// expect: MyMap
// expect: this map does not say what it learns from
// expect: give it `using Measurement = ...`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MyMap {
  void integrate(int, vantage::Rng&) {}
  vantage::Box3 bounds() const { return {}; }
};

vantage::NbvLoop loop{MyMap{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
