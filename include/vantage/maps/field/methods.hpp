// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/maps/field/batch.hpp>
#include <vantage/maps/field/committee.hpp>
#include <vantage/maps/field/diagonal.hpp>
#include <vantage/maps/field/full.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/maps/field/presets.hpp>

// The six methods of Table 3.1. A method is a choice of policies; what a preset decides comes from FieldPreset.
namespace vantage {

namespace detail {
template <class Preset>
using AboveThreshold = Above<typename FieldPreset<Preset>::Margin>;
template <class Preset>
using AdaptiveSensor =
    CellSensor<typename FieldPreset<Preset>::HeightNoise, typename FieldPreset<Preset>::PartialAdaptive>;
template <class Preset>
using FixedSensor = CellSensor<typename FieldPreset<Preset>::HeightNoise, typename FieldPreset<Preset>::PartialFixed>;
template <class Preset, class Interest>
using MergingOf = Merging<Interest, FieldPreset<Preset>::merge_measured_only>;
}  // namespace detail

/// Ours: GP fusion of cell averages by the integral kernel, uninteresting cells merge.
template <class Preset = DefaultFieldPreset, class Belief = Full<>, class Interest = detail::AboveThreshold<Preset>,
          SeparableKernel Kernel = SquaredExponential>
using Ours =
    IntegralGp<Kernel, CellAverage, Belief, detail::MergingOf<Preset, Interest>, detail::AdaptiveSensor<Preset>>;

/// FR-GPF: GP fusion at the cells' centres, fixed resolution (Popovic et al.).
template <class Preset = DefaultFieldPreset, class Belief = Full<>, class Interest = detail::AboveThreshold<Preset>,
          SeparableKernel Kernel = SquaredExponential>
using FrGpf = IntegralGp<Kernel, CellCentre, Belief, Fixed<Interest>, detail::FixedSensor<Preset>>;

/// FR-IDP: independent cells, fixed resolution. Prior variance: <thesis> the integral kernel's, <reference> sigma^2.
template <class Preset = DefaultFieldPreset, class Interest = detail::AboveThreshold<Preset>>
using FrIdp = IntegralGp<SquaredExponential, typename FieldPreset<Preset>::IndependentCells, Diagonal, Fixed<Interest>,
                         detail::FixedSensor<Preset>>;

/// AR-IDP: independent cells, uninteresting ones merge (Einhorn et al.).
template <class Preset = DefaultFieldPreset, class Interest = detail::AboveThreshold<Preset>>
using ArIdp = IntegralGp<SquaredExponential, typename FieldPreset<Preset>::IndependentCells, Diagonal,
                         detail::MergingOf<Preset, Interest>, detail::AdaptiveSensor<Preset>>;

/// AR-GPR-IK: full regression on all measurements with the integral kernel, uninteresting cells merge (Reid et al.).
template <class Preset = DefaultFieldPreset, class Interest = detail::AboveThreshold<Preset>,
          SeparableKernel Kernel = SquaredExponential>
using ArGprIk =
    IntegralGp<Kernel, CellAverage, Batch, detail::MergingOf<Preset, Interest>, detail::AdaptiveSensor<Preset>>;

/// AR-BCM: a Bayesian committee machine over the measurements, uninteresting query points are pruned (Wang et al.).
template <class Preset = DefaultFieldPreset, class Interest = detail::AboveThreshold<Preset>,
          SeparableKernel Kernel = SquaredExponential>
using ArBcm =
    IntegralGp<Kernel, CellCentre, Committee, detail::MergingOf<Preset, Interest>, detail::AdaptiveSensor<Preset>>;

/// What a map is made for: the presets start planning missions from a prior mean at the threshold, to encourage
/// exploration.
enum class FieldTask { mapping, planning };

/// A method's configuration with a preset's values: kernel, alpha, threshold and the task's prior mean; a field in [0,
/// 1].
///
///     Ours<> map{configured<Ours<>>()};
template <class Method, class Preset = DefaultFieldPreset>
typename Method::Config configured(FieldTask task = FieldTask::mapping) {
  constexpr FieldPreset<Preset> p{};
  typename Method::Config c;
  c.prior_mean = task == FieldTask::planning ? p.prior_mean_planning : p.prior_mean_mapping;
  c.kernel.variance = p.kernel.variance;
  c.kernel.length_m = p.kernel.length_m;
  c.sensor.alpha = p.alpha;
  c.resolution.interest.threshold = p.threshold;
  return c;
}

}  // namespace vantage
