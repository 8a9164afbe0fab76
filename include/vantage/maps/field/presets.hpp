// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/concepts/preset.hpp>
#include <vantage/maps/field/cell_sensor.hpp>
#include <vantage/maps/field/interest.hpp>
#include <vantage/maps/field/kernel.hpp>

namespace vantage {

/// What a preset means for field maps: types (how noise grows, what becomes of cells that are seen in part, what is
/// interesting) and values (hyperparameters in the unit of fields scaled to [0, 1]).
template <class Preset>
struct FieldPreset;

/// The preset of field maps when none is named.
using DefaultFieldPreset = preset::thesis;

/// Chapter 3 as it is written.
template <>
struct FieldPreset<preset::thesis> {
  using Margin = VarianceMargin;                ///< eq. 3.8, in merging and in planning
  using HeightNoise = VarianceGrowsWithHeight;  ///< sigma_a^2 = alpha h
  using PartialAdaptive = WeighPartial;         ///< cells seen in part, adaptive maps: + beta (1 - a_cover / a_c)
  using PartialFixed = WeighPartial;            ///< the same, fixed maps
  using IndependentCells = CellAverage;         ///< prior variance under independence: the integral kernel's
  static constexpr bool merge_measured_only = false;

  SquaredExponential kernel = {};  ///< sigma^2 = 1, l = 2.36 m
  double alpha = 0.03;
  double threshold = 0.7;
  double prior_mean_mapping = 0.5;
  double prior_mean_planning = 0.7;
  double speed_m_s = 1;  ///< of the UAV
};

/// The published code.
template <>
struct FieldPreset<preset::reference> {
  using Margin = DeviationMargin;  ///< mean + deviation < threshold merges; mean >= threshold is planned for
  using HeightNoise = DeviationGrowsWithHeight;  ///< sigma_a = alpha h
  using PartialAdaptive = SkipPartial;
  using PartialFixed = CountPartial;
  using IndependentCells = CellCentre;  ///< prior variance under independence: sigma^2
  static constexpr bool merge_measured_only = true;

  SquaredExponential kernel = {.variance = 25, .length_m = 2.73};
  double alpha = 0.03;
  double threshold = 0.7;
  double prior_mean_mapping = 0.5;
  double prior_mean_planning = 0.7;
  double speed_m_s = 1;
};

}  // namespace vantage
