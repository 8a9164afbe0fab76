// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Views of regions of interest (ch. 6) against those of the published code, from its own masks: which positions each
// region is looked at from, in which direction. Tolerance: 1e-14 in a direction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <vantage/io/csv.hpp>
#include <vantage/sampler/roi_and_local.hpp>

#include "golden.hpp"

namespace vantage {
namespace {

using GoldenRegionViews = test::ToyRoom;

/// Directions by the rows of the voxels of region and position.
std::map<std::pair<std::size_t, std::size_t>, Eigen::Vector3d> published() {
  const CsvTable t = read_csv(GoldenRegionViews::file("roi_cone_candidates.csv"));
  std::map<std::pair<std::size_t, std::size_t>, Eigen::Vector3d> all;
  for (std::size_t i = 0; i < t.rows(); ++i) {
    const auto number = [&](const char* name) { return static_cast<std::size_t>(t.column(name)[i]); };
    all[{number("roi_voxel"), number("free_voxel")}] = test::xyz(t, "dir_", i);
  }
  return all;
}

TEST_F(GoldenRegionViews, OnThePublishedGrid) {
  const auto rows = test::named_numbers(test::text_of(file("grid.csv")));
  const auto row = [&](const char* name) { return Eigen::Vector3d(rows.at(name).data()); };
  EXPECT_EQ(grid, VoxelGrid::dividing({row("bbox_min"), row("bbox_max")}, 0.2));
  EXPECT_EQ(grid.size(), row("dim").cast<int>());
  EXPECT_TRUE(grid.voxel_m().isApprox(row("size"), 1e-12));
}

TEST_F(GoldenRegionViews, TheSamePositionsInEachCone) {
  const test::MaskedRoom map;
  const auto theirs = published();
  std::size_t ours = 0;
  for (const Region& region : map.regions(frontier{}))
    for_each_in_cone(map, region, ViewCone{}, [&](const Eigen::Vector3i& v) {
      EXPECT_TRUE(theirs.contains({row_of(grid.voxel_at(region.centre)), row_of(v)}));
      ++ours;
    });
  EXPECT_GT(ours, 0u);
  EXPECT_EQ(ours, theirs.size());
}

TEST_F(GoldenRegionViews, WhatIsProposedIsAmongThem) {
  const test::MaskedRoom map;
  const auto theirs = published();
  const std::vector<Region> regions = map.regions(frontier{});
  const View here = look_at(grid.centre(voxel_in(283)), map.bounds().center());  // where the published one is
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Rng rng(seed);
    const std::vector<View> views = RoiAndLocal<frontier>{}.sample(map, {.here = here}, Score(unscored), rng).views;
    ASSERT_EQ(views.size(), 100u);
    for (std::size_t k = 0; k < 30; ++k) {
      const std::size_t from = row_of(grid.voxel_at(views[k].position()));
      double nearest = 2;
      for (const Region& region : regions)
        if (const auto row = theirs.find({row_of(grid.voxel_at(region.centre)), from}); row != theirs.end())
          nearest = std::min(nearest, (row->second - views[k].forward()).norm());
      EXPECT_LT(nearest, 1e-14) << "seed " << seed << ", view " << k;
    }
  }
}

}  // namespace
}  // namespace vantage
