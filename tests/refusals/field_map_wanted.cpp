// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A policy that reads cells, on a map that has none.
// expect: archetype::Map
// expect: DoubtAtCell
// expect: this policy needs a FieldMap
// expect: give the map size(), cell(i), mean(i), variance(i) and cell_at(point), or use an IntegralGp
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/nbv_loop.hpp>

struct DoubtAtCell {
  using MapNeeds = vantage::Needs<vantage::need::Field>;
  double operator()(const auto& map, const vantage::View& view) const {
    return map.variance(map.cell_at(view.position().template head<2>()));
  }
};

vantage::NbvLoop loop{vantage::archetype::Map{}, DoubtAtCell{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
