// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/maps/surfel/surfel_presets.hpp>

// The surfel maps of the methods, compiled once, in surfel_maps.cpp, and not with every loop.
namespace vantage {

extern template class SurfelMap<TileRasteriser<>, DispersionConfidence, PlainVariation, VoxelMap<RayCast>>;
extern template class SurfelMap<TileRasteriser<>, ViewCountConfidence, PlainVariation, VoxelMap<RayCast>>;
extern template class SurfelMap<TileRasteriser<>, IncrementalConfidence, EdgeAwareVariation,
                                VoxelMap<Projective, NoClasses, NoOccupiedCentreInBall>>;
extern template class SurfelMap<TileRasteriser<>, ViewCountConfidence, EdgeAwareVariation,
                                VoxelMap<Projective, NoClasses, NoOccupiedCentreInBall>>;

}  // namespace vantage
