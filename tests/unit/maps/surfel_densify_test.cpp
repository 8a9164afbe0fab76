// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
// Filtered depth and normals against slow obvious ones, and where new surfels come from.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <tbb/task_arena.h>

#include <vantage/concepts/channels.hpp>
#include <vantage/core/units.hpp>
#include <vantage/maps/surfel/bilateral_filter.hpp>
#include <vantage/maps/surfel/densify.hpp>
#include <vantage/maps/surfel/depth_normals.hpp>

namespace vantage {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

Image<float> noisy_depth(int height, int width) {
  Rng rng(5);
  Image<float> d(height, width);
  for (Eigen::Index v = 0; v < height; ++v)
    for (Eigen::Index u = 0; u < width; ++u)
      d(v, u) =
          rng.uniform() < 0.1
              ? none
              : static_cast<float>((u > width / 2 ? 3.0 : 1.5) + 0.01 * static_cast<double>(v) + 0.02 * rng.normal());
  return d;
}

TEST(BilateralFilter, IsTheSumOverTheDisc) {
  const Image<float> depth = noisy_depth(23, 31), ours = bilateral_filter(depth);
  for (int v = 0; v < 23; ++v)
    for (int u = 0; u < 31; ++u) {
      if (std::isnan(depth(v, u))) {
        EXPECT_TRUE(std::isnan(ours(v, u)));
        continue;
      }
      double sum = 0, weights = 0;
      for (int dy = -7; dy <= 7; ++dy)
        for (int dx = -7; dx <= 7; ++dx) {
          const int y = v + dy, x = u + dx;
          if (dx * dx + dy * dy > 49 || y < 0 || y >= 23 || x < 0 || x >= 31 || std::isnan(depth(y, x))) continue;
          const double step = static_cast<double>(depth(y, x)) - static_cast<double>(depth(v, u));
          const double w = std::exp(-(dx * dx + dy * dy) / (2 * 400.0) - step * step / (2 * 0.25));
          weights += w;
          sum += w * static_cast<double>(depth(y, x));
        }
      EXPECT_NEAR(ours(v, u), sum / weights, 2e-6);
    }
}

TEST(BilateralFilter, RefusesABadConfigurationAndTakesNothing) {
  EXPECT_THROW(bilateral_filter(noisy_depth(4, 4), {.diameter_px = 4}), Error);
  EXPECT_THROW(bilateral_filter(noisy_depth(4, 4), {.range_m = 0}), Error);
  EXPECT_EQ(bilateral_filter(Image<float>(0, 0)).size(), 0);
  EXPECT_TRUE(bilateral_filter(Image<float>::Constant(5, 4, none)).isNaN().all());
}

TEST(NormalsOf, APlane) {
  // n . p = -2 with n towards the camera.
  const Camera camera = Camera::from_fov(20, 16, deg(70));
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.2, -1).normalized();
  Image<float> depth(16, 20);
  for (int v = 0; v < 16; ++v)
    for (int u = 0; u < 20; ++u) depth(v, u) = static_cast<float>(-2 / n.dot(camera.ray(u + 0.5, v + 0.5)));
  depth(7, 8) = none;
  depth(0, 0) = depth(0, 1) = depth(1, 1) = none;
  const NormalImage normals = normals_of(depth, camera);
  for (int v = 0; v < 16; ++v)
    for (int u = 0; u < 20; ++u) {
      const Eigen::Vector3d ours(normals.x(v, u), normals.y(v, u), normals.z(v, u));
      if (std::isnan(depth(v, u)) || (v == 1 && u == 0))  // has no neighbour along the rows
        EXPECT_EQ(ours.norm(), 0);
      else
        EXPECT_NEAR(ours.dot(n), 1, 1e-6) << v << " " << u;
    }
}

TEST(NormalsOf, NoneWithoutNeighbours) {
  Image<float> depth = Image<float>::Constant(3, 3, none);
  depth(1, 1) = 2;
  const NormalImage normals = normals_of(depth, Camera::from_fov(3, 3, deg(60)));
  EXPECT_EQ(normals.x.abs().maxCoeff() + normals.y.abs().maxCoeff() + normals.z.abs().maxCoeff(), 0);
}

TEST(QuaternionTowards, TakesTheAxisToAnyNormal) {
  Rng rng(2);
  const auto check = [](const Eigen::Vector3d& n) {
    const auto q = quaternion_towards(n);
    EXPECT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-12);
    EXPECT_LT((normal_of(q[0], q[1], q[2], q[3]) - n).norm(), 1e-12) << n.transpose();
    const Eigen::Vector3f f = n.cast<float>();
    const auto s = quaternion_towards(f);
    EXPECT_LT((normal_of(s[0], s[1], s[2], s[3]) - f).norm(), 1e-6F) << n.transpose();
  };
  for (int k = 0; k < 200; ++k) check(Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized());
  for (const double z : {1.0, -1.0, 1e-9, -1e-9}) check(Eigen::Vector3d(1e-8, 0, z).normalized());
  check({1, 0, 0});
  check({0, -1, 0});
  check({0, 0, -1});
}

