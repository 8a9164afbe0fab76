// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A selector that cannot say "nothing": the empty set of candidates is legal.
// expect: MySelector
// expect: SelectorT decides nothing
// expect: give it `std::optional<Decision> select(const MapT&, const Situation&, const Candidates&,
// expect: const Score&, Rng&)`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MySelector {
  vantage::Decision select(const auto&, const vantage::Situation&, const vantage::Candidates&, const vantage::Score&,
                           vantage::Rng&) const {
    return {};
  }
};

vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                      MySelector{}};
