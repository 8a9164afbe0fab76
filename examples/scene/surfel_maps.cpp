// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "surfel_maps.hpp"

namespace vantage {

template class SurfelMap<TileRasteriser<>, DispersionConfidence, PlainVariation, VoxelMap<RayCast>>;
template class SurfelMap<TileRasteriser<>, ViewCountConfidence, PlainVariation, VoxelMap<RayCast>>;
template class SurfelMap<TileRasteriser<>, IncrementalConfidence, EdgeAwareVariation,
                         VoxelMap<Projective, NoClasses, NoOccupiedCentreInBall>>;
template class SurfelMap<TileRasteriser<>, ViewCountConfidence, EdgeAwareVariation,
                         VoxelMap<Projective, NoClasses, NoOccupiedCentreInBall>>;

}  // namespace vantage
