// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A utility that forecasts, on a map that does not.
// expect: archetype::Map
// expect: VarianceReduction
// expect: this policy needs a ForecastMap
// expect: give the map `void forecast(Views given, Views views, std::span<double> reduction) const`
// expect: or choose a utility that does not forecast, such as MeanUncertainty
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/utility/variance_reduction.hpp>

vantage::NbvLoop loop{vantage::archetype::Map{}, vantage::VarianceReduction{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
