// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/maps/surfel/surfel_presets.hpp>

// The surfel maps of the methods, compiled once, in surfel_maps.cpp, and not with every loop.
namespace vantage {

extern template class SurfelMap<TileRasteriser<>, DispersionConfidence, PlainVariation, PresetVoxelMap<preset::thesis>>;
extern template class SurfelMap<TileRasteriser<>, ViewCountConfidence, PlainVariation, PresetVoxelMap<preset::thesis>>;
extern template class SurfelMap<TileRasteriser<>, IncrementalConfidence, EdgeAwareVariation,
                                PresetVoxelMap<preset::reference>>;
extern template class SurfelMap<TileRasteriser<>, ViewCountConfidence, EdgeAwareVariation,
                                PresetVoxelMap<preset::reference>>;

}  // namespace vantage