TEST(WantsSurfel, IsEquation6Point4) {
  const DensifyConfig squared, absolute{.most_colour_error = 0.5, .squared_colour_error = false};
  const Eigen::Array3f same(0, 0, 0);
  EXPECT_TRUE(wants_surfel(squared, 0.49F, same, 2, 2));
  EXPECT_FALSE(wants_surfel(squared, 0.51F, same, 2, 2));
  EXPECT_TRUE(wants_surfel(squared, 1, same, 2.11F, 2));
  EXPECT_FALSE(wants_surfel(squared, 1, same, 2.09F, 2));
  EXPECT_FALSE(wants_surfel(squared, 1, same, 1.5F, 2));
  EXPECT_FALSE(wants_surfel(squared, 1, same, none, 2));
  EXPECT_TRUE(wants_surfel(squared, 1, {0.9F, 0, 0}, 2, 2));    // mean square 0.27
  EXPECT_FALSE(wants_surfel(absolute, 1, {0.9F, 0, 0}, 2, 2));  // mean 0.3
  EXPECT_TRUE(wants_surfel(absolute, 1, {0.9F, -0.8F, 0}, 2, 2));
}

struct Wall {
  Frame frame;
  Rendering<channel::Colour, channel::Depth, channel::Opacity> drawn;
  Wall() {
    frame.camera = Camera::from_fov(40, 30, deg(60));
    frame.view = look_at({0.3, -2, 1}, {0.3, 0, 1});
    frame.depth.setConstant(30, 40, 1.5F);
    frame.colour.resize(30, 40);
    frame.colour.r.setConstant(30, 40, 0.2F), frame.colour.g.setConstant(30, 40, 0.4F);
    frame.colour.b.setConstant(30, 40, 0.6F);
    drawn.ColourImage::resize(30, 40);
    drawn.r.setZero(), drawn.g.setZero(), drawn.b.setZero();
    drawn.opacity.setZero(30, 40);
    drawn.depth.setConstant(30, 40, none);
  }
};

TEST(Densify, OneRandomPointAVoxelOfTheWall) {
  Wall w;
  w.frame.depth(3, 4) = none;
  Surfels s;
  Rng rng(1);
  const std::size_t added = densify(s, w.frame, w.drawn, {.spacing_m = 0.1}, rng);
  EXPECT_EQ(added, s.size());
  std::map<std::tuple<int, int, int>, int> voxels;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const Eigen::Vector3f p = position_of(s, i), n = normal_of(s, i);
    EXPECT_NEAR(p.y(), -0.5F, 1e-5F);
    EXPECT_LT((n - Eigen::Vector3f(0, -1, 0)).norm(), 1e-5F);
    const auto at = [](float x) { return static_cast<int>(std::floor(static_cast<double>(x) / 0.1)); };
    EXPECT_EQ(++voxels[std::tuple(at(p.x()), at(p.y()), at(p.z()))], 1);
    const Surfel one = s[i];
    EXPECT_EQ(one.parameter[surfel::log_scale_x], 0);
    EXPECT_EQ(one.parameter[surfel::logit], 0);
    EXPECT_EQ(one.parameter[surfel::green], 0.4F);
    EXPECT_EQ(one.confidence, 0);
  }
  EXPECT_GT(s.size(), 17U * 12U);  // the wall is 1.73 m x 1.3 m
  EXPECT_LT(s.size(), 20U * 16U);
  Surfels other;
  densify(other, w.frame, w.drawn, {.spacing_m = 0.1}, rng);
  EXPECT_NE(other.parameter[0], s.parameter[0]);  // another draw
}

TEST(Densify, NothingWhereAllIsWellOrNothingWasMeasured) {
  Wall w;
  Surfels s;
  Rng rng(1);
  w.drawn.opacity.setOnes();
  w.drawn.depth.setConstant(1.5F);
  w.drawn.r = w.frame.colour.r, w.drawn.g = w.frame.colour.g, w.drawn.b = w.frame.colour.b;
  EXPECT_EQ(densify(s, w.frame, w.drawn, {}, rng), 0U);
  w.drawn.depth.block(10, 10, 5, 5).setConstant(2.5F);  // something new in front
  EXPECT_GT(densify(s, w.frame, w.drawn, {}, rng), 5U);
  w.drawn.opacity.setZero();
  w.frame.depth.setConstant(none);
  EXPECT_EQ(densify(s, w.frame, w.drawn, {}, rng), 0U);
}

TEST(Densify, FarAwayAndTinyDepthsDoNoHarm) {
  Wall w;
  for (const float depth : {1e30F, 1e-30F, 3e4F}) {
    w.frame.depth.setConstant(depth);
    Surfels s;
    Rng rng(1);
    densify(s, w.frame, w.drawn, {}, rng);
    for (std::size_t i = 0; i < s.size(); ++i) EXPECT_TRUE(position_of(s, i).allFinite());
  }
}

TEST(Densify, TheSameBitsWithAnyNumberOfThreads) {
  const Wall w;
  const auto run = [&](int threads) {
    Surfels s;
    Rng rng(9);
    tbb::task_arena(threads).execute([&] { densify(s, w.frame, w.drawn, {}, rng); });
    return s;
  };
  const Surfels one = run(1), two = run(2);
  for (std::size_t p = 0; p < surfel::parameters; ++p) EXPECT_EQ(one.parameter[p], two.parameter[p]);
}

}  // namespace
}  // namespace vantage
