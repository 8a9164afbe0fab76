// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture_list.hpp>
#include <vantage/io/printable.hpp>
#include <vantage/io/recording.hpp>
#include <vantage/io/word_lines.hpp>

// The plainest recording, and what this project's scripts write:
//
//     camera.txt    width, height, fx, fy, cx, cy [px] and, if there is depth, depth_unit_m: "name value" lines.
//                   The centre of the top left pixel is (0.5, 0.5).
//     poses.txt     a line a frame: the 16 numbers of T_W_C (camera points to world points), row by row; or 12,
//                   without the last row. Camera x right, y down, z forward; world z up; metres.
//     colour/       PNG, JPEG, PGM or PPM pictures, as many as poses, in the order of their names (2.png before 10.png)
//     depth/        16-bit PNG or PGM, camera z in depth_unit_m; 0 = no value
//     labels/       8- or 16-bit PNG or PGM, class numbers; 0 = unknown
//
// One of colour/ and depth/ must be there.
namespace vantage {

/// The camera of a camera.txt, and its depth_unit_m if told. Throws Error naming the line, or all that is missing.
inline std::pair<Camera, std::optional<double>> parse_camera(std::string_view text, const std::string& where) {
  Camera camera;
  std::optional<double> width, height, fx, fy, cx, cy, depth_unit_m;
  const std::array<std::pair<std::string_view, std::optional<double>*>, 7> members = {
      {{"width", &width},
       {"height", &height},
       {"fx", &fx},
       {"fy", &fy},
       {"cx", &cx},
       {"cy", &cy},
       {"depth_unit_m", &depth_unit_m}}};
  for (WordLines lines(text, where); lines.next();) {
    const auto* member =
        std::find_if(members.begin(), members.end(), [&](const auto& m) { return m.first == lines.word(0); });
    if (member == members.end())
      lines.refuse(concat("'", printable(lines.word(0)), "'"),
                   "width, height, fx, fy, cx, cy or depth_unit_m, and a number");
    if (lines.size() != 2 || *member->second) lines.refuse(concat("more than one value of ", member->first), "one");
    *member->second = lines.number(1);
  }
  std::string missing;
  for (std::size_t i = 0; i + 1 < members.size(); ++i)
    if (!*members[i].second) (missing += missing.empty() ? "" : ", ") += members[i].first;
  if (!missing.empty()) throw Error(where, "no value of " + missing, "'name value' lines");
  const auto side = [&](double px, const char* name) {
    if (!(px >= 1 && px <= 1 << 16) || px != std::floor(px)) throw Error(where, concat(name, " ", px), "1 to 65536 px");
    return static_cast<int>(px);
  };
  camera = {side(*width, "width"), side(*height, "height"), *fx, *fy, *cx, *cy};
  camera.validate(where);
  if (depth_unit_m && !(*depth_unit_m > 0)) throw Error(where, concat("depth_unit_m ", *depth_unit_m), "> 0");
  return {camera, depth_unit_m};
}

/// The poses of a poses.txt. Throws Error naming the line.
inline std::vector<View> parse_poses(std::string_view text, const std::string& where) {
  std::vector<View> out;
  for (WordLines lines(text, where); lines.next();) {
    if (lines.size() != 16 && lines.size() != 12)
      lines.refuse(concat(lines.size(), " numbers"), "16 or 12: a 4 x 4 or 3 x 4 matrix, row by row");
    Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
    for (std::size_t i = 0; i < lines.size(); ++i)
      T(static_cast<Eigen::Index>(i / 4), static_cast<Eigen::Index>(i % 4)) = lines.number(i);
    out.push_back(rigid_view(T, lines.where()));
  }
  return out;
}

namespace detail {

/// Frames of poses and as many pictures of each channel that there is.
inline std::vector<RecordedFrame> frames(const std::filesystem::path& poses_file, const std::vector<View>& poses,
                                         const Camera& camera, const std::vector<std::filesystem::path>& colour,
                                         const std::vector<std::filesystem::path>& depth,
                                         const std::vector<std::filesystem::path>& labels) {
  const auto check = [&](std::size_t n, const char* channel) {
    if (n != 0 && n != poses.size())
      throw Error(poses_file.string(), concat(poses.size(), " poses for ", n, " pictures of ", channel),
                  "as many: one a frame");
  };
  check(colour.size(), "colour");
  check(depth.size(), "depth");
  check(labels.size(), "labels");
  std::vector<RecordedFrame> out(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    out[i].view = poses[i];
    out[i].camera = camera;
    if (!colour.empty()) out[i].colour = colour[i];
    if (!depth.empty()) out[i].depth = depth[i];
    if (!labels.empty()) out[i].labels = labels[i];
  }
  return out;
}

}  // namespace detail

/// Reads the plain folder described above. Throws Error naming the file (and line) that is missing or wrong.
inline Recording read_folder_recording(const std::filesystem::path& folder) {
  const std::filesystem::path camera_file = folder / "camera.txt", poses_file = folder / "poses.txt";
  const auto [camera, depth_unit_m] = parse_camera(read_file(camera_file, WordLimits{}.bytes), camera_file.string());
  const std::vector<View> poses = parse_poses(read_file(poses_file, WordLimits{}.bytes), poses_file.string());
  const auto colour = pictures(folder / "colour"), depth = pictures(folder / "depth"),
             labels = pictures(folder / "labels");
  if (colour.empty() && depth.empty()) throw Error(folder.string(), "no pictures in colour/ or depth/", "one a pose");
  if (!depth.empty() && !depth_unit_m) throw Error(camera_file.string(), "no value of depth_unit_m", "for depth/ [m]");
  return {folder.string(), detail::frames(poses_file, poses, camera, colour, depth, labels), depth_unit_m.value_or(1)};
}

}  // namespace vantage
