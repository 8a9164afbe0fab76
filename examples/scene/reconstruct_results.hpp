// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

#include <vantage/geometry/triangle_mesh.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/mission/record.hpp>

#include "album.hpp"
#include "referee.hpp"
#include "surfel_judge.hpp"

namespace scene {

/// What became of a reconstruction with surfels.
struct Reconstruction {
  std::vector<Score> scores;  ///< over mission time; the last is that of the end
  std::size_t test_views;     ///< that they are of
  TriangleMesh mesh;
  std::vector<Picture> comparisons = {};  ///< rendered, truth, confidence, normals, side by side
};

/// The report: renderings beside the truth, the mesh, the map from above with the way, the curves.
void write_reconstruction(const Options& o, const Input& input, const Referee& referee, const Reconstruction& result,
                          const Album& album, const MissionRecord& record);

}  // namespace scene
