// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

#include <vantage/concepts/preset.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

namespace vantage {

/// What a preset means for voxel maps, in types.
template <class Preset>
struct VoxelPreset;

/// The preset of voxel maps when none is named.
using DefaultVoxelPreset = preset::thesis;

/// Chapter 6 as it is written: "following OctoMap".
template <>
struct VoxelPreset<preset::thesis> {
  using Update = RayCast;
  using Clearance = BallInFreeVoxels;
};

/// The published code.
template <>
struct VoxelPreset<preset::reference> {
  using Update = Projective;
  using Clearance = NoOccupiedCentreInBall;
};

/// The voxel map of a preset.
template <class Preset = DefaultVoxelPreset, class Semantics = NoClasses>
using PresetVoxelMap =
    VoxelMap<typename VoxelPreset<Preset>::Update, Semantics, typename VoxelPreset<Preset>::Clearance>;

/// One that also counts which of so many classes it saw where; class 0 = unknown.
template <std::size_t Classes, class Preset = DefaultVoxelPreset>
using SemanticVoxelMap = PresetVoxelMap<Preset, ClassCounts<Classes>>;

}  // namespace vantage
