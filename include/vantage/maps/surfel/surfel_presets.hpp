// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/concepts/preset.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/maps/surfel/confidence.hpp>
#include <vantage/maps/surfel/smoothness.hpp>
#include <vantage/maps/surfel/surfel_map.hpp>

namespace vantage {

/// What a preset means for surfel maps, in types and in values.
template <class Preset>
struct SurfelPreset;

/// The preset of surfel maps when none is named.
using DefaultSurfelPreset = preset::reference;

/// Chapter 6 as it is written.
template <>
struct SurfelPreset<preset::thesis> {
  using Confidence = DispersionConfidence;  ///< eqs. 6.6 to 6.9
  using Variation = PlainVariation;         ///< "TV(N)"

  bool squared_colour_error = false;  ///< eq. 6.4: avg(|C - C*|) > 0.5
  double most_colour_error = 0.5;
  bool batch_by_error = false;  ///< "5 random frames"
  double least_weight = 0.3;
  double least_opacity = 0;
};

/// The published code.
template <>
struct SurfelPreset<preset::reference> {
  using Confidence = IncrementalConfidence;
  using Variation = EdgeAwareVariation;

  bool squared_colour_error = true;
  double most_colour_error = 0.25;
  bool batch_by_error = true;
  double least_weight = 0.03;
  double least_opacity = 0.1;
};

/// The map of ActiveGS.
template <class Preset = DefaultSurfelPreset, SurfelConfidence Confidence = typename SurfelPreset<Preset>::Confidence,
          SurfelRasteriser Rasteriser = TileRasteriser<>>
using ActiveGsMap = SurfelMap<Rasteriser, Confidence, typename SurfelPreset<Preset>::Variation, PresetVoxelMap<Preset>>;

/// The preset that a surfel map's types are of, so that its numbers are of no other. A map that mixes types has none;
/// specialise this for one of your own.
template <class M>
struct PresetOfSurfels;
template <SurfelRasteriser Rasteriser, SurfelConfidence Confidence>
struct PresetOfSurfels<
    SurfelMap<Rasteriser, Confidence, SurfelPreset<preset::thesis>::Variation, PresetVoxelMap<preset::thesis>>> {
  using type = preset::thesis;
};
template <SurfelRasteriser Rasteriser, SurfelConfidence Confidence>
struct PresetOfSurfels<
    SurfelMap<Rasteriser, Confidence, SurfelPreset<preset::reference>::Variation, PresetVoxelMap<preset::reference>>> {
  using type = preset::reference;
};

/// A surfel map's configuration with its preset's values: voxels of 20 cm and a sensor that sees 5 m.
///
///     ActiveGsMap<> map{surfel_config<ActiveGsMap<>>(box)};
template <class M>
typename M::Config surfel_config(const Box3& bounds) {
  constexpr SurfelPreset<typename PresetOfSurfels<M>::type> p{};
  typename M::Config c;
  c.voxels.bounds = bounds;
  c.voxels.range.max_m = c.far_m;
  c.densify.squared_colour_error = p.squared_colour_error;
  c.densify.most_colour_error = p.most_colour_error;
  c.batch.by_error = p.batch_by_error;
  c.prune.least_weight = p.least_weight;
  c.prune.least_opacity = p.least_opacity;
  return c;
}

}  // namespace vantage
