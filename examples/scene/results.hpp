// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include <vantage/eval/mesh_metrics.hpp>
#include <vantage/mission/record.hpp>

#include "album.hpp"
#include "fused_map.hpp"
#include "input.hpp"

// What a person looks at when the mission is over: pictures, the mesh in common formats, the page.
namespace scene {

/// How good the reconstruction is, where the truth is known; shares in [0, 1], lengths in metres.
struct Judge {
  const Input& input;
  double threshold_m;
  std::vector<Metric> operator()(const FusedMap& map) const;
};

void write_results(const Options& o, const Input& input, const FusedMap& map, const Album& album,
                   const MissionRecord& record);

}  // namespace scene
