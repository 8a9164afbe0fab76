// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <vantage/geometry/alignment.hpp>
#include <vantage/io/recording_any.hpp>
#include <vantage/io/recording_folder.hpp>

namespace scene {

using namespace vantage;

/// The frame without what lies beyond `range_m`.
inline Frame within(Frame frame, double range_m) {
  const auto most = static_cast<float>(range_m);
  frame.depth = (frame.depth <= most).select(frame.depth, std::numeric_limits<float>::quiet_NaN());
  return frame;
}

/// A recording; one that has depth/ and first_pose.txt but no poses gets them by aligning each frame's surface within
/// range to the first one's, beginning at the pose of the frame before. Throws Error, besides what reading throws, if a
/// frame does not align.
inline Recording read_posed(const std::filesystem::path& folder, double range_m) {
  if (!std::filesystem::exists(folder / "first_pose.txt") || std::filesystem::exists(folder / "poses.txt"))
    return read_recording(folder);
  const std::filesystem::path first_pose = folder / "first_pose.txt";
  const auto [camera, unit_m] = parse_camera(read_file(folder / "camera.txt", 4096), (folder / "camera.txt").string());
  const std::vector<View> poses = parse_poses(read_file(first_pose, 4096), first_pose.string());
  if (poses.empty() || !unit_m)
    throw Error(folder.string(), "no first pose, or no depth_unit_m",
                "one pose in first_pose.txt, and the unit in camera.txt");
  std::vector<RecordedFrame> frames;
  for (const std::filesystem::path& depth : pictures(folder / "depth"))
    frames.push_back({.view = poses[0], .camera = camera, .colour = {}, .depth = depth, .labels = {}});
  const Recording unposed(folder.string(), frames, *unit_m);
  const auto surface = [&](std::size_t i, const View& view) {
    return DepthSurface(unposed.frames()[i].camera, view, within(unposed.frame(i), range_m).depth, {.reach_px = 3});
  };
  const DepthSurface first = surface(0, poses[0]);
  double worst_m = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const auto aligned = align(surface(i, frames[i - 1].view), first, {.most_apart_m = 0.02, .huber_m = 0.001});
    if (!aligned)
      throw Error(folder.string(), concat("frame ", i, " does not align with the first"),
                  concat("surfaces that overlap within ", range_m, " m (--range)"));
    frames[i].view = aligned->view;
    worst_m = std::max(worst_m, aligned->rms_m);
  }
  return Recording(
      folder.string(), std::move(frames), *unit_m,
      {concat("Poses found by aligning each frame with the first; residuals of ", 1000 * worst_m, " mm at most.")});
}

}  // namespace scene
