// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/alignment.hpp>

namespace vantage {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
const Camera camera = Camera::from_fov(320, 240, 1.1);

// Surfaces with a closed form for the distance along a ray.
struct Plane {
  Eigen::Vector3d n;
  double d;  // n . x = d
  double hit(const Eigen::Vector3d& o, const Eigen::Vector3d& r) const { return (d - n.dot(o)) / n.dot(r); }
};
struct Ball {
  Eigen::Vector3d c;
  double radius;
  double hit(const Eigen::Vector3d& o, const Eigen::Vector3d& r) const {
    const double a = r.squaredNorm(), b = r.dot(o - c), q = b * b - a * ((o - c).squaredNorm() - radius * radius);
    return q < 0 ? -1 : (-b - std::sqrt(q)) / a;
  }
};
struct Shapes {
  std::vector<Plane> planes;
  std::vector<Ball> balls;
  // Camera z, exactly.
  Image<float> depth(const View& view, double noise_share = 0, std::uint64_t seed = 1) const {
    Image<float> image(camera.height, camera.width);
    Rng rng(seed);
    for (Eigen::Index row = 0; row < image.rows(); ++row)
      for (Eigen::Index column = 0; column < image.cols(); ++column) {
        const Eigen::Vector3d ray =
            view.T_W_C.linear() * camera.ray(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        double nearest = std::numeric_limits<double>::infinity();
        const auto take = [&](double t) { nearest = t > 1e-6 ? std::min(nearest, t) : nearest; };
        for (const Plane& p : planes) take(p.hit(view.position(), ray));
        for (const Ball& b : balls) take(b.hit(view.position(), ray));
        const double noisy = nearest * (1 + noise_share * rng.normal());
        image(row, column) = std::isfinite(nearest) ? static_cast<float>(noisy) : nan;
      }
    return image;
  }
  DepthSurface surface(const View& from, const View& told, double noise_share = 0, std::uint64_t seed = 1) const {
    return {camera, told, depth(from, noise_share, seed)};
  }
};

const Shapes corner = {{{{0, 0, 1}, 0}, {{1, 0, 0}, 2.5}, {{0, 1, 0}, 2}},
                       {{{1.6, 0.9, 0.4}, 0.4}, {{2.0, 1.5, 1.2}, 0.3}}};
const View at = look_at({0, 0, 1.4}, {2, 1.4, 0.6});

View moved(const View& view, const Eigen::Vector3d& by_m, const Eigen::Vector3d& turn_rad) {
  View out = view;
  out.T_W_C =
      view.T_W_C * Eigen::Translation3d(by_m) *
      Eigen::AngleAxisd(turn_rad.norm(), turn_rad.norm() > 0 ? turn_rad.normalized() : Eigen::Vector3d::UnitX());
  return out;
}
double turn_between_rad(const View& a, const View& b) {
  return Eigen::AngleAxisd(a.T_W_C.linear().transpose() * b.T_W_C.linear()).angle();
}

TEST(DepthSurface, NormalsOfPlanesAreExactAndFaceTheCamera) {
  const DepthSurface s = corner.surface(at, at);
  int floor = 0;
  for (Eigen::Index row = 0; row < s.rows(); ++row)
    for (Eigen::Index column = 0; column < s.cols(); ++column)
      if (s.has(row, column)) {
        EXPECT_LT(s.normal(row, column).dot(s.point(row, column)), 0);
        EXPECT_NEAR(s.normal(row, column).norm(), 1, 1e-5);
        const Eigen::Vector3d p = at.T_W_C * s.point(row, column);
        if (std::abs(p.z()) > 1e-4 || (p - Eigen::Vector3d(1.6, 0.9, 0.4)).norm() < 0.6 || p.x() > 2.3 || p.y() > 1.8)
          continue;
        EXPECT_GT((at.T_W_C.linear() * s.normal(row, column)).z(), 0.9999);
        ++floor;
      }
  EXPECT_GT(floor, 5000);
}

TEST(DepthSurface, EdgesAndMissingValuesHaveNoNormal) {
  Image<float> depth = Image<float>::Constant(camera.height, camera.width, 2.0F);
  depth.rightCols(160) = 3.0F;
  depth(100, 50) = nan;
  const DepthSurface s(camera, at, depth, {.reach_px = 2});
  EXPECT_TRUE(s.has(50, 100));
  for (const Eigen::Index column : {158, 159, 160, 161}) EXPECT_FALSE(s.has(50, column));
  EXPECT_TRUE(s.has(50, 157));
  EXPECT_TRUE(s.has(50, 162));
  for (const auto& [row, column] : {std::pair{100, 50}, {100, 48}, {100, 52}, {98, 50}, {102, 50}})
    EXPECT_FALSE(s.has(row, column));
  EXPECT_FALSE(s.has(1, 100));  // no neighbour above
  EXPECT_FALSE(s.has(239, 100));
}

TEST(DepthSurface, RefusesWhatDoesNotFit) {
  EXPECT_THROW((DepthSurface{camera, at, Image<float>::Constant(10, 10, 1.0F)}), Error);
  EXPECT_THROW((DepthSurface{camera, at, corner.depth(at), {.reach_px = 0}}), Error);
  View bad = at;
  bad.T_W_C.linear() *= 2;
  EXPECT_THROW((DepthSurface{camera, bad, corner.depth(at)}), Error);
}

TEST(Alignment, RecoversKnownMotions) {
  const DepthSurface model = corner.surface(at, at);
  Rng rng(3);
  for (int k = 0; k < 8; ++k) {
    const auto random = [&] { return Eigen::Vector3d(rng.normal(), rng.normal(), rng.normal()).normalized(); };
    const View truth = moved(at, 0.05 * random(), deg(3) * random());
    const auto aligned = align(corner.surface(truth, at), model);
    ASSERT_TRUE(aligned) << k;
    EXPECT_LT(distance_m(aligned->view, truth), 1e-3) << k;
    EXPECT_LT(turn_between_rad(aligned->view, truth), deg(0.05)) << k;
    EXPECT_LT(aligned->rms_m, 2e-3);
    EXPECT_GT(aligned->overlap, 0.8);
    EXPECT_GT(aligned->conditioning, 1e-3);
    check_view(aligned->view, "the result");
  }
}

TEST(Alignment, RecoversLargerMotionsCoarseToFine) {
  const View truth = moved(at, {0.12, -0.1, 0.1}, {deg(4), deg(-5), deg(4)});
  const auto aligned = align(corner.surface(truth, at), corner.surface(at, at));
  ASSERT_TRUE(aligned);
  EXPECT_LT(distance_m(aligned->view, truth), 1e-3);
  EXPECT_LT(turn_between_rad(aligned->view, truth), deg(0.05));
}

// sigma = 0.5 % of depth, about 1 cm: the error of the average over 60,000 pairs stays far below.
TEST(Alignment, AveragesNoiseAway) {
  const View truth = moved(at, {0.03, 0.02, -0.03}, {deg(1), deg(-2), deg(1)});
  const DepthSurface model = corner.surface(at, at);
  const auto aligned =
      align(DepthSurface(camera, at, corner.depth(truth, 0.005, 7), {.reach_px = 6, .most_step_share = 0.1}), model,
            {.most_turn_rad = 1.2, .huber_m = 0.02});
  ASSERT_TRUE(aligned);
  EXPECT_LT(distance_m(aligned->view, truth), 3e-3);
  EXPECT_LT(turn_between_rad(aligned->view, truth), deg(0.1));
  EXPECT_NEAR(aligned->rms_m, 0.008, 0.004);
}

// A fifth of the source shows something that has moved: Huber's weights keep it from pulling.
TEST(Alignment, ToleratesOutliers) {
  const View truth = moved(at, {0.02, -0.01, 0.02}, {deg(1), deg(1), deg(-1)});
  Image<float> depth = corner.depth(truth);
  depth.block(80, 100, 100, 150) -= 0.05F;
  const auto aligned = align(DepthSurface(camera, at, depth), corner.surface(at, at), {.huber_m = 0.001});
  ASSERT_TRUE(aligned);
  EXPECT_LT(distance_m(aligned->view, truth), 5e-3);
}

TEST(Alignment, SaysNoWhereAMotionCannotBeSeen) {
  const Shapes wall = {{{{1, 0, 0}, 2.5}}, {}}, ball = {{}, {{{2, 1.4, 0.6}, 0.8}}};
  const View front = look_at({0, 0, 1}, {2.5, 0.3, 1});
  const View truth = moved(front, {0.01, 0.01, 0.01}, {0.01, 0.0, 0.0});
  EXPECT_FALSE(align(wall.surface(truth, front), wall.surface(front, front)));
  const View truth2 = moved(at, {0.01, 0.01, 0.01}, {0.01, 0.0, 0.0});
  EXPECT_FALSE(align(ball.surface(truth2, at), ball.surface(at, at)));
}

TEST(Alignment, SaysNoWhereNothingOverlaps) {
  const View away = look_at({0, 0, 1.4}, {-2, -1.4, 0.6});
  EXPECT_FALSE(align(corner.surface(at, away), corner.surface(at, at)));
  const DepthSurface blank(camera, at, Image<float>::Constant(camera.height, camera.width, nan));
  EXPECT_FALSE(align(blank, corner.surface(at, at)));
  EXPECT_FALSE(align(corner.surface(at, at), blank));
}

TEST(Alignment, SameBitsWithAnyNumberOfThreads) {
  const View truth = moved(at, {0.03, 0.02, -0.03}, {deg(1), deg(-2), deg(1)});
  const DepthSurface source = corner.surface(truth, at, 0.001), model = corner.surface(at, at);
  std::vector<Alignment> results;
  for (const int threads : {1, 2, 3}) {
    tbb::task_arena arena(threads);
    const auto result = arena.execute([&] { return align(source, model); });
    ASSERT_TRUE(result);
    results.push_back(*result);
  }
  for (const Alignment& r : results) {
    EXPECT_EQ(std::memcmp(r.view.T_W_C.data(), results[0].view.T_W_C.data(), sizeof(double) * 16), 0);
    EXPECT_EQ(r.rms_m, results[0].rms_m);
    EXPECT_EQ(r.pairs, results[0].pairs);
  }
}

TEST(Alignment, NamesEveryBadMember) {
  const DepthSurface s = corner.surface(at, at);
  try {
    (void)align(s, s, {.most_apart_m = 0, .most_turn_rad = 4, .levels = 0, .least_overlap = 2});
    FAIL();
  } catch (const Error& e) {
    for (const char* name : {"most_apart_m", "most_turn_rad", "levels", "least_overlap"})
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace vantage
