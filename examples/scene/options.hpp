// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/mission/command_line.hpp>
#include <vantage/sim/rgbd_camera.hpp>

namespace scene {

using namespace vantage;

inline double tenths(double x) { return std::round(10 * x) / 10; }

inline const std::vector<MethodName>& methods() {
  static const std::vector<MethodName> list = {
      {"ours", "reconstructs with surfels: regions of interest, for unexplored space and unsure surfaces (ch. 6)"},
      {"without_roi", "the same from views around the robot alone"},
      {"view_count", "the same, with confidence by the number of views"},
      {"fisher", "reconstructs with surfels: frontiers, for most Fisher information"},
      {"fbe", "explores: frontiers (6.2.2), then all around, for most sides that were not seen yet"},
      {"nbvp", "explores: the same by a tree of views, the first of its best branch is flown (2.2.3)"},
      {"information_gain", "explores: frontiers, for most expected information"},
      {"random", "any view; in a scene, of those that can be flown to"},
      {"max_view_distance", "the view farthest from all that were taken"},
      {"in_order", "the views as they are listed: a recording as it was made"}};
  return list;
}

struct Options : MissionOptions {
  std::filesystem::path scene = {};                 ///< --scene: a folder, or a mesh
  std::vector<std::filesystem::path> objects = {};  ///< --object: models on a ground plane
  std::filesystem::path recording = {};             ///< --recording
  std::optional<std::uint64_t> room = {};           ///< --room SEED: a procedural one
  std::vector<double> start = {};                   ///< --start X Y Z
  int pixels = 512;
  double field_of_view_deg = 60;
  double range_m = 5;
  double depth_noise = 0.01;
  double body_radius_m = 0.2;
  double voxel_m = 0.02;
  double threshold_m = 0.02;
  std::optional<double> map_voxel_m = {};
  std::string map = {};  ///< --map: voxels or surfels; empty: what the method is for
  double speed_m_s = 1;
  int test_views = 100;
  double judge_every_s = 60;
  double refine_per_s = 0;
  bool keep_views = true;

