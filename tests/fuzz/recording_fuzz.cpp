// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Hostile texts of recordings; the first byte says which. Either what was read is sane, or vantage::Error says why.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include <vantage/io/recording_colmap.hpp>
#include <vantage/io/recording_folder.hpp>
#include <vantage/io/recording_replica.hpp>
#include <vantage/io/recording_transforms.hpp>
#include <vantage/io/recording_tum.hpp>

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}
void require_rigid(const vantage::View& view) {
  try {
    vantage::check_view(view, "what was read");
  } catch (const vantage::Error&) { std::abort(); }
}

template <class T>
void require_in_order(const std::vector<vantage::Timed<T>>& items) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    require(std::isfinite(items[i].time_s) && (i == 0 || items[i - 1].time_s <= items[i].time_s));
    const auto* nearest = vantage::nearest_in_time(items, items[i].time_s, 0);
    require(nearest != nullptr && nearest->time_s == items[i].time_s);
  }
}

void transforms(std::string_view text) {
  const vantage::Transforms read = vantage::parse_transforms(text, "text");
  require(read.depth_unit_m > 0);
  for (const vantage::TransformsFrame& f : read.frames) {
    require_rigid(f.view);
    const vantage::Camera camera = f.camera(4, 3);
    require(camera.width >= 1 && camera.height >= 1 && camera.fx > 0);
  }
}

void read(char kind, std::string_view text) {
  switch (kind) {
    case 't':
      return require_in_order(vantage::parse_tum_list(text, "text"));
    case 'g': {
      const auto poses = vantage::parse_tum_trajectory(text, "text");
      for (const auto& pose : poses) require_rigid(pose.value);
      return require_in_order(poses);
    }
    case 'k':
      return vantage::parse_tum_calibration(text, "text", 4, 3).validate();
    case 'c':
      for (const auto& [id, camera] : vantage::parse_colmap_cameras(text, "text")) camera.validate();
      return;
    case 'i':
      for (const auto& image : vantage::parse_colmap_images(text, "text")) require_rigid(image.view);
      return;
    case 'f':
      return vantage::parse_camera(text, "text").first.validate();
    case 'r': {
      const auto [camera, depth_unit_m] = vantage::parse_replica_camera(text, "text");
      require(std::isfinite(depth_unit_m) && depth_unit_m > 0);
      return camera.validate();
    }
    case 'p':
      for (const auto& view : vantage::parse_poses(text, "text")) require_rigid(view);
      return;
    default:
      return transforms(text);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  try {
    read(static_cast<char>(data[0]), std::string_view(reinterpret_cast<const char*>(data) + 1, size - 1));
  } catch (const vantage::Error& e) { require(*e.what() != '\0'); }
  return 0;
}
