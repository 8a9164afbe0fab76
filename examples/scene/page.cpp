// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <vantage/concepts/channels.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/io/png.hpp>
#include <vantage/io/write_glb.hpp>
#include <vantage/io/write_ply.hpp>
#include <vantage/sim/scene_renderer.hpp>

namespace scene {

double tenths(double x) { return std::round(10 * x) / 10; }

void Page::add(const std::string& file, std::string title, std::string caption, const Picture& picture) {
  std::vector<std::byte> png = encode_png(picture);
  write_file(options.out / file, png);
  report.pictures.push_back({std::move(title), std::move(caption), std::move(png)});
}

void Page::add_mesh(const TriangleMesh& mesh, const Album& album) {
  if (mesh.empty()) {
    report.lead += " No surface came of it.";
    return;
  }
  write_file(options.out / "mesh.ply", encode_ply(mesh));
  write_file(options.out / "mesh.glb", encode_glb(mesh));
  Scene reconstructed{.mesh = mesh, .uv = {}, .material = {}, .label = {}, .textures = {}, .notes = {}};
  reconstructed.materials[0].colour.setOnes();
  const SceneRenderer renderer(reconstructed, {.lighting = Lighting::none()});
  for (std::size_t i = 0; i < std::min<std::size_t>(3, album.strips().size()); ++i) {
    const Album::Strip& s = album.strips()[i * (album.strips().size() - 1) / 2 % album.strips().size()];
    Rendering<channel::Colour> seen;
    renderer.render(s.view, s.camera, seen);
    add(concat("mesh_", s.index, ".png"), concat("The mesh from view ", s.index),
        "What was reconstructed, as that camera would see it.", to_picture(seen));
  }
}

void Page::add_views(const Album& album) {
  for (const auto& entry : std::filesystem::directory_iterator(options.out)) {  // of an earlier, longer mission
    const std::string name = entry.path().filename().string();
    if (name.starts_with("view_") && name.ends_with(".png")) std::filesystem::remove(entry.path());
  }
  for (const Album::Strip& s : album.strips())
    add(concat("view_", s.index, ".png"), concat("View ", s.index),
        "Colour, depth (bright is far) and class, as far as the sensor has them.", s.picture);
}

void Page::write(const MissionRecord& record) {
  for (const std::string& word : options.command) report.command += (report.command.empty() ? "" : " ") + word;
  write_file(options.out / "report.html", report_html(report, record));
}

}  // namespace scene