  Options() {
    out = "out/scene";
    method = "ours";
  }
  /// Objects and recordings are only looked at from given views.
  [[nodiscard]] bool can_explore() const { return objects.empty() && recording.empty(); }
  [[nodiscard]] bool is(std::initializer_list<std::string_view> names) const {
    return std::find(names.begin(), names.end(), method) != names.end();
  }
  [[nodiscard]] bool needs_surfels() const { return is({"ours", "without_roi", "view_count", "fisher"}); }
  [[nodiscard]] bool reconstructs() const { return needs_surfels() || map == "surfels"; }
  /// Flies through what its map says is free, whatever the map.
  [[nodiscard]] bool explores() const {
    return needs_surfels() || is({"fbe", "nbvp", "information_gain"}) || (method == "random" && can_explore());
  }
  [[nodiscard]] double map_voxel() const { return map_voxel_m.value_or(reconstructs() ? 0.2 : 0.05); }
  /// What a step costs by the modelled clock: with surfels, what the thesis' computer takes (section 6.2.1).
  [[nodiscard]] ModelledClock::Config costs() const {
    return reconstructs() ? ModelledClock::Config{.mapping_s = 1, .planning_s = 0.5}
                          : ModelledClock::Config{.mapping_s = 0.1, .planning_s = 0.1};
  }
  [[nodiscard]] RgbdConfig sensor() const {
    return {.camera = Camera::from_fov(pixels, pixels, deg(field_of_view_deg)),
            .depth_noise = depth_noise,
            .max_depth_m = range_m};
  }
  /// Unless told, the 5 minutes of ch. 6, or 15: an exploration at random never ends by itself.
  [[nodiscard]] double most_time_s() const {
    return explores() && std::isinf(budget_s) ? reconstructs() ? 300 : 900 : budget_s;
  }
  [[nodiscard]] std::optional<std::uint64_t> most_measurements() const {
    if (measurements != std::numeric_limits<std::uint64_t>::max()) return measurements;
    return explores() ? std::nullopt : std::optional<std::uint64_t>(40);
  }
  [[nodiscard]] AnyOf<MissionTime, Measurements, Travel> stop_rule() const {
    const auto finite = [](double x) { return std::min(x, std::numeric_limits<double>::max()); };
    return AnyOf{MissionTime{finite(most_time_s())}, Measurements{most_measurements().value_or(measurements)},
                 Travel{finite(travel_m)}};
  }
};

inline void add_options(CLI::App& app, Options& o) {
  add_mission_options(app, o, methods());
  app.get_option("--budget")->default_str("300 with surfels, 900 with voxels; none to look around");
  app.parse_complete_callback([&app, &o] {
    if (app.count("--method") == 0 && !o.can_explore()) o.method = "max_view_distance";
    if (app.count("--range") == 0 && !o.objects.empty()) o.range_m = 20;  // from where all of them are in view
    for (const char* name : {"--refine", "--test-views", "--judge-every"})
      if (app.count(name) != 0 && !o.reconstructs())
        throw CLI::ValidationError(name, concat("is for a map of surfels, which ", o.method, " does not learn"));
  });
  const CLI::Validator not_empty([](const std::string& text) { return text.empty() ? "an empty name" : ""; }, "");
  app.add_option("--scene", o.scene, "Where to look around: a folder with a scene.json, or a mesh (OBJ, glTF, PLY)")
      ->check(not_empty)
      ->type_name("DIR|FILE");
  app.add_option("--object", o.objects, "What to look at: models that are put on a ground plane, at random poses")
      ->type_name("PATH...");
  auto* const recording =
      app.add_option("--recording", o.recording,
                     "A recording with depth instead of a simulation: TUM RGB-D, transforms.json, Replica, or colour/ "
                     "depth/ poses.txt camera.txt")
          ->check(not_empty)
          ->type_name("DIR|FILE");
  app.add_option("--room", o.room, "A furnished room made from a seed")
      ->check(vantage::detail::whole_number())
      ->type_name("SEED");
  app.add_option("--start", o.start, "Where the camera starts (default: where the scene says)")
      ->expected(3)
      ->check(vantage::detail::between(-1e6, 1e6))
      ->type_name("X Y Z");
  const auto number = [&](const char* name, double& value, const char* about, double low, double high,
                          const char* unit) {
    return app.add_option(name, value, about)
        ->check(vantage::detail::between(low, high))
        ->capture_default_str()
        ->type_name(unit);
  };
  app.add_option("--pixels", o.pixels, "Width and height of the simulated camera")
      ->check(CLI::Range(16, 4096))
      ->excludes(recording)
      ->capture_default_str()
      ->type_name("N");
  number("--fov", o.field_of_view_deg, "Its field of view", 5, 150, "DEGREES")->excludes(recording);
  number("--range", o.range_m, "Depths beyond have no value", 0.1, 1000, "METRES")->default_str("5, of objects 20");
  number("--depth-noise", o.depth_noise, "Standard deviation of a depth, as a share of it", 0, 1, "SHARE");
  number("--body", o.body_radius_m, "Radius of the robot, which keeps so far from every surface", 0.01, 10, "METRES");
  number("--voxel", o.voxel_m, "Voxels of the reconstruction", 0.001, 1, "METRES");
  app.add_option("--map-voxel", o.map_voxel_m,
                 "Voxels of the map that a robot flies by (default: 0.05; of surfels 0.2)")
      ->check(vantage::detail::between(0.01, 1.0))
      ->type_name("METRES");
  app.add_option("--map", o.map, "What fbe and random learn (default: voxels; the methods of surfels learn both)")
      ->check(CLI::IsMember({"voxels", "surfels"}))
      ->type_name("voxels|surfels");
  app.add_option("--test-views", o.test_views, "Views that surfels are judged by, beside the truth")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str()
      ->type_name("N");
  number("--judge-every", o.judge_every_s, "Mission time between judgements of surfels", 1, 1e6, "SECONDS");
  number("--refine", o.refine_per_s, "Iterations that surfels are trained on for every second of flight", 0, 1000,
         "PER_S");
  app.add_flag_callback(
      "--no-views", [&o] { o.keep_views = false; }, "Keep no files of what a simulated camera saw");
  number("--speed", o.speed_m_s, "How fast an explorer flies", 0.01, 100, "METRES/S");
  number("--threshold", o.threshold_m, "A surface is complete where the reconstruction is nearer", 0.001, 1, "METRES");
}

/// Throws Error for options that contradict each other.
inline void validate(const Options& o) {
  const int inputs = !o.scene.empty() + !o.objects.empty() + !o.recording.empty() + o.room.has_value();
  if (inputs > 1) throw Error("--scene, --object, --recording, --room", concat(inputs, " of them"), "one at most");
  if (o.explores() && !o.can_explore())
    throw Error("--method", concat(o.method, " flies through a scene"), "--scene or --room, or another method");
  if (o.needs_surfels() && o.map == "voxels") throw Error("--map", concat("voxels for ", o.method), "surfels");
  if (o.map == "surfels" && !o.needs_surfels() && !o.is({"fbe", "random"}))
    throw Error("--map", concat("surfels for ", o.method), "fbe or random, or a method of surfels");
  if (!o.start.empty() && !o.can_explore()) throw Error("--start", "views are given", "--scene or --room");
  if (o.resume && !o.explores()) throw Error("--resume", "a look-around keeps no checkpoint", "a run from the start");
}

}  // namespace scene
