// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// A robot sees a scene for the first time: it reconstructs a home with surfels or explores it (chapter 6), or looks at
// objects or through a recording from given views.
#include <cmath>
#include <iostream>

#include "explore.hpp"
#include "missions.hpp"
#include "reconstruct.hpp"

namespace scene {

/// All that determines the mission, besides the seed.
nlohmann::ordered_json config(const Options& o, const Input& input) {
  const auto budget = [](double x) { return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(); };
  nlohmann::ordered_json c = {{"mission", "scene"}, {"input", input.name}, {"method", o.method}};
  c["clock"] = vantage::name_of(o.clock);
  if (!input.recording) {
    c["camera_px"] = o.pixels;
    c["field_of_view_deg"] = o.field_of_view_deg;
    c["depth_noise"] = o.depth_noise;
    c["body_radius_m"] = o.body_radius_m;
  }
  if (o.explores()) {
    c["preset"] = vantage::name_of(o.preset);
    c["map_voxel_m"] = o.map_voxel();
    c["map"] = o.reconstructs() ? "surfels" : "voxels";
    c["speed_m_s"] = o.speed_m_s;
    if (o.refine_per_s > 0) c["refine_per_s"] = o.refine_per_s;
    const Eigen::Vector3d start = input.start.position();
    c["start_m"] = {start.x(), start.y(), start.z()};
  } else {
    c["candidates"] = input.views.size();
  }
  c["range_m"] = o.range_m;
  c["voxel_m"] = o.voxel_m;
  c["threshold_m"] = o.threshold_m;
  if (o.reconstructs()) {
    c["test_views"] = o.test_views;
    c["judge_every_s"] = o.judge_every_s;
  }
  c["budget_s"] = budget(o.most_time_s());
  c["budget_travel_m"] = budget(o.travel_m);
  if (o.most_measurements()) c["budget_measurements"] = *o.most_measurements();
  return c;
}

}  // namespace scene

namespace {

void run(const scene::Options& o) {
  scene::validate(o);
  vantage::make_folder(o.out);
  const scene::Input input = scene::load(o);
  std::cerr << input.name << ". " << input.note << '\n';
  if (!o.explores())
    scene::look_around(o, input);
  else if (o.reconstructs() && o.preset == vantage::PresetKind::thesis)
    scene::reconstruct<vantage::preset::thesis>(o, input);
  else if (o.reconstructs())
    scene::reconstruct<vantage::preset::reference>(o, input);
  else if (o.preset == vantage::PresetKind::thesis)
    scene::explore<vantage::RayCast>(o, input);
  else
    scene::explore<vantage::Projective>(o, input);
  std::cout << (o.out / "report.html").string() << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A robot explores a scene, or looks around in it, and reconstructs it.", "scene");
  scene::Options options;
  options.command.assign(argv, argv + argc);
  scene::add_options(app, options);
  return vantage::run_program(app, argc, argv, std::cout, std::cerr,
                              [&] { vantage::with_threads(options.threads, [&] { run(options); }); });
}
