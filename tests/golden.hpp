// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <vantage/core/bytes.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/npy.hpp>

#include "drawn_voxels.hpp"

#ifndef VANTAGE_GOLDEN_DIR
#define VANTAGE_GOLDEN_DIR ""
#endif

// The golden numbers: what published code computed. A README.md beside them says how, and what each file holds.
namespace vantage::test {

inline std::filesystem::path golden(const std::string& name) { return concat(VANTAGE_GOLDEN_DIR, "/", name); }

/// Tests by the numbers of one folder, skipped where they are missing, since they do not come with the sources.
class Golden : public testing::Test {
 protected:
  explicit Golden(std::string folder) : folder_(std::move(folder)) {}
  void SetUp() override {
    if (!folder_exists(golden(folder_)))
      GTEST_SKIP() << "VANTAGE_GOLDEN_DIR has no " << folder_ << " (now \"" << VANTAGE_GOLDEN_DIR << "\")";
  }

 private:
  std::string folder_;
};

// Files without a header, which read_csv() refuses. Their numbers may be infinite.

inline std::string text_of(const std::filesystem::path& file) { return read_file(file, 1 << 20); }
inline std::vector<double> numbers(std::string text) {
  std::ranges::replace(text, ',', ' ');
  std::istringstream cells(text);
  std::vector<double> all;
  for (std::string cell; cells >> cell;) all.push_back(std::stod(cell));
  return all;
}
/// Lines of a name and its numbers.
inline std::map<std::string, std::vector<double>> named_numbers(const std::string& text) {
  std::map<std::string, std::vector<double>> all;
  std::istringstream lines(text);
  for (std::string name, rest; std::getline(lines, name, ',') && std::getline(lines, rest);) all[name] = numbers(rest);
  return all;
}
/// Of 16 numbers each, row by row.
inline std::vector<View> poses(const std::vector<double>& matrices) {
  if (matrices.size() % 16 != 0) throw Error("poses", concat(matrices.size(), " numbers"), "16 each");
  std::vector<View> views(matrices.size() / 16);
  for (std::size_t i = 0; i < views.size(); ++i)
    views[i].T_W_C.matrix() = Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(&matrices[16 * i]);
  return views;
}

/// Columns `prefix`x, `prefix`y and `prefix`z of a row.
inline Eigen::Vector3d xyz(const CsvTable& t, const std::string& prefix, std::size_t row) {
  return {t.column(prefix + "x")[row], t.column(prefix + "y")[row], t.column(prefix + "z")[row]};
}

/// Tests in the toy room of chapter 6: what its voxel map holds after three frames, and what a planner makes of that.
struct ToyRoom : Golden {
  ToyRoom() : Golden("surfel/voxel") {}

  // What grid.csv says.
  static inline const Box3 box{Eigen::Vector3d(-0.1, -0.05, 0), Eigen::Vector3d(2.45, 2.05, 1.5)};
  static inline const VoxelGrid grid = VoxelGrid::dividing(box, 0.2);
  static constexpr Camera camera{64, 64, 55.42562584220408, 55.42562584220408, 32, 32};

  static std::filesystem::path file(const std::string& name) { return golden("surfel/voxel/" + name); }
  static std::vector<double> column(const std::string& table, const char* name) {
    const CsvTable t = read_csv(file(table));
    return {t.column(name).begin(), t.column(name).end()};
  }
  /// Tables of voxels are in the order of the published code, z first.
  static std::size_t row_of(const Eigen::Vector3i& voxel) {
    return static_cast<std::size_t>((voxel.x() * 11 + voxel.y()) * 8 + voxel.z());
  }
  static Eigen::Vector3i voxel_in(std::size_t row) {
    const auto i = static_cast<int>(row);
    return {i / 88, i / 8 % 11, i % 8};
  }

  /// Pixels out of range (-1) clear as far as the sensor sees, missing ones (-2) say nothing.
  static Frame frame(int k) {
    const auto depth = read_npy(file(concat("depth", k, ".npy"))).image<double>("depth");
    Frame f;
    f.camera = camera;
    f.view = poses(numbers(text_of(file(concat("pose", k, "_c2w.csv"))))).at(0);
    f.depth = (depth == -2).select(std::numeric_limits<float>::quiet_NaN(), depth.cast<float>());
    f.depth = (depth == -1).select(100.0F, f.depth);
    return f;
  }
  /// A map that has seen nothing.
  template <class Voxels>
  static Voxels unknown(double max_m) {
    typename Voxels::Config c;
    c.bounds = box;
    c.range.max_m = max_m;
    return Voxels(c);
  }
  /// The first frame was cleared to 1.95 m where it saw nothing, the others to 5 m.
  template <class Voxels>
  static Voxels after(int frames) {
    Voxels near = unknown<Voxels>(1.95), map = unknown<Voxels>(5);
    near.integrate(frame(0));
    Sink sink;
    near.save(sink);
    Source source(sink.bytes());
    map.load(source);
    for (int k = 1; k < frames; ++k) map.integrate(frame(k));
    return map;
  }

  /// What a planner is told of views when it needs no scores.
  static constexpr auto unscored = [](Views, Views, std::span<double>) {};
  static std::vector<View> candidates() { return poses(numbers(text_of(file("candidates_c2w.csv")))); }
  /// What the published code rendered from a candidate: depth 'D', 0 where there is nothing, or confidence 'K'.
  static Image<double> rendered(std::size_t candidate, char kind) {
    return read_npy(file(concat("cand", candidate, "_", kind, ".npy"))).image<double>("rendered");
  }
  static Image<float> rendered_depth(std::size_t candidate) {
    const Image<float> depth = rendered(candidate, 'D').cast<float>();
    return (depth > 0).select(depth, std::numeric_limits<float>::quiet_NaN());
  }
};

/// The published map of the toy room as its masks show it; all its regions as one kind.
class MaskedRoom : public DrawnVoxels {
 public:
  MaskedRoom() : DrawnVoxels(ToyRoom::grid, 0.3) {
    const CsvTable masks = read_csv(ToyRoom::file("masks.csv"));
    EXPECT_EQ(masks.rows(), grid().count());
    for (std::size_t i = 0; i < masks.rows(); ++i) {
      const auto mask = [&](const char* name) { return masks.column(name)[i] != 0; };
      const Eigen::Vector3i v = ToyRoom::voxel_in(i);
      if (mask("free")) draw(v, Space::free);
      if (mask("occ")) draw(v, Space::occupied);
      navigable_.push_back(mask("free_margin_ball0.3m"));
      if (mask("roi")) regions_.push_back({grid().centre(v), xyz(masks, "roi_n", i)});
    }
  }
  [[nodiscard]] std::vector<Region> regions(frontier) const { return regions_; }
  [[nodiscard]] bool navigable(const Eigen::Vector3i& v) const {
    return grid().contains(v) && navigable_[ToyRoom::row_of(v)];
  }
  [[nodiscard]] VoxelBits navigable_in(const Eigen::Vector3i& block) const {
    return where(block, [&](const Eigen::Vector3i& v) { return navigable(v); });
  }

 private:
  std::vector<bool> navigable_;
  std::vector<Region> regions_;
};

}  // namespace vantage::test
