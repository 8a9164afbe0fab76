// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <vantage/geometry/frame.hpp>
#include <vantage/io/colour_map.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/io/png.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/mission/command_line.hpp>
#include <vantage/mission/palette.hpp>

namespace scene {

using namespace vantage;

/// The colour of a class: neighbours in number are far apart in hue; what has no class is grey.
inline Rgb colour_of_class(std::uint16_t label) {
  if (label == 0) return {128, 128, 128};
  const double hue = 2 * std::numbers::pi * std::fmod(0.61803398875 * label, 1.0), chroma = 0.12;
  return vantage::detail::srgb({label % 2 == 0 ? 0.62 : 0.78, chroma * std::cos(hue), chroma * std::sin(hue)});
}

/// Colour, depth and labels side by side, `width` px each; a channel that the sensor lacks is left out.
inline Picture strip(const Frame& frame, double range_m, int width = 300) {
  const int height = std::max(1, width * frame.camera.height / frame.camera.width);
  const bool has[] = {!frame.colour.empty(), frame.depth.size() != 0, frame.labels.size() != 0};
  Picture out(width * (has[0] + has[1] + has[2]), height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Eigen::Index row = (2 * y + 1) * frame.camera.height / (2 * height),
                         column = (2 * x + 1) * frame.camera.width / (2 * width);
      int panel = 0;
      const auto put = [&](const Rgb& c) { out(y, x + width * panel++) = c; };
      if (has[0])
        put({to_byte(frame.colour.r(row, column)), to_byte(frame.colour.g(row, column)),
             to_byte(frame.colour.b(row, column))});
      if (has[1]) put(viridis(static_cast<double>(frame.depth(row, column)) / range_m));
      if (has[2]) put(colour_of_class(frame.labels(row, column)));
    }
  return out;
}

/// Observer that writes what the camera saw, as a recording which can be replayed: colour/, depth/, labels/, poses.txt
/// and camera.txt, and the names of the classes in classes.txt, a number and a name a line; no folder, no files. Depth
/// in quarter millimetres, or coarser if it goes beyond 16 m. Keeps strips of colour, depth and labels in memory, of
/// every k-th frame, so that there are `most_strips` at most.
class Album {
 public:
  Album(std::filesystem::path folder, double range_m, std::vector<std::string> classes = {},
        std::size_t most_strips = 12)
      : folder_(std::move(folder)),
        classes_(std::move(classes)),
        range_m_(range_m),
        depth_unit_m_(std::max(0.00025, range_m / 65000)),
        most_(most_strips) {}

  template <class M, class Z>
  void measured(const M&, const Situation&, const Step<Z>& step) {
    saw(step.index, step.measurement);
  }
  void saw(std::uint64_t index, const Frame& f) {
    if (!folder_.empty()) write(index, f);
    if ((index - 1) % every_ != 0) return;
    if (strips_.size() == most_) {  // too many: from now on every other one
      every_ *= 2;
      for (std::size_t i = 1; 2 * i < strips_.size(); ++i) strips_[i] = std::move(strips_[2 * i]);
      strips_.erase(strips_.begin() + static_cast<std::ptrdiff_t>((strips_.size() + 1) / 2), strips_.end());
      if ((index - 1) % every_ != 0) return;
    }
    strips_.push_back({index, f.view, f.camera, strip(f, range_m_)});
  }

  struct Strip {
    std::uint64_t index;
    View view;
    Camera camera;
    Picture picture;
  };
  [[nodiscard]] const std::vector<Strip>& strips() const { return strips_; }

 private:
  void write(std::uint64_t index, const Frame& f) {
    char name[32];
    std::snprintf(name, sizeof name, "%04u.png", static_cast<unsigned>(index));
    if (poses_.empty()) {
      for (const char* kind : {"colour", "depth", "labels"})
        std::filesystem::remove_all(folder_ / kind);  // of an earlier mission
      std::filesystem::remove(folder_ / "classes.txt");
      const Camera& c = f.camera;
      make_folder(folder_);
      write_file(folder_ / "camera.txt", concat("width ", c.width, "\nheight ", c.height, "\nfx ", c.fx, "\nfy ", c.fy,
                                                "\ncx ", c.cx, "\ncy ", c.cy, "\ndepth_unit_m ", depth_unit_m_, "\n"));
      std::string names;
      for (std::size_t i = 0; i < classes_.size(); ++i) names += concat(i, ' ', classes_[i], '\n');
      if (!names.empty()) write_file(folder_ / "classes.txt", names);
    }
    const auto file = [&](const char* kind) {
      make_folder(folder_ / kind);
      return folder_ / kind / name;
    };
    if (!f.colour.empty()) write_png(file("colour"), to_picture(f.colour));
    if (f.depth.size() != 0) write_png(file("depth"), depth_to_steps(f.depth, depth_unit_m_));
    if (f.labels.size() != 0) write_png(file("labels"), f.labels);
    char number[32];
    for (Eigen::Index row = 0; row < 4; ++row)
      for (Eigen::Index column = 0; column < 4; ++column) {
        std::snprintf(number, sizeof number, "%.17g", f.view.T_W_C.matrix()(row, column));
        poses_ += concat(number, row == 3 && column == 3 ? "\n" : " ");
      }
    write_file(folder_ / "poses.txt", poses_);
  }
  std::filesystem::path folder_;
  std::vector<std::string> classes_;
  double range_m_, depth_unit_m_;
  std::size_t most_, every_ = 1;
  std::string poses_;
  std::vector<Strip> strips_;
};

}  // namespace scene
