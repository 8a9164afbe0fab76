// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A sampler that returns the views alone.
// expect: MySampler
// expect: SamplerT proposes no views
// expect: give it `Candidates sample(const MapT&, const Situation&, const Score&, Rng&)`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MySampler {
  std::vector<vantage::View> sample(const auto&, const vantage::Situation&, const vantage::Score&,
                                    vantage::Rng&) const {
    return {};
  }
};

vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, MySampler{},
                      vantage::archetype::Selector{}};
