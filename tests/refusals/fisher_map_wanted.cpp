// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// A utility that asks what a view teaches of the map's parameters, on a map without any.
// expect: archetype::Uncertain
// expect: FisherInformation
// expect: this policy needs a FisherMap
// expect: give the map parameters() and `void fisher(const View&, const Camera&, std::span<double>) const`
#include <vantage/concepts/archetypes.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/utility/fisher_information.hpp>

vantage::NbvLoop loop{vantage::archetype::Uncertain<>{}, vantage::FisherInformation{}, vantage::archetype::Sampler{},
                      vantage::archetype::Selector{}};
