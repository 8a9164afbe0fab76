// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Low-confidence voxels and their normals in the toy room of the voxel map's golden numbers, exactly (normals to 1e-6).
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <set>

#include <Eigen/Core>

#include <vantage/io/csv.hpp>
#include <vantage/maps/surfel/low_confidence.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

#include "golden.hpp"

namespace vantage {
namespace {

using Voxels = VoxelMap<Projective, NoClasses, NoOccupiedCentreInBall>;
using GoldenRegions = test::ToyRoom;

Surfels surfels() {
  const CsvTable t = read_csv(GoldenRegions::file("lowconf_surfels.csv"));
  const auto number = [&](const char* column, std::size_t row) { return static_cast<float>(t.column(column)[row]); };
  Surfels s;
  for (std::size_t i = 0; i < t.rows(); ++i) {
    const auto q = quaternion_towards<float>(test::xyz(t, "n", i).cast<float>());
    const double opacity = t.column("opacity")[i];
    Surfel one;
    one.parameter = {number("x", i), number("y", i), number("z", i), q[0], q[1], q[2], q[3]};
    one.parameter[surfel::logit] = static_cast<float>(std::log(opacity / (1 - opacity)));
    one.confidence = number("confidence", i);
    s.push_back(one);
  }
  return s;
}

TEST_F(GoldenRegions, LowConfidenceVoxelsAndTheirNormals) {
  const auto voxels = after<Voxels>(3);
  const CsvTable masks = read_csv(file("masks.csv"));
  std::set<std::size_t> expected, found;  // rows of the table
  for (std::size_t row = 0; row < masks.rows(); ++row)
    if (masks.column("lowconf")[row] == 1 && masks.column("roi")[row] == 1) expected.insert(row);
  for (const Region& region : low_confidence_regions(surfels(), voxels, {.more_than = 2})) {
    const Eigen::Vector3i v = voxels.grid().voxel_at(region.centre);
    const std::size_t row = row_of(v);
    found.insert(row);
    EXPECT_LT((region.normal - test::xyz(masks, "roi_n", row)).norm(), 1e-6) << v.transpose();
  }
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 3U);
}

}  // namespace
}  // namespace vantage
