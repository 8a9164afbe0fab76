// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A router that knows how far it is, but not the way.
// expect: MyRouter
// expect: RouterType finds no way on this map
// expect: `std::vector<View> path(const MapT&, const View& from, const View& goal) const`
// expect: or take StraightLine
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/selector/travel_tradeoff.hpp>

struct MyRouter {
  std::vector<double> lengths_m(const auto&, const vantage::View&, vantage::Views goals) const {
    return std::vector<double>(goals.size());
  }
};

vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::archetype::ViewUtility{}, vantage::archetype::Sampler{},
                      vantage::TravelTradeoff{MyRouter{}}};
