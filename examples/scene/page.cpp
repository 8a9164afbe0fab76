// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
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

std::string how_it_ended(const Options& o, const MissionRecord& record) {
  const StepRecord& last = record.steps.back();
  if (last.index >= o.measurements) return "It ended after as many views as it was told. ";
  if (last.elapsed_s >= o.most_time_s()) return "It ended when its time was up, after the flight that it was on. ";
  if (last.travelled_m >= o.travel_m) return "It ended when its way was used up. ";
  return "It ended by itself: nothing was left to look at. ";
}

// Of an earlier mission, which may have had more of them.
void Page::clear() const {
  const auto numbered = [](const std::string& name, std::string_view what) {
    return name.starts_with(what) && name.ends_with(".png") && name.size() > what.size() + 4 &&
           name.find_first_not_of("0123456789", what.size()) == name.size() - 4;
  };
  std::vector<std::filesystem::path> old = {options.out / "mesh.ply", options.out / "mesh.glb"};
  for (const auto& entry : std::filesystem::directory_iterator(options.out)) {
    const std::string name = entry.path().filename().string();
    if (numbered(name, "view_") || numbered(name, "mesh_") || numbered(name, "rendering_")) old.push_back(entry.path());
  }
  for (const std::filesystem::path& file : old) std::filesystem::remove(file);
}

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
  // Colours that were fused have their light; a mesh without is a grey thing in ours.
  const bool coloured = !mesh.colours.empty();
  reconstructed.materials[0].colour.setConstant(coloured ? 1.0F : 0.8F);
  const SceneRenderer renderer(reconstructed, {.lighting = coloured ? Lighting::none() : Lighting{}});
  for (std::size_t i = 0; i < std::min<std::size_t>(3, album.strips().size()); ++i) {
    const Album::Strip& s = album.strips()[i * (album.strips().size() - 1) / 2 % album.strips().size()];
    Rendering<channel::Colour> seen;
    renderer.render(s.view, s.camera, seen);
    add(concat("mesh_", s.index, ".png"), concat("The mesh from view ", s.index),
        "What was reconstructed, as that camera would see it.", to_picture(seen));
  }
}

void Page::add_views(const Album& album) {
  for (const Album::Strip& s : album.strips())
    add(concat("view_", s.index, ".png"), concat("View ", s.index),
        "Colour, depth (bright is far) and class, as far as the sensor has them.", s.picture);
}

void Page::write(const MissionRecord& record) {
  for (const std::string& word : options.command) report.command += (report.command.empty() ? "" : " ") + word;
  write_file(options.out / "report.html", report_html(report, record));
}

}  // namespace scene
