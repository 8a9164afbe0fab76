// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Real and rendered recordings, as the project's script makes them of what was recorded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <temporary_folder.hpp>

#include <vantage/core/units.hpp>
#include <vantage/geometry/alignment.hpp>
#include <vantage/io/recording_any.hpp>
#include <vantage/sim/replay_world.hpp>

#ifndef VANTAGE_DATA_DIR
#define VANTAGE_DATA_DIR ""
#endif

namespace vantage {
namespace {

namespace fs = std::filesystem;

class Castle : public testing::Test {
 protected:
  void SetUp() override {
    const fs::path archives = fs::path(VANTAGE_DATA_DIR) / "sequences";
    if (std::string(VANTAGE_DATA_DIR).empty() || !fs::exists(archives))
      GTEST_SKIP() << "VANTAGE_DATA_DIR has no sequences";
    const fs::path project = fs::absolute(__FILE__).parent_path() / ".." / ".." / "..";
    const std::string command = "python3 '" + (project / "examples" / "data" / "fetch_sequences").string() +
                                "' --archives '" + archives.string() + "' --out '" + folder.path().string() + "' " +
                                name() + " > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    root = folder.path() / name();
  }
  [[nodiscard]] virtual std::string name() const = 0;
  const test::TemporaryFolder folder;
  fs::path root;
};

double turn_between_rad(const View& a, const View& b) {
  return Eigen::AngleAxisd(a.T_W_C.linear().transpose() * b.T_W_C.linear()).angle();
}

class SimulatedCastle : public Castle {
  [[nodiscard]] std::string name() const override { return "castle_simulated"; }
};

// Where two frames see the same surface, their depths agree: unit, intrinsics, axes and poses are right together.
TEST_F(SimulatedCastle, FramesAgreeWithEachOther) {
  const Recording r = read_recording(root);
  ASSERT_EQ(r.size(), 40U);
  for (const auto& [i, j] : {std::pair<std::size_t, std::size_t>{0, 9}, {9, 19}, {19, 39}, {4, 34}}) {
    const Frame a = r.frame(i), b = r.frame(j);
    a.validate("frame");
    const Eigen::Isometry3d T = b.view.T_W_C.inverse() * a.view.T_W_C;
    std::vector<double> difference_m;
    for (Eigen::Index row = 0; row < a.depth.rows(); ++row)
      for (Eigen::Index column = 0; column < a.depth.cols(); ++column) {
        if (std::isnan(a.depth(row, column))) continue;
        const Eigen::Vector3d ray = a.camera.ray(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        const Eigen::Vector3d p = T * (static_cast<double>(a.depth(row, column)) * ray);
        const double u = b.camera.fx * p.x() / p.z() + b.camera.cx, v = b.camera.fy * p.y() / p.z() + b.camera.cy;
        if (!(u >= 0 && v >= 0 && u < b.camera.width && v < b.camera.height)) continue;
        const float seen = b.depth(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(u));
        if (!std::isnan(seen)) difference_m.push_back(std::abs(static_cast<double>(seen) - p.z()));
      }
    ASSERT_GT(difference_m.size(), 15000U);
    const auto middle = difference_m.begin() + static_cast<std::ptrdiff_t>(difference_m.size() / 2);
    std::nth_element(difference_m.begin(), middle, difference_m.end());
    EXPECT_LT(*middle, 5e-4) << i << " and " << j;  // a unit 1 % off gives 1.4 mm
  }
}

// The CAD model's floor: y = 0.08076 of its axes, z of ours, between x = -0.145 and -0.04, y = -0.029 and 0.038.
TEST_F(SimulatedCastle, AgreesWithTheCadModel) {
  const Recording r = read_recording(root);
  for (const std::size_t i : {std::size_t{0}, std::size_t{19}, std::size_t{39}}) {
    const Frame f = r.frame(i);
    double sum = 0;
    int n = 0;
    for (Eigen::Index row = 0; row < f.depth.rows(); ++row)
      for (Eigen::Index column = 0; column < f.depth.cols(); ++column) {
        if (std::isnan(f.depth(row, column))) continue;
        const Eigen::Vector3d ray = f.camera.ray(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        const Eigen::Vector3d p = f.view.T_W_C * (static_cast<double>(f.depth(row, column)) * ray);
        if (p.x() < -0.14 || p.x() > -0.045 || p.y() < -0.025 || p.y() > 0.035 || std::abs(p.z() - 0.08) > 0.004)
          continue;
        sum += p.z();
        ++n;
      }
    ASSERT_GT(n, 3000);
    EXPECT_NEAR(sum / n, 0.08076, 2e-4);
  }
}

TEST_F(SimulatedCastle, IsAWorldThatEnds) {
  const Recording r = read_recording(root);
  ReplayWorld world(r.views(), [&](std::size_t i) { return r.frame(i); });
  for (std::size_t i = 0; i < r.size(); ++i) {
    const auto frame = world.observe(world.views()[r.size() - 1 - i]);
    ASSERT_TRUE(frame);
    EXPECT_EQ(distance_m(frame->view, r.views()[r.size() - 1 - i]), 0);
    EXPECT_EQ(frame->colour.rows(), 480);
  }
  EXPECT_FALSE(world.observe(world.views()[0]));
}

TEST_F(SimulatedCastle, AlignmentFindsTheGivenPoses) {
  const Recording r = read_recording(root);
  const std::vector<View> views = r.views();
  for (std::size_t i = 3; i < r.size(); i += 6) {
    const DepthSurface model(r.frames()[i].camera, views[i - 1], r.frame(i - 1).depth);
    const auto aligned = align(DepthSurface(r.frames()[i].camera, views[i - 1], r.frame(i).depth), model);
    ASSERT_TRUE(aligned) << i;
    EXPECT_LT(distance_m(aligned->view, views[i]), 2e-4) << i;  // of motions of up to 2 cm; 0.08 mm at worst
    EXPECT_LT(turn_between_rad(aligned->view, views[i]), deg(0.03)) << i;
  }
}

class RealCastle : public Castle {
  [[nodiscard]] std::string name() const override { return "castle_realsense"; }
};

// The camera stands still and the castle turns before it: what is behind is cut off, and each frame aligned to the
// first, beginning at the pose of the one before. That the poses are right shows in the castle's own floor, which must
// stay where the first frame has it (77 mm up; the CAD model and the given first pose have it at 81 mm).
TEST_F(RealCastle, AlignmentFindsThePosesThatWereNotRecorded) {
  const auto [camera, unit_m] = parse_camera(read_file(root / "camera.txt", 4096), "camera.txt");
  const auto poses = parse_poses(read_file(root / "first_pose.txt", 4096), "first_pose.txt");
  const auto files = pictures(root / "depth");
  ASSERT_EQ(poses.size(), 1U);
  ASSERT_EQ(files.size(), 30U);
  const auto castle = [&files, c = camera, u = unit_m](std::size_t i) -> Image<float> {
    return read_depth(files[i], c, *u).unaryExpr([](float d) {
      return d < 0.36F ? d : std::numeric_limits<float>::quiet_NaN();
    });
  };
  const auto floor_m = [&castle, c = camera](std::size_t i, const View& view) {
    const Image<float> depth = castle(i);
    double sum = 0;
    int n = 0;
    for (Eigen::Index row = 0; row < depth.rows(); ++row)
      for (Eigen::Index column = 0; column < depth.cols(); ++column) {
        const Eigen::Vector3d ray = c.ray(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        const Eigen::Vector3d p = view.T_W_C * (static_cast<double>(depth(row, column)) * ray);
        if (!(p.x() > -0.135 && p.x() < -0.05 && p.y() > -0.022 && p.y() < 0.033 && std::abs(p.z() - 0.08) < 0.02))
          continue;
        sum += p.z();
        ++n;
      }
    EXPECT_GT(n, 3000);
    return sum / n;
  };
  const NormalsConfig normals = {.reach_px = 3};
  const AlignmentConfig config = {.most_apart_m = 0.02, .huber_m = 0.001};
  const DepthSurface first(camera, poses[0], castle(0), normals);
  const double floor_at_first_m = floor_m(0, poses[0]);
  View view = poses[0];
  for (std::size_t i = 1; i < files.size(); ++i) {
    const auto aligned = align(DepthSurface(camera, view, castle(i), normals), first, config);
    ASSERT_TRUE(aligned) << i;
    EXPECT_LT(aligned->rms_m, 8e-4) << i;
    EXPECT_GT(aligned->overlap, 0.7) << i;
    EXPECT_GT(aligned->conditioning, 0.05) << i;
    view = aligned->view;
    if (i % 7 == 1) { EXPECT_NEAR(floor_m(i, view), floor_at_first_m, 6e-4) << i; }
  }
  EXPECT_GT(distance_m(view, poses[0]), 0.05);  // it has turned
}

}  // namespace
}  // namespace vantage
