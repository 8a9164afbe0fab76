// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Views of regions of interest (ch. 6) against those of the published code, from its own masks: which positions each
// region is looked at from, in which direction. Tolerance: 1e-14 in a direction.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <vantage/io/csv.hpp>
#include <vantage/sampler/roi_and_local.hpp>

#include "drawn_voxels.hpp"

#ifndef VANTAGE_GOLDEN_DIR
#define VANTAGE_GOLDEN_DIR ""
#endif

namespace vantage {
namespace {

std::filesystem::path golden(const std::string& file) {
  return std::filesystem::path(VANTAGE_GOLDEN_DIR) / "surfel" / "voxel" / file;
}

/// The published map of a toy room as its masks show it; all its regions as one kind.
class GoldenMap : public test::DrawnVoxels {
 public:
  GoldenMap(const VoxelGrid& grid, const CsvTable& masks) : DrawnVoxels(grid, 0.3), navigable_(grid.count()) {
    for (std::size_t i = 0; i < grid.count(); ++i) {
      const auto mask = [&](const char* name) { return masks.column(name)[i]; };
      const Eigen::Vector3i v = voxel(i);
      if (mask("free") != 0) draw(v, Space::free);
      if (mask("occ") != 0) draw(v, Space::occupied);
      navigable_[i] = mask("free_margin_ball0.3m") != 0;
      if (mask("roi") == 0) continue;
      index_.push_back(i);
      regions_.push_back({grid.centre(v), {mask("roi_nx"), mask("roi_ny"), mask("roi_nz")}});
    }
  }
  [[nodiscard]] std::vector<Region> regions(frontier) const { return regions_; }
  [[nodiscard]] bool navigable(const Eigen::Vector3i& v) const { return grid().contains(v) && navigable_[index(v)]; }
  [[nodiscard]] VoxelBits navigable_in(const Eigen::Vector3i& block) const {
    VoxelBits bits;
    VoxelBits::inside(grid(), block).for_each([&](std::size_t local) {
      if (navigable(voxel_of(block, local))) bits.set(local);
    });
    return bits;
  }
  /// Voxels are numbered z first in the published code.
  [[nodiscard]] std::size_t index(const Eigen::Vector3i& v) const {
    return static_cast<std::size_t>((v.x() * grid().size().y() + v.y()) * grid().size().z() + v.z());
  }
  [[nodiscard]] Eigen::Vector3i voxel(std::size_t i) const {
    const auto n = static_cast<int>(i), ny = grid().size().y(), nz = grid().size().z();
    return {n / (ny * nz), n / nz % ny, n % nz};
  }
  /// The number of the voxel of a region.
  [[nodiscard]] std::size_t voxel_of_region(std::size_t region) const { return index_[region]; }

 private:
  std::vector<bool> navigable_;
  std::vector<std::size_t> index_;
  std::vector<Region> regions_;
};

class GoldenRegionViews : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(VANTAGE_GOLDEN_DIR).empty() || !std::filesystem::exists(golden("masks.csv")))
      GTEST_SKIP() << "VANTAGE_GOLDEN_DIR has no surfel/voxel (now \"" << VANTAGE_GOLDEN_DIR << "\")";
    const CsvTable rows = read_csv(golden("roi_cone_candidates.csv"));
    for (std::size_t i = 0; i < rows.rows(); ++i) {
      const auto number = [&](const char* name) { return static_cast<std::size_t>(rows.column(name)[i]); };
      theirs[{number("roi_voxel"), number("free_voxel")}] = {rows.column("dir_x")[i], rows.column("dir_y")[i],
                                                             rows.column("dir_z")[i]};
    }
  }
  static GoldenMap make_map() {
    // The rows of grid.csv have a name and so many numbers each.
    std::map<std::string, std::vector<double>> rows;
    std::ifstream file(golden("grid.csv"));
    for (std::string line; std::getline(file, line);) {
      std::istringstream cells(line);
      std::string name;
      std::getline(cells, name, ',');
      for (std::string cell; std::getline(cells, cell, ',');) rows[name].push_back(std::stod(cell));
    }
    const auto row = [&](const char* name) { return Eigen::Vector3d(rows.at(name).data()); };
    const VoxelGrid grid = VoxelGrid::dividing({row("bbox_min"), row("bbox_max")}, 0.2);
    EXPECT_EQ(grid.size(), row("dim").cast<int>());
    EXPECT_TRUE(grid.voxel_m().isApprox(row("size"), 1e-12));
    return {grid, read_csv(golden("masks.csv"))};
  }
  std::map<std::pair<std::size_t, std::size_t>, Eigen::Vector3d>
      theirs;  ///< direction by voxels of region and position
};

TEST_F(GoldenRegionViews, TheSamePositionsInEachCone) {
  const GoldenMap map = make_map();
  std::size_t ours = 0;
  for (std::size_t i = 0; i < map.regions(frontier{}).size(); ++i)
    for_each_in_cone(map, map.regions(frontier{})[i], ViewCone{}, [&](const Eigen::Vector3i& v) {
      EXPECT_TRUE(theirs.contains({map.voxel_of_region(i), map.index(v)}));
      ++ours;
    });
  EXPECT_GT(ours, 0u);
  EXPECT_EQ(ours, theirs.size());
}

TEST_F(GoldenRegionViews, WhatIsProposedIsAmongThem) {
  const GoldenMap map = make_map();
  const std::vector<Region> regions = map.regions(frontier{});
  const auto scorer = [](Views, Views, std::span<double>) {};
  const View here = look_at(map.grid().centre(map.voxel(283)), map.bounds().center());  // where the published one is
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    const std::vector<View> views = RoiAndLocal<frontier>{}.sample(map, {.here = here}, Score(scorer), rng).views;
    ASSERT_EQ(views.size(), 100u);
    for (std::size_t k = 0; k < 30; ++k) {
      const std::size_t from = map.index(map.grid().voxel_at(views[k].position()));
      double nearest = 2;
      for (std::size_t i = 0; i < regions.size(); ++i)
        if (const auto row = theirs.find({map.voxel_of_region(i), from}); row != theirs.end())
          nearest = std::min(nearest, (row->second - views[k].forward()).norm());
      EXPECT_LT(nearest, 1e-14) << "seed " << seed << ", view " << k;
    }
  }
}

}  // namespace
}  // namespace vantage
