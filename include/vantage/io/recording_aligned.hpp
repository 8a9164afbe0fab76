// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/geometry/alignment.hpp>
#include <vantage/geometry/depth_surface.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture_list.hpp>
#include <vantage/io/recording.hpp>
#include <vantage/io/recording_folder.hpp>
#include <vantage/io/word_lines.hpp>

// A plain folder (recording_folder.hpp) of depth whose poses nobody recorded, but the first: camera.txt, depth/ and,
// instead of poses.txt, first_pose.txt.
namespace vantage {

/// How poses are found that were not recorded. The defaults suit a thing of some decimetres, a few degrees between
/// frames.
struct AlignedRecordingConfig {
  double range_m = 10;  ///< depth beyond does not count, such as a room before which a thing turns; finite, > 0
  NormalsConfig normals = {.reach_px = 3};
  AlignmentConfig alignment = {.most_apart_m = 0.02, .huber_m = 0.001};
};

/// A recording whose poses were found, and how each but the first was.
struct AlignedRecording {
  Recording recording;
  std::vector<Alignment> alignments;  ///< of frame i + 1 with frame 0
};

/// Whether a folder holds such a recording: a first pose, and no others.
inline bool has_first_pose_only(const std::filesystem::path& folder) {
  return file_exists(folder / "first_pose.txt") && !file_exists(folder / "poses.txt");
}

/// Reads such a folder and finds its poses: aligns the surface that each frame saw within range with that of the first,
/// which it must overlap, beginning at the pose of the frame before. Throws Error naming the file (and line) that is
/// missing or wrong, or the frame that does not align. O(pixels) a frame and iteration; one frame at a time is in
/// memory besides the first.
inline AlignedRecording read_aligned_recording(const std::filesystem::path& folder,
                                               const AlignedRecordingConfig& config = {}) {
  Check check("AlignedRecordingConfig");
  check.positive("range_m", config.range_m);
  check.done();
  const std::filesystem::path camera_file = folder / "camera.txt", pose_file = folder / "first_pose.txt";
  const auto [camera, depth_unit_m] = parse_camera(read_file(camera_file, WordLimits{}.bytes), camera_file.string());
  const std::vector<View> poses = parse_poses(read_file(pose_file, WordLimits{}.bytes), pose_file.string());
  if (poses.size() != 1) throw Error(pose_file.string(), concat(poses.size(), " poses"), "one, of the first frame");
  if (!depth_unit_m) throw Error(camera_file.string(), "no value of depth_unit_m", "for depth/ [m]");

  std::vector<RecordedFrame> frames;
  for (const std::filesystem::path& depth : pictures(folder / "depth"))
    frames.push_back({.view = poses[0], .camera = camera, .colour = {}, .depth = depth, .labels = {}});
  const Recording unposed(folder.string(), frames, *depth_unit_m);
  const auto surface = [&](std::size_t i, const View& view) {
    Frame frame = within(unposed.frame(i), config.range_m);
    return DepthSurface(frame.camera, view, std::move(frame.depth), config.normals);
  };
  const DepthSurface first = surface(0, frames[0].view);
  std::vector<Alignment> alignments;
  double worst_m = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    const std::optional<Alignment> aligned = align(surface(i, frames[i - 1].view), first, config.alignment);
    if (!aligned)
      throw Error(concat(folder.string(), " (frame ", i, ")"), "it does not align with the first frame",
                  concat("surfaces that overlap within a range of ", config.range_m, " m"));
    frames[i].view = aligned->view;
    worst_m = std::max(worst_m, aligned->rms_m);
    alignments.push_back(*aligned);
  }
  const std::string note =
      concat("Poses found by aligning each frame with the first; residuals of ", 1000 * worst_m, " mm at most.");
  return {Recording(folder.string(), std::move(frames), *depth_unit_m, {note}), std::move(alignments)};
}

}  // namespace vantage
