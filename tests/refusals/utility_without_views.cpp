// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A utility that scores positions instead of views.
// expect: MyUtility
// expect: UtilityT scores no view of this map
// expect: give it `double operator()(const MapT&, const View&) const`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>

struct MyUtility {
  double operator()(const Eigen::Vector3d& position) const { return position.z(); }
};

vantage::NbvLoop loop{vantage::archetype::Map{}, MyUtility{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
