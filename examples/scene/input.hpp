// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vantage/geometry/mesh_sampling.hpp>
#include <vantage/io/recording_aligned.hpp>
#include <vantage/io/recording_any.hpp>
#include <vantage/io/scene_file.hpp>
#include <vantage/sim/object_scene.hpp>
#include <vantage/sim/ray_scene.hpp>
#include <vantage/sim/room.hpp>

#include "options.hpp"
#include "visible_space.hpp"

namespace scene {

/// What there is to see, and from where it may be looked at.
struct Input {
  std::string name, note;
  std::optional<Scene> scene = {};          ///< simulated, or
  std::optional<Recording> recording = {};  ///< replayed
  View start;
  std::vector<View> views = {};  ///< candidates
  Box3 bounds = {};              ///< to be reconstructed
  // Of a scene, not of a recording:
  std::optional<RayScene> rays = {};
  SurfaceSamples surface = {};  ///< what can be seen from the candidates' free space

  [[nodiscard]] SeenSurface unseen(const Options& o) const { return {surface, rays.value(), o.range_m}; }
};

/// Inside: everywhere that the robot's body reaches from the start, with a random heading that looks a little down.
inline void look_from_inside(Input& input, const Options& o) {
  const Scene& scene = *input.scene;
  input.bounds = scene.mesh.bounds();
  const Eigen::Vector3d centre = input.bounds.center();
  input.start = scene.start.value_or(look_at(centre, centre + Eigen::Vector3d::UnitX()));
  if (!o.start.empty()) input.start.T_W_C.translation() = Eigen::Vector3d(o.start[0], o.start[1], o.start[2]);
  const Eigen::Vector3d start = input.start.position();
  if (!input.bounds.contains(start)) {
    const auto rounded = [](const Eigen::Vector3d& p) { return ((100 * p).array().round() / 100).transpose().eval(); };
    throw Error(
        input.name, concat("the start (", start.transpose(), ") is outside of the scene"),
        concat("--start X Y Z between (", rounded(input.bounds.min()), ") and (", rounded(input.bounds.max()), ")"));
  }
  const RayScene& rays = input.rays.emplace(scene);
  const std::vector<Eigen::Vector3d> positions = free_positions(scene, start, o);
  if (positions.empty())
    throw Error(input.name,
                concat("the start (", start.transpose(), ") is within ", o.body_radius_m, " m of a surface"),
                "--start X Y Z in the open, or a smaller --body");
  input.note += concat(input.note.empty() ? "" : " ", "The robot's body can be in ",
                       tenths(static_cast<double>(positions.size()) * std::pow(spacing_m(o), 3)), " m^3 of it.");
  if (const double open = open_sky(rays, start); open > 0.3)
    input.note += concat(" In ", std::round(100 * open),
                         " % of all directions from the start there is nothing: it may "
                         "be outside.");
  Rng rng = Rng(o.seed).fork(12);
  for (const Eigen::Vector3d& p : positions) {
    const double heading_rad = rng.uniform(0, 2 * std::numbers::pi), pitch_rad = rng.uniform(deg(-30), deg(15));
    const Eigen::Vector3d forward(std::cos(heading_rad), std::sin(heading_rad), std::tan(pitch_rad));
    input.views.push_back(look_at(p, p + forward));
  }
  input.surface = seen_from(scene, rays, positions, o);
}

/// Around: evenly over a hemisphere, at a distance from which all is in view (Fibonacci's spiral).
inline void look_from_around(Input& input, const Box3& objects, const Options& o) {
  const double radius_m = 0.5 * objects.diagonal().norm(),
               distance_m = 1.2 * radius_m / std::sin(0.5 * deg(o.field_of_view_deg));
  if (distance_m + radius_m > o.range_m)
    throw Error("--range", concat(o.range_m, " m"),
                concat("at least ", distance_m + radius_m, " m: these objects are ", 2 * radius_m, " m across"));
  constexpr int count = 400;
  std::vector<Eigen::Vector3d> positions;
  for (int i = 0; i < count; ++i) {
    const double z = 0.15 + 0.8 * (i + 0.5) / count, r = std::sqrt(1 - z * z),
                 turn = i * std::numbers::pi * (3 - std::sqrt(5.0));
    positions.push_back(objects.center() + distance_m * Eigen::Vector3d(r * std::cos(turn), r * std::sin(turn), z));
    input.views.push_back(look_at(positions.back(), objects.center()));
  }
  input.start = input.views.front();
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(0.1);
  input.bounds = Box3(objects.min() - margin, objects.max() + margin);
  input.surface = seen_from(*input.scene, input.rays.emplace(*input.scene), positions, o);
  std::vector<std::uint8_t> inside;  // the ground goes on beyond
  for (const Eigen::Vector3f& p : input.surface.points) inside.push_back(input.bounds.contains(p.cast<double>()));
  input.surface = input.surface.where(inside);
}

/// As it was recorded; bounded by what the recording saw within range.
inline void look_again(Input& input, const Options& o) {
  const Recording& recording = *input.recording;
  input.views = recording.views();
  input.start = input.views.front();
  for (std::size_t i = 0; i < recording.size(); ++i) {
    const Frame f = recording.frame(i);
    for (Eigen::Index row = 0; row < f.depth.rows(); row += 8)
      for (Eigen::Index column = 0; column < f.depth.cols(); column += 8)
        if (const auto d = static_cast<double>(f.depth(row, column)); d <= o.range_m)  // not NaN
          input.bounds.extend(f.view.T_W_C *
                              (d * f.camera.ray(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5)));
  }
  if (input.bounds.isEmpty())
    throw Error(recording.where(), concat("no depth within ", o.range_m, " m"),
                "frames with depth, or a larger --range");
  input.bounds =
      Box3(input.bounds.min() - Eigen::Vector3d::Constant(0.1), input.bounds.max() + Eigen::Vector3d::Constant(0.1));
}

/// What a file or folder is called, with or without a slash at the end.
inline std::string title_of(const std::filesystem::path& path) {
  const std::filesystem::path p = path.lexically_normal();
  return (p.has_filename() ? p : p.parent_path()).filename().string();
}

/// Where examples/data/fetch_scenes puts the homes.
inline std::filesystem::path default_scene() {
  return std::filesystem::path(__FILE__).parent_path().parent_path() / "data" / "scenes" / "Studio";
}

/// What was asked for; without any of it, the home that fetch_scenes gets, or a procedural room with a note.
inline Input load(const Options& o) {
  Input input;
  const auto add = [&](const std::vector<std::string>& notes) {
    for (const std::string& note : notes)
      input.note += concat(input.note.empty() ? "" : " ", note, note.ends_with('.') ? "" : ".");
  };
  if (!o.recording.empty()) {
    input.recording = has_first_pose_only(o.recording)
                          ? read_aligned_recording(o.recording, {.range_m = o.range_m}).recording
                          : read_recording(o.recording);
    input.name = title_of(o.recording);
    input.note = concat("A recording of ", input.recording->size(), " frames.");
    add(input.recording->notes());
    look_again(input, o);
    return input;
  }
  if (!o.objects.empty()) {
    std::vector<Scene> models;
    for (const std::filesystem::path& path : o.objects) models.push_back(read_scene(path));
    ObjectScene composed = compose_objects(models, Rng(o.seed).fork(13));
    input.name = concat(models.size(), models.size() == 1 ? " object" : " objects");
    input.note = "Models on a ground plane, at random places and headings.";
    input.scene = std::move(composed.scene);
    add(input.scene->notes);
    look_from_around(input, composed.bounds, o);
    return input;
  }
  const std::filesystem::path file = o.scene.empty() && !o.room ? default_scene() : o.scene;
  if (!file.empty() && (!o.scene.empty() || std::filesystem::exists(file))) {
    input.name = title_of(file);
    input.scene = read_scene(file);
  } else {
    const std::uint64_t seed = o.room.value_or(o.seed);
    input.name = concat("room ", seed);
    input.note = "A room made from a seed.";
    if (!o.room) input.note += " No home was at hand: examples/data/fetch_scenes gets some when there is a network.";
    input.scene = procedural_room({}, Rng(seed)).scene;
  }
  add(input.scene->notes);
  look_from_inside(input, o);
  return input;
}

}  // namespace scene
