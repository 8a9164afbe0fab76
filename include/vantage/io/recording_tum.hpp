// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
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
#include <vantage/io/frame_pictures.hpp>
#include <vantage/io/recording.hpp>
#include <vantage/io/word_lines.hpp>

// Recordings as the TUM RGB-D benchmark lays them out (Sturm et al., "A benchmark for the evaluation of RGB-D SLAM
// systems", IROS 2012): rgb.txt, depth.txt ("time file") and groundtruth.txt ("time tx ty tz qx qy qz qw": optical
// frame to world). ETH3D's SLAM benchmark adds calibration.txt ("fx fy cx cy").
namespace vantage {

/// A thing that happened at a time.
template <class T>
struct Timed {
  double time_s;
  T value;
};

/// The same things in the order of time, equals as they were. (std::stable_sort of libstdc++ 12 moves them through a
/// buffer that is not aligned for a View.)
template <class T>
std::vector<Timed<T>> sorted_by_time(const std::vector<Timed<T>>& items) {
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < items.size(); ++i) order.emplace_back(items[i].time_s, i);
  std::sort(order.begin(), order.end());
  std::vector<Timed<T>> out;
  out.reserve(items.size());
  for (const auto& [time_s, i] : order) out.push_back(items[i]);
  return out;
}

struct TumConfig {
  /// Default: by calibration.txt or, where there is none, ROS' default of 525 px and a principal point in the middle,
  /// which the benchmark's registered pictures assume; noted.
  std::optional<Camera> camera = {};
  double depth_per_m = 5000;        ///< what a depth picture holds at 1 m; finite, > 0
  double most_difference_s = 0.02;  ///< between the times of what is put together; finite, >= 0
};

/// A list of files ("time name" a line), in the order of time. Throws Error naming the line.
inline std::vector<Timed<std::string>> parse_tum_list(std::string_view text, const std::string& where) {
  std::vector<Timed<std::string>> out;
  for (WordLines lines(text, where); lines.next();) out.push_back({lines.number(0), std::string(lines.rest(1))});
  return sorted_by_time(out);
}

/// A trajectory ("time tx ty tz qx qy qz qw" a line), in the order of time. Throws Error naming the line.
inline std::vector<Timed<View>> parse_tum_trajectory(std::string_view text, const std::string& where) {
  std::vector<Timed<View>> out;
  for (WordLines lines(text, where); lines.next();) {
    const auto n = [&](std::size_t i) { return lines.number(i); };
    const double time_s = n(0);
    const Eigen::Vector3d t(n(1), n(2), n(3));
    const Eigen::Quaterniond q(n(7), n(4), n(5), n(6));
    out.push_back({time_s, {rigid_transform(q, t, lines.where())}});
  }
  return sorted_by_time(out);
}

/// Of things in the order of time, the one nearest to `time_s` (the earlier of two), if it is within `most_s`.
template <class T>
const Timed<T>* nearest_in_time(const std::vector<Timed<T>>& sorted, double time_s, double most_s) {
  auto it = std::lower_bound(sorted.begin(), sorted.end(), time_s,
                             [](const Timed<T>& item, double t) { return item.time_s < t; });
  if (it == sorted.end() || (it != sorted.begin() && time_s - (it - 1)->time_s <= it->time_s - time_s)) {
    if (it == sorted.begin()) return nullptr;
    --it;
  }
  return std::abs(it->time_s - time_s) <= most_s ? &*it : nullptr;
}

/// fx fy cx cy, with the centre of the top left pixel at (0, 0) as OpenCV and this benchmark count.
inline Camera parse_tum_calibration(std::string_view text, const std::string& where, int width, int height) {
  WordLines lines(text, where);
  if (!lines.next()) throw Error(where, "the file is empty", "fx fy cx cy");
  if (lines.size() != 4) lines.refuse(concat(lines.size(), " numbers"), "fx fy cx cy: a pinhole without distortion");
  const Camera camera{width, height, lines.number(0), lines.number(1), lines.number(2) + 0.5, lines.number(3) + 0.5};
  camera.validate(lines.where());
  return camera;
}

/// Reads a TUM RGB-D folder: each colour picture with the depth picture and the pose nearest in time. Colour pictures
/// without a partner in time are left out, and noted. Throws Error naming the file (and line) that is missing or wrong.
inline Recording read_tum_recording(const std::filesystem::path& folder, const TumConfig& config = {}) {
  Check check("TumConfig");
  check.positive("depth_per_m", config.depth_per_m);
  check.not_negative("most_difference_s", config.most_difference_s);
  check.done();
  const auto text = [&](const char* name) { return read_file(folder / name, WordLimits{}.bytes); };
  const auto list = [&](const char* name) { return parse_tum_list(text(name), (folder / name).string()); };
  const auto colour = list("rgb.txt"), depth = list("depth.txt");
  const auto poses = parse_tum_trajectory(text("groundtruth.txt"), (folder / "groundtruth.txt").string());
  if (colour.empty()) throw Error((folder / "rgb.txt").string(), "no picture is listed", "'time file' lines");

  std::vector<std::string> notes;
  Camera camera;
  if (config.camera) {
    camera = *config.camera;
  } else {
    const auto [width, height] = picture_size(folder / colour.front().value);
    if (file_exists(folder / "calibration.txt")) {
      camera = parse_tum_calibration(text("calibration.txt"), (folder / "calibration.txt").string(), width, height);
    } else {
      camera = {width, height, 525, 525, 0.5 * width, 0.5 * height};
      notes.push_back("no calibration.txt: a focal length of 525 px is assumed");
    }
  }

  std::vector<RecordedFrame> frames;
  for (const auto& [time_s, name] : colour) {
    const auto* d = nearest_in_time(depth, time_s, config.most_difference_s);
    const auto* pose = nearest_in_time(poses, time_s, config.most_difference_s);
    if (d && pose) frames.push_back({pose->value, camera, folder / name, folder / d->value, {}, time_s});
  }
  if (frames.empty())
    throw Error(folder.string(), "no colour picture has a depth picture and a pose of its time",
                concat("times that differ by at most ", config.most_difference_s, " s"));
  if (frames.size() < colour.size())
    notes.push_back(concat(colour.size() - frames.size(), " of ", colour.size(),
                           " colour pictures have no depth picture or pose within ", config.most_difference_s,
                           " s and are left out"));
  return {folder.string(), std::move(frames), 1 / config.depth_per_m, std::move(notes)};
}

}  // namespace vantage
