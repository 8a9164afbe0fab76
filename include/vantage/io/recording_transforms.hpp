// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/frame_pictures.hpp>
#include <vantage/io/json.hpp>
#include <vantage/io/recording.hpp>

// Recordings as a transforms.json: nerfstudio's, and the synthetic scenes of Mildenhall et al. ("NeRF: Representing
// scenes as neural radiance fields for view synthesis", ECCV 2020). Camera x right, y up, z backward (OpenGL); z of the
// world is up. Intrinsics of all frames or of each: fl_x fl_y cx cy w h, or camera_angle_x alone.
namespace vantage {

/// What a transforms.json tells of one frame; a size of 0 is not told, nor are intrinsics that depend on it.
struct TransformsFrame {
  View view;
  std::string colour, depth;  ///< names relative to the file's folder; depth may be empty
  int width = 0, height = 0;  ///< [px]
  std::optional<double> fx, fy, cx, cy, angle_x_rad;

  /// The camera of a picture of this size, as far as the file did not tell it; fx or angle_x_rad must be told.
  [[nodiscard]] Camera camera(int picture_width, int picture_height) const {
    const int w = width ? width : picture_width, h = height ? height : picture_height;
    const double f = fx ? *fx : 0.5 * w / std::tan(0.5 * *angle_x_rad);
    return {w, h, f, fy.value_or(f), cx.value_or(0.5 * w), cy.value_or(0.5 * h)};
  }
};

struct Transforms {
  std::vector<TransformsFrame> frames;
  double depth_unit_m = 0.001;  ///< what 1 means in a depth picture: millimetres, unless instant-ngp's scale is told
};

namespace detail {

/// Takes over what an object, the whole file's or a frame's, tells of the camera.
inline void take_intrinsics(const JsonItem& json, TransformsFrame& frame) {
  constexpr double tiny = std::numeric_limits<double>::min(), most = std::numeric_limits<double>::max();
  for (const char* name : {"k1", "k2", "k3", "k4", "p1", "p2"})
    if (const auto k = json.find(name); k && k->number() != 0)
      k->refuse(concat("a distortion of ", k->number()), "0: undistorted pictures");
  if (const auto model = json.find("camera_model")) {
    const std::string& name = model->text();
    if (name != "PINHOLE" && name != "SIMPLE_PINHOLE" && name != "OPENCV")
      model->refuse(concat("'", printable(name), "'"), "PINHOLE, SIMPLE_PINHOLE, or OPENCV without distortion");
  }
  const auto take = [&](const char* name, auto& to, double low, double high) {
    if (const auto value = json.find(name)) to = value->number(low, high);
  };
  take("fl_x", frame.fx, tiny, most);
  take("fl_y", frame.fy, tiny, most);
  take("cx", frame.cx, -most, most);
  take("cy", frame.cy, -most, most);
  take("camera_angle_x", frame.angle_x_rad, tiny, 3.14);
  for (const auto& [name, to] : {std::pair{"w", &frame.width}, std::pair{"h", &frame.height}})
    if (const auto value = json.find(name)) *to = static_cast<int>(value->count(1 << 16));
}

inline View take_view(const JsonItem& json, const std::string& where) {
  Eigen::Matrix4d T;
  if (json.size() != 4) json.refuse(concat(json.size(), " rows"), "4 rows of 4 numbers: camera to world");
  for (Eigen::Index row = 0; row < 4; ++row) T.row(row) = json.at(static_cast<std::size_t>(row)).vector<4>();
  T.middleCols<2>(1) *= -1;  // y up, z backward -> y down, z forward
  return rigid_view(T, where);
}

}  // namespace detail

/// The text of a transforms.json. Throws Error naming the place.
inline Transforms parse_transforms(std::string_view text, const std::string& where) {
  const nlohmann::json parsed = parse_json(text, where);
  const JsonItem json(parsed, where);
  Transforms out;
  if (const auto unit = json.find("integer_depth_scale")) out.depth_unit_m = unit->number(1e-12, 1e12);
  TransformsFrame common;
  detail::take_intrinsics(json, common);
  json.at("frames").each([&](const JsonItem& item) {
    TransformsFrame& frame = out.frames.emplace_back(common);
    detail::take_intrinsics(item, frame);
    frame.colour = item.at("file_path").text();
    for (const char* name : {"depth_file_path", "depth_path"})
      if (const auto depth = item.find(name); depth && frame.depth.empty()) frame.depth = depth->text();
    if (!frame.fx && !frame.angle_x_rad)
      item.refuse("no focal length", "fl_x or camera_angle_x, of the frame or of all");
    frame.view = detail::take_view(item.at("transform_matrix"), concat(where, " (frame ", out.frames.size() - 1, ")"));
  });
  return out;
}

/// Reads a transforms.json. A picture whose name has no extension is a PNG, as in NeRF's scenes. Throws Error naming
/// the file, and the place in it.
inline Recording read_transforms_recording(const std::filesystem::path& file) {
  const Transforms listed = parse_transforms(read_file(file, JsonLimits{}.bytes), file.string());
  const std::filesystem::path folder = file.parent_path();
  std::vector<RecordedFrame> frames;
  std::pair<int, int> size = {0, 0};  // of the first picture whose size the file does not tell
  for (const TransformsFrame& f : listed.frames) {
    std::filesystem::path colour = folder / f.colour;
    if (!colour.has_extension()) colour += ".png";
    if ((f.width == 0 || f.height == 0) && size.first == 0) size = picture_size(colour);
    const std::filesystem::path depth = f.depth.empty() ? std::filesystem::path() : folder / f.depth;
    frames.push_back(
        {.view = f.view, .camera = f.camera(size.first, size.second), .colour = colour, .depth = depth, .labels = {}});
  }
  return {file.string(), std::move(frames), listed.depth_unit_m};
}

}  // namespace vantage
