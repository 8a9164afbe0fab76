// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/printable.hpp>
#include <vantage/io/recording.hpp>
#include <vantage/io/word_lines.hpp>

// COLMAP's sparse models as text (Schoenberger and Frahm, "Structure-from-motion revisited", CVPR 2016): cameras.txt
// and images.txt. Its camera axes and pixel centres are ours; its world has an arbitrary scale and direction of up.
namespace vantage {

/// The pinhole cameras of a cameras.txt ("ID MODEL WIDTH HEIGHT PARAMETERS..." a line). Throws Error naming the line,
/// also for a model with distortion.
inline std::map<long, Camera> parse_colmap_cameras(std::string_view text, const std::string& where) {
  constexpr long most = 1L << 32;
  std::map<long, Camera> out;
  for (WordLines lines(text, where); lines.next();) {
    const long id = lines.integer(0, 0, most);
    const std::string_view model = lines.word(1);
    const bool simple = model == "SIMPLE_PINHOLE";
    if (!simple && model != "PINHOLE")
      lines.refuse(concat("camera model '", printable(model), "'"),
                   "PINHOLE or SIMPLE_PINHOLE (COLMAP's image_undistorter makes such pictures)");
    const std::size_t words = simple ? 7 : 8;
    if (lines.size() != words) lines.refuse(concat(lines.size(), " words"), concat(words, " for ", model));
    const std::size_t at = simple ? 4 : 5;  // the last focal length
    const Camera camera{static_cast<int>(lines.integer(2, 1, 1 << 16)),
                        static_cast<int>(lines.integer(3, 1, 1 << 16)),
                        lines.number(4),
                        lines.number(at),
                        lines.number(at + 1),
                        lines.number(at + 2)};
    camera.validate(lines.where());
    if (!out.emplace(id, camera).second) lines.refuse(concat("a second camera ", id), "one line a camera");
  }
  return out;
}

/// An image that COLMAP has placed.
struct ColmapImage {
  View view;
  long camera;
  std::string name;
};

/// The images of an images.txt: two lines each, "ID QW QX QY QZ TX TY TZ CAMERA_ID NAME" (world to camera) and the
/// image's points, which are not read. In the order of names. Throws Error naming the line.
inline std::vector<ColmapImage> parse_colmap_images(std::string_view text, const std::string& where) {
  std::vector<ColmapImage> out;
  for (WordLines lines(text, where, {.bytes = std::size_t{1} << 30}); lines.next(); lines.skip()) {
    const auto n = [&](std::size_t i) { return lines.number(i); };
    const Eigen::Isometry3d T_C_W =
        rigid_transform(Eigen::Quaterniond(n(1), n(2), n(3), n(4)), {n(5), n(6), n(7)}, lines.where());
    out.push_back({{T_C_W.inverse()}, lines.integer(8, 0, 1L << 32), std::string(lines.rest(9))});
  }
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return out;
}

/// Reads a COLMAP text model; `model` holds cameras.txt and images.txt, `images` the pictures. Throws Error naming the
/// file (and line) that is missing or wrong.
inline Recording read_colmap_recording(const std::filesystem::path& model, const std::filesystem::path& images) {
  if (!file_exists(model / "cameras.txt") && file_exists(model / "cameras.bin"))
    throw Error(model.string(), "this COLMAP model is binary",
                "text: colmap model_converter --input_path DIR --output_path DIR --output_type TXT");
  const std::filesystem::path cameras_file = model / "cameras.txt", images_file = model / "images.txt";
  const auto cameras = parse_colmap_cameras(read_file(cameras_file, WordLimits{}.bytes), cameras_file.string());
  std::vector<RecordedFrame> frames;
  for (const ColmapImage& image :
       parse_colmap_images(read_file(images_file, std::size_t{1} << 30), images_file.string())) {
    const auto camera = cameras.find(image.camera);
    if (camera == cameras.end())
      throw Error(images_file.string(), concat("camera ", image.camera, " of ", printable(image.name)),
                  "one of cameras.txt");
    frames.push_back(
        {.view = image.view, .camera = camera->second, .colour = images / image.name, .depth = {}, .labels = {}});
  }
  return {model.string(), std::move(frames)};
}

}  // namespace vantage
