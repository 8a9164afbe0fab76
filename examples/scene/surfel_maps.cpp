// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "surfel_maps.hpp"

namespace vantage {

template class SurfelMap<TileRasteriser<>, DispersionConfidence, PlainVariation, PresetVoxelMap<preset::thesis>>;
template class SurfelMap<TileRasteriser<>, ViewCountConfidence, PlainVariation, PresetVoxelMap<preset::thesis>>;
template class SurfelMap<TileRasteriser<>, IncrementalConfidence, EdgeAwareVariation,
                         PresetVoxelMap<preset::reference>>;
template class SurfelMap<TileRasteriser<>, ViewCountConfidence, EdgeAwareVariation, PresetVoxelMap<preset::reference>>;

}  // namespace vantage
