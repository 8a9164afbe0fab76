// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Low-confidence voxels and their normals in the toy room of the voxel map's golden numbers, exactly (normals to 1e-6).
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>

#include <Eigen/Core>

#include <vantage/core/bytes.hpp>
#include <vantage/core/units.hpp>
#include <vantage/io/csv.hpp>
#include <vantage/io/npy.hpp>
#include <vantage/maps/surfel/low_confidence.hpp>
#include <vantage/maps/voxel/voxel_map.hpp>

#ifndef VANTAGE_GOLDEN_DIR
#define VANTAGE_GOLDEN_DIR ""
#endif

namespace vantage {
namespace {

using Voxels = VoxelMap<Projective, NoClasses, NoOccupiedCentreInBall>;

std::filesystem::path golden(const std::string& file) {
  return std::filesystem::path(VANTAGE_GOLDEN_DIR) / "surfel" / "voxel" / file;
}

class GoldenRegions : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(VANTAGE_GOLDEN_DIR).empty() || !std::filesystem::exists(golden("lowconf_surfels.csv")))
      GTEST_SKIP() << "VANTAGE_GOLDEN_DIR has no surfel/voxel/ (now \"" << VANTAGE_GOLDEN_DIR << "\")";
  }
};

Voxels empty(double max_m) {
  Voxels::Config c;
  c.bounds = {Eigen::Vector3d(-0.1, -0.05, 0), Eigen::Vector3d(2.45, 2.05, 1.5)};
  c.range.max_m = max_m;
  return Voxels(c);
}
Frame frame(int k) {
  Frame f;
  f.camera = Camera::from_fov(64, 64, deg(60));
  std::ifstream file(golden(concat("pose", k, "_c2w.csv")));
  const CsvTable pose = parse_csv("x,y,z,t\n" + std::string(std::istreambuf_iterator<char>(file), {}));
  for (Eigen::Index r = 0; r < 4; ++r)
    for (Eigen::Index c = 0; c < 4; ++c)
      f.view.T_W_C.matrix()(r, c) = pose.column(static_cast<std::size_t>(c))[static_cast<std::size_t>(r)];
  const auto depth = read_npy(golden(concat("depth", k, ".npy"))).values<double>("depth");
  f.depth.resize(64, 64);
  for (std::size_t i = 0; i < depth.size(); ++i)
    f.depth.data()[i] = depth[i] == -1   ? 100.0F
                        : depth[i] == -2 ? std::numeric_limits<float>::quiet_NaN()
                                         : static_cast<float>(depth[i]);
  return f;
}
Voxels after_three_frames() {
  Voxels near = empty(1.95), map = empty(5);
  near.integrate(frame(0));
  Sink sink;
  near.save(sink);
  Source source(sink.bytes());
  map.load(source);
  map.integrate(frame(1));
  map.integrate(frame(2));
  return map;
}
Surfels surfels() {
  const CsvTable t = read_csv(golden("lowconf_surfels.csv"));
  const auto number = [&](const char* column, std::size_t row) { return static_cast<float>(t.column(column)[row]); };
  Surfels s;
  for (std::size_t i = 0; i < t.rows(); ++i) {
    const auto q = quaternion_towards<float>(Eigen::Vector3f(number("nx", i), number("ny", i), number("nz", i)));
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
  const Voxels voxels = after_three_frames();
  const CsvTable masks = read_csv(golden("masks.csv"));
  std::set<std::size_t> expected, found;  // rows of the table
  for (std::size_t row = 0; row < masks.rows(); ++row)
    if (masks.column("lowconf")[row] == 1 && masks.column("roi")[row] == 1) expected.insert(row);
  for (const Region& region : low_confidence_regions(surfels(), voxels, {.more_than = 2})) {
    const Eigen::Vector3i v = voxels.grid().voxel_at(region.centre);
    const auto row = static_cast<std::size_t>((v.x() * 11 + v.y()) * 8 + v.z());
    found.insert(row);
    const Eigen::Vector3d normal(masks.column("roi_nx")[row], masks.column("roi_ny")[row], masks.column("roi_nz")[row]);
    EXPECT_LT((region.normal - normal).norm(), 1e-6) << v.transpose();
  }
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 3U);
}

}  // namespace
}  // namespace vantage
