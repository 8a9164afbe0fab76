// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A rider that learns from something else than the map that it rides with.
// expect: MyMap
// expect: all maps of a Carry must learn from the same type of Measurement
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/carry.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MyMap {
  using Measurement = int;
  void integrate(int, vantage::Rng&) {}
  vantage::Box3 bounds() const { return {}; }
};

vantage::Carry carry{vantage::archetype::Map{}, MyMap{}};
