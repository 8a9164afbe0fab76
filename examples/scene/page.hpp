// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include <vantage/geometry/triangle_mesh.hpp>
#include <vantage/mission/record.hpp>
#include <vantage/mission/report.hpp>

#include "album.hpp"
#include "options.hpp"

namespace scene {

/// The report as it grows, and the files beside it.
struct Page {
  const Options& options;
  Report report;

  /// Removes the meshes and the numbered pictures that a page before this one left.
  void clear() const;
  void add(const std::string& file, std::string title, std::string caption, const Picture& picture);
  /// mesh.ply, mesh.glb, and what the album's cameras would see of the mesh.
  void add_mesh(const TriangleMesh& mesh, const Album& album);
  void add_views(const Album& album);
  void write(const MissionRecord& record);
};

/// A sentence.
std::string how_it_ended(const Options& o, const MissionRecord& record);

}  // namespace scene
