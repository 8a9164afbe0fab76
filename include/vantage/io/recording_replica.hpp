// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/io/file.hpp>
#include <vantage/io/json.hpp>
#include <vantage/io/picture_list.hpp>
#include <vantage/io/recording.hpp>
#include <vantage/io/recording_folder.hpp>
#include <vantage/io/word_lines.hpp>

// Replica's trajectories as NICE-SLAM (Zhu et al., CVPR 2022) rendered them: nearly plain folders. traj.txt holds the
// poses, results/ the pictures frame*.jpg and depth*.png, and cam_params.json, in the folder above, the camera of all.
namespace vantage {

/// The camera of a cam_params.json, whose principal point counts from the centre of the top left pixel, and what 1
/// means in its depth pictures [m]: they hold `scale` at 1 m. Throws Error naming the place.
inline std::pair<Camera, double> parse_replica_camera(std::string_view text, const std::string& where) {
  const nlohmann::json parsed = parse_json(text, where);
  const JsonItem json = JsonItem(parsed, where).at("camera");
  const auto side = [&](const char* name) { return static_cast<int>(json.at(name).count(1 << 16)); };
  const auto value = [&](const char* name) { return json.at(name).number(); };
  const Camera camera{side("w"), side("h"), value("fx"), value("fy"), value("cx") + 0.5, value("cy") + 0.5};
  camera.validate(where);
  return {camera, 1 / json.at("scale").number(1e-6, 1e12)};
}

/// Reads a scene of NICE-SLAM's Replica. Throws Error naming the file (and line) that is missing or wrong.
inline Recording read_replica_recording(const std::filesystem::path& folder) {
  const std::filesystem::path above = folder / ".." / "cam_params.json", poses_file = folder / "traj.txt";
  const std::filesystem::path camera_file = file_exists(above) ? above : folder / "cam_params.json";
  const auto [camera, depth_unit_m] =
      parse_replica_camera(read_file(camera_file, JsonLimits{}.bytes), camera_file.string());
  const std::vector<View> poses = parse_poses(read_file(poses_file, WordLimits{}.bytes), poses_file.string());
  const auto colour = pictures(folder / "results", "frame"), depth = pictures(folder / "results", "depth");
  return {folder.string(), detail::frames(poses_file, poses, camera, colour, depth, {}), depth_unit_m};
}

}  // namespace vantage
