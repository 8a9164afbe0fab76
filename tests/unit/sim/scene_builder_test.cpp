// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/scene_builder.hpp>

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include <vantage/sim/procedural_texture.hpp>

namespace vantage {
namespace {

// By the divergence theorem: right for a closed surface, positive if its triangles are counter-clockwise from outside.
double volume(const Scene& scene) {
  double sum = 0;
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    const auto [a, b, c] = scene.mesh.corners(t);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}
double area(const Scene& scene) {
  double sum = 0;
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) sum += scene.mesh.area_normal(t).norm() / 2;
  return sum;
}

TEST(SceneBuilder, BoxesAreClosedOfAnyDetail) {
  for (const double edge : {std::numeric_limits<double>::infinity(), 0.5, 0.07}) {
    SceneBuilder b(edge);
    const auto look = b.plain("grey", {0.5F, 0.5F, 0.5F});
    b.label = b.class_of("box");
    b.pose.translate(Eigen::Vector3d(3, -1, 2));
    b.pose.rotate(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()));
    b.box({-0.5, 0, 0.25}, {0.5, 0.5, 2}, look);
    b.scene().validate("test");
    EXPECT_NEAR(volume(b.scene()), 1 * 0.5 * 1.75, 1e-5);
    EXPECT_NEAR(area(b.scene()), 2 * (0.5 + 1.75 + 0.875), 1e-5);
    EXPECT_EQ(b.scene().label.front(), 1);
    EXPECT_TRUE(std::isinf(edge) ? b.scene().mesh.triangles.size() == 12 : true);
    for (std::size_t t = 0; t < b.scene().mesh.triangles.size(); ++t) {  // the two short edges
      const auto [p, q, r] = b.scene().mesh.corners(t);
      EXPECT_LE(std::min({std::max((p - q).norm(), (q - r).norm()), std::max((q - r).norm(), (r - p).norm())}),
                edge + 1e-5);
    }
  }
}

TEST(SceneBuilder, TurnedAndRoundSolidsAreClosed) {
  const double pi = std::numbers::pi;
  SceneBuilder cylinder(0.02), cone(0.02), ball(0.02);
  cylinder.cylinder({1, 2, 3}, 0.5, 0.5, 2, cylinder.plain("", {1, 1, 1}));
  EXPECT_NEAR(volume(cylinder.scene()), pi * 0.25 * 2, 0.002);
  EXPECT_NEAR(area(cylinder.scene()), 2 * pi * 0.25 + 2 * pi * 0.5 * 2, 0.01);
  cone.cylinder({0, 0, 0}, 0.5, 0, 1, cone.plain("", {1, 1, 1}));
  EXPECT_NEAR(volume(cone.scene()), pi * 0.25 / 3, 0.001);
  ball.ellipsoid({0, 0, 5}, {0.5, 0.4, 0.3}, ball.plain("", {1, 1, 1}));
  EXPECT_NEAR(volume(ball.scene()), 4 * pi / 3 * 0.5 * 0.4 * 0.3, 0.001);
  SceneBuilder vase;
  vase.turned({0, 0, 0}, std::array<Eigen::Vector2d, 4>{{{1, 0}, {2, 1}, {2, 2}, {0.5, 3}}}, vase.plain("", {1, 1, 1}));
  vase.scene().validate("test");
  const double exact = pi / 3 * (1 + 2 + 4) + pi * 4 + pi / 3 * (4 + 1 + 0.25), coarse = 8 * std::sin(2 * pi / 16) / pi;
  EXPECT_NEAR(volume(vase.scene()), exact * coarse, 1e-3);  // a prism of 16 sides
}

TEST(SceneBuilder, TexturesRepeatByLength) {
  SceneBuilder b;
  const auto look = b.textured("wood", procedural::wood({0.5F, 0.4F, 0.3F}, Rng(1)), 0.5);
  b.quad({0, 0, 0}, {2, 0, 0}, {0, 3, 0}, look);
  EXPECT_TRUE(b.scene().uv[0][1].isApprox(Eigen::Vector2f(4, 0)));
  EXPECT_TRUE(b.scene().uv[0][2].isApprox(Eigen::Vector2f(4, 6)));
  b.quad({0, 0, 1}, {2, 0, 0}, {0, 3, 0}, {look.material, 0});
  EXPECT_TRUE(b.scene().uv[2][2].isApprox(Eigen::Vector2f(1, 1)));
  EXPECT_THROW(SceneBuilder(0), Error);
  EXPECT_THROW(SceneBuilder(std::nan("")), Error);
}

TEST(ProceduralTexture, RepeatWithoutASeam) {
  using namespace procedural;
  const Colour c(0.6F, 0.5F, 0.4F);
  for (const Texture& t : {plaster(c, Rng(1)), wood(c, Rng(2)), fabric(c, Rng(3)), mottled(c, 1.2F * c, 6, Rng(4))}) {
    ASSERT_EQ(t.rgb.size(), static_cast<std::size_t>(t.width * t.height));
    const auto step = [&](int row, int column, int next_row, int next_column) {
      const auto& a = t.rgb[static_cast<std::size_t>(row * t.width + column)];
      const auto& b = t.rgb[static_cast<std::size_t>(next_row * t.width + next_column)];
      return std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
    };
    double seam = 0, inside = 0;
    for (int i = 0; i < t.height; ++i) {
      seam += step(i, t.width - 1, i, 0) + step(t.height - 1, i, 0, i);
      inside += step(i, 99, i, 100) + step(99, i, 100, i);
    }
    EXPECT_LT(seam, 2.5 * inside + 256);
    EXPECT_GT(inside, 0);
  }
}

TEST(ProceduralTexture, NoiseIsPeriodicBoundedAndSeeded) {
  const procedural::FractalNoise a(4, 3, 4, Rng(1)), b(4, 3, 4, Rng(2));
  Rng rng(5);
  double largest = 0, smallest = 1;
  for (int i = 0; i < 2000; ++i) {
    const auto u = static_cast<float>(rng.uniform(-1, 1)), v = static_cast<float>(rng.uniform(-1, 1));
    const float x = a(u, v);
    EXPECT_NEAR(a(u + 1, v), x, 1e-4);
    EXPECT_NEAR(a(u, v - 1), x, 1e-4);
    EXPECT_NE(x, b(u, v));
    largest = std::max<double>(largest, x);
    smallest = std::min<double>(smallest, x);
  }
  EXPECT_LE(largest, 1);
  EXPECT_GE(smallest, 0);
  EXPECT_GT(largest - smallest, 0.3);
}

TEST(ProceduralTexture, OrientationIsUpright) {
  // The outlook has its sky above: v = 1 is the first row.
  const Texture t = procedural::outlook(Rng(1));
  int blue_top = 0, blue_bottom = 0;
  for (int column = 0; column < t.width; ++column) {
    const auto& top = t.rgb[static_cast<std::size_t>(column)];
    const auto& bottom = t.rgb[static_cast<std::size_t>((t.height - 1) * t.width + column)];
    blue_top += top[2] > top[1];
    blue_bottom += bottom[2] > bottom[1];
  }
  EXPECT_GT(blue_top, t.width / 2);
  EXPECT_EQ(blue_bottom, 0);
}

}  // namespace
}  // namespace vantage
