// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "missions.hpp"

#include <cmath>

#include "explore.hpp"
#include "reconstruct.hpp"

namespace scene {

nlohmann::ordered_json config(const Options& o, const Input& input) {
  const auto budget = [](double x) { return std::isfinite(x) ? nlohmann::ordered_json(x) : nlohmann::ordered_json(); };
  nlohmann::ordered_json c = {{"mission", "scene"}, {"input", input.name}, {"method", o.method}};
  c["clock"] = vantage::name_of(o.clock);
  if (o.clock == ClockKind::modelled) c["modelled_s"] = {o.costs().mapping_s, o.costs().planning_s};
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

Mission fly_mission(const Options& o, const Input& input, std::ostream& log) {
  const bool thesis = o.preset == PresetKind::thesis;
  if (!o.explores()) return look_around(o, input, log);
  if (o.reconstructs())
    return thesis ? reconstruct<preset::thesis>(o, input, log) : reconstruct<preset::reference>(o, input, log);
  return thesis ? explore<RayCast>(o, input, log) : explore<Projective>(o, input, log);
}

}  // namespace scene
