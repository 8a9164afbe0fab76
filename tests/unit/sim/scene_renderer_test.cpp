// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/scene_renderer.hpp>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>

namespace vantage {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using All = Rendering<channel::Colour, channel::Depth, channel::Normal, channel::Labels>;

// The square x, y in [-s, s] at z = 0, seen counter-clockwise from above; uv from (0, 0) to (repeats, repeats).
Scene square(float s, float repeats = 1) {
  Scene scene;
  scene.mesh.vertices = {{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}};
  scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Eigen::Vector2f a(0, 0), b(repeats, 0), c(repeats, repeats), d(0, repeats);
  scene.uv = {{a, b, c}, {a, c, d}};
  scene.classes = {"unknown", "left", "right"};
  scene.label = {1, 2};
  return scene;
}

Texture checker(int n) {  // of n x n squares of 4 x 4 texels: red where both are even or odd, else blue
  Texture t{4 * n, 4 * n, {}};
  for (int row = 0; row < t.height; ++row)
    for (int column = 0; column < t.width; ++column)
      t.rgb.push_back((row / 4 + column / 4) % 2 == 0 ? std::array<std::uint8_t, 3>{255, 0, 0}
                                                      : std::array<std::uint8_t, 3>{0, 0, 255});
  return t;
}

Scene textured(float s, float repeats, int squares) {
  Scene scene = square(s, repeats);
  scene.textures = {checker(squares)};
  scene.materials = {{.name = "checker", .colour = Eigen::Vector3f::Ones(), .texture = 0U}};
  return scene;
}

template <class Channels = All>
Channels draw(const Scene& scene, const View& view, const Camera& camera, const SceneRendererConfig& config = {}) {
  Channels out;
  SceneRenderer(scene, config).render(view, camera, out);
  return out;
}

Eigen::Vector3f colour_at(const ColourImage& image, Eigen::Index row, Eigen::Index column) {
  return {image.r(row, column), image.g(row, column), image.b(row, column)};
}

View tilted() {  // looks at the square askew, rolled
  View v = look_at({0.7, -1.9, 1.6}, {0.1, 0.2, 0});
  v.T_W_C.rotate(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
  return v;
}

TEST(SceneRenderer, DepthIsCameraZAtPixelCentres) {
  const Camera camera{61, 43, 70, 55, 28.3, 24.9};  // no multiple of a packet, nothing in the middle
  for (const View& view : {nadir(0.2, -0.1, 2), tilted()}) {
    const All out = draw(square(50), view, camera);
    ASSERT_EQ(out.depth.rows(), 43);
    ASSERT_EQ(out.depth.cols(), 61);
    for (int row = 0; row < camera.height; ++row)
      for (int column = 0; column < camera.width; ++column) {
        // The plane z = 0: eye_z + depth d_z = 0.
        const Eigen::Vector3d d = view.T_W_C.linear() * camera.ray(column + 0.5, row + 0.5);
        const double depth = -view.position().z() / d.z();
        if (depth > 0 && depth * d.norm() < 45) {
          EXPECT_NEAR(out.depth(row, column), depth, 3e-6 * depth) << row << " " << column;
        } else if (depth < 0) {
          EXPECT_TRUE(std::isnan(out.depth(row, column)));
        }
      }
  }
}

TEST(SceneRenderer, LabelsNormalsAndBackgroundAreThoseOfTheRay) {
  const Camera camera = Camera::from_fov(50, 37, deg(80));
  const SceneRendererConfig config{.background = {0.1F, 0.2F, 0.3F}};
  for (const View& view : {tilted(), look_at({0.3, 0.1, -2}, {0, 0, 0})}) {
    const All out = draw(square(1), view, camera, config);
    int seen[3] = {};
    for (int row = 0; row < camera.height; ++row)
      for (int column = 0; column < camera.width; ++column) {
        const Eigen::Vector3d d = view.T_W_C.linear() * camera.ray(column + 0.5, row + 0.5);
        const double depth = -view.position().z() / d.z();
        const Eigen::Vector3d p = view.position() + depth * d;
        if (std::abs(std::abs(p.x()) - 1) < 1e-4 || std::abs(std::abs(p.y()) - 1) < 1e-4 ||
            std::abs(p.x() - p.y()) < 1e-4)
          continue;  // on an edge
        const int label = depth < 0 || p.head<2>().cwiseAbs().maxCoeff() > 1 ? 0 : p.x() > p.y() ? 1 : 2;
        ++seen[label];
        EXPECT_EQ(out.labels(row, column), label);
        EXPECT_EQ(std::isnan(out.depth(row, column)), label == 0);
        if (label == 0) {
          EXPECT_EQ(colour_at(out, row, column), config.background);
          EXPECT_TRUE(std::isnan(out.x(row, column)) && std::isnan(out.z(row, column)));
        } else {
          EXPECT_NEAR(out.z(row, column), view.position().z() > 0 ? 1 : -1, 1e-6);
          EXPECT_NEAR(out.x(row, column), 0, 1e-6);
        }
      }
    for (const int n : seen) EXPECT_GT(n, 100);
  }
}

TEST(SceneRenderer, ShadesBothSidesByLambertsLaw) {
  Scene scene = square(5);
  scene.materials = {{.name = "", .colour = {0.9F, 0.6F, 0.3F}}};
  SceneRendererConfig config;
  config.lighting = {{0.2F, 0.1F, 0.0F}, {{{0, 3, 4}, {0.5F, 0.25F, 1}}, {{0, 0, -2}, {0.1F, 0.2F, 0.3F}}}};
  const Camera camera = Camera::from_fov(9, 9, deg(30));
  // From above the first light shines at a cosine of 0.8, and the second one from behind; from below only that one.
  const Eigen::Vector3f above = Eigen::Vector3f(0.9F * 0.6F, 0.6F * 0.3F, 0.3F * 0.8F);
  const Eigen::Vector3f below = Eigen::Vector3f(0.9F * 0.3F, 0.6F * 0.3F, 0.3F * 0.3F);
  const All from_above = draw(scene, look_at({0, 1, 2}, {0, 0, 0}), camera, config);
  const All from_below = draw(scene, look_at({0, 1, -2}, {0, 0, 0}), camera, config);
  for (int k = 0; k < 9; ++k) {
    EXPECT_TRUE(colour_at(from_above, k, 8 - k).isApprox(above, 1e-5F));
    EXPECT_TRUE(colour_at(from_below, k, 8 - k).isApprox(below, 1e-5F));
  }
  config.lighting.ambient = {3, 3, 3};  // too bright: clamped
  EXPECT_EQ(colour_at(draw(scene, look_at({0, 1, 2}, {0, 0, 0}), camera, config), 4, 4),
            Eigen::Vector3f(1, 1, 0.9F + 0.3F * 0.8F).cwiseMin(1));
}

TEST(SceneRenderer, TexturesLieWhereTheirCoordinatesSay) {
  // 8 x 8 squares of 0.25 m; a pixel is an eighth of a square. Squares are drawn from the top left, v = 1.
  const Camera camera{64, 64, 64, 64, 32, 32};
  const All out = draw(textured(1, 1, 8), nadir(0, 0, 2), camera, {.lighting = Lighting::none()});
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) {
      const bool inside =
          row % 8 > 0 && row % 8 < 7 && column % 8 > 0 && column % 8 < 7;  // away from the filter's blur
      if (!inside) continue;
      const bool red = (row / 8 + column / 8) % 2 == 0;
      EXPECT_TRUE(
          colour_at(out, row, column).isApprox(red ? Eigen::Vector3f(1, 0, 0) : Eigen::Vector3f(0, 0, 1), 1e-4F))
          << row << " " << column;
    }
}

TEST(SceneRenderer, MinifiedTexturesTurnIntoTheirMeanColour) {
  const Camera camera = Camera::from_fov(64, 64, deg(60));
  // 400 repetitions of 8 x 8 squares over 100 m: from 30 m a pixel covers many squares, whatever the angle.
  const All out = draw(textured(50, 400, 8), look_at({0, -10, 30}, {0, 0, 0}), camera, {.lighting = Lighting::none()});
  int seen = 0;
  for (int row = 0; row < 64; ++row)
    for (int column = 0; column < 64; ++column) {
      if (out.labels(row, column) == 0) continue;
      ++seen;
      EXPECT_TRUE(colour_at(out, row, column).isApprox(Eigen::Vector3f(0.5F, 0, 0.5F), 0.02F));
    }
  EXPECT_EQ(seen, 64 * 64);
}

TEST(SceneRenderer, AveragedPicturesKeepTheirMeanAtAnyDistance) {
  // A filter that is too sharp flickers, one that is too soft blurs; both keep the mean, the first one with variance.
  const Camera camera = Camera::from_fov(96, 96, deg(20));
  double before = 1;
  for (const double height : {2.0, 32.0, 256.0}) {
    const All out = draw(textured(100, 100, 8), nadir(0.013, 0.007, height), camera, {.lighting = Lighting::none()});
    const double red = out.r.cast<double>().mean(), variance = (out.r.cast<double>() - red).square().mean();
    EXPECT_NEAR(red, 0.5, 0.06);
    EXPECT_LT(variance, before);
    before = variance;
  }
  EXPECT_LT(before, 0.01);
}

TEST(SceneRenderer, VertexColoursAndMaterialsMultiply) {
  Scene scene = square(1);
  scene.mesh.colours = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  scene.materials = {{.name = "", .colour = {1, 0.5F, 0.25F}}};
  const Camera camera{32, 32, 32, 32, 16, 16};
  const View view = nadir(0, 0, 2);
  const All out = draw(scene, view, camera, {.lighting = Lighting::none()});
  for (int row = 0; row < 32; ++row)
    for (int column = 0; column < 32; ++column) {
      const float x = (static_cast<float>(column) + 0.5F) / 32, y = 1 - (static_cast<float>(row) + 0.5F) / 32;
      // Corners (0, 0), (1, 0), (1, 1), (0, 1): linear over either triangle.
      const Eigen::Vector3f mix =
          x > y ? Eigen::Vector3f(1 - x, x - y, y) : Eigen::Vector3f(1 - y + (y - x), y - x, x + (y - x));
      EXPECT_LT((colour_at(out, row, column) - mix.cwiseProduct(scene.materials[0].colour)).cwiseAbs().maxCoeff(),
                1e-5F);
    }
}

TEST(SceneRenderer, MixesTexturedAndPlainTriangles) {
  Scene scene = textured(1, 1, 2);
  scene.materials.push_back({.name = "green", .colour = {0, 1, 0}});
  scene.material = {0, 1};
  const Camera camera{32, 32, 32, 32, 16, 16};
  const All out = draw(scene, nadir(0, 0, 2), camera, {.lighting = Lighting::none()});
  for (int row = 0; row < 32; ++row)
    for (int column = 0; column < 32; ++column) {
      if (out.labels(row, column) == 2) {
        EXPECT_EQ(colour_at(out, row, column), Eigen::Vector3f(0, 1, 0));
      } else {
        EXPECT_EQ(out.g(row, column), 0);
      }
    }
}

TEST(SceneRenderer, DrawsOnlyWhatIsAskedForAndTheSame) {
  const Camera camera = Camera::from_fov(33, 21, deg(60));
  const SceneRenderer renderer(textured(1, 2, 4));
  All all;
  renderer.render(tilted(), camera, all);
  Rendering<channel::Depth> depth;
  renderer.render(tilted(), camera, depth);
  Rendering<channel::Labels, channel::Colour> rest;
  renderer.render(tilted(), camera, rest);
  EXPECT_TRUE((depth.depth == all.depth || (depth.depth.isNaN() && all.depth.isNaN())).all());
  EXPECT_TRUE((rest.labels == all.labels).all() && (rest.r == all.r).all() && (rest.b == all.b).all());
}

TEST(SceneRenderer, IsTheSameOnAnyNumberOfThreads) {
  Scene scene;  // a heap of triangles, some of which cross and coincide
  Rng rng(4);
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const Eigen::Vector3f centre(static_cast<float>(rng.uniform(-1, 1)), static_cast<float>(rng.uniform(-1, 1)),
                                 static_cast<float>(rng.index(3)));
    for (int k = 0; k < 3; ++k)
      scene.mesh.vertices.push_back(
          centre + 0.3F * Eigen::Vector3f(static_cast<float>(rng.uniform()), static_cast<float>(rng.uniform()), 0));
    scene.mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    scene.label.push_back(static_cast<std::uint16_t>(i % 7));
    scene.material.push_back(i % 5);
  }
  scene.classes.resize(7, "class");
  scene.materials.clear();
  for (int i = 0; i < 5; ++i)
    scene.materials.push_back({.name = "", .colour = Eigen::Vector3f::Constant(0.2F * static_cast<float>(i))});
  const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
  const auto on = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      return draw(scene, look_at({0.2, 0, 6}, {0, 0, 0}), Camera::from_fov(200, 150, deg(40)));
    });
  };
  const All one = on(1);
  EXPECT_GT((one.labels > 0).count(), 10000);
  for (const int threads : {2, 8}) {
    const All many = on(threads);
    EXPECT_TRUE((many.labels == one.labels).all() && (many.r == one.r).all());
    EXPECT_TRUE((many.depth == one.depth || (many.depth.isNaN() && one.depth.isNaN())).all());
  }
}

std::string refusal(const Scene& scene, const SceneRendererConfig& config = {}) {
  try {
    const SceneRenderer renderer(scene, config);
  } catch (const Error& e) { return e.what(); }
  return "accepted";
}

TEST(SceneRenderer, RefusesBadScenesAndLights) {
  const auto names = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_EQ(refusal(square(1)), "accepted");
  EXPECT_TRUE(names(refusal(Scene{}), "no triangle")) << refusal(Scene{});
  Scene scene = square(1);
  scene.mesh.vertices[2].x() = static_cast<float>(nan);
  EXPECT_TRUE(names(refusal(scene), "vertex 2")) << refusal(scene);
  scene = square(1);
  scene.label[1] = 3;
  EXPECT_TRUE(names(refusal(scene), "triangle 1 has class 3")) << refusal(scene);
  scene = textured(1, 1, 2);
  scene.uv[1][2].y() = 1e9F;
  EXPECT_TRUE(names(refusal(scene), "triangle 1 has texture coordinates")) << refusal(scene);
  scene = square(1);
  EXPECT_TRUE(names(refusal(scene, {.lighting = {{-1, 0, 0}, {}}}), "ambient"));
  EXPECT_TRUE(names(refusal(scene, {.lighting = {{0, 0, 0}, {{{0, 0, 0}, {1, 1, 1}}}}}), "lights[0].towards"));
  EXPECT_TRUE(names(refusal(scene, {.lighting = {{0, 0, 0}, {{{0, 0, 1}, {1, static_cast<float>(nan), 1}}}}}),
                    "lights[0].intensity"));
  EXPECT_TRUE(names(refusal(scene, {.background = {0, 0, 1.5F}}), "background"));

  const SceneRenderer renderer(square(1));
  All out;
  View view = tilted();
  const Camera camera = Camera::from_fov(8, 8, 1);
  view.T_W_C.translation().y() = nan;
  EXPECT_THROW(renderer.render(view, camera, out), Error);
  view = tilted();
  view.T_W_C.linear() *= 2;
  EXPECT_THROW(renderer.render(view, camera, out), Error);
  view = tilted();
  view.T_W_C.translation().x() = 1e30;
  EXPECT_THROW(renderer.render(view, camera, out), Error);
  EXPECT_THROW(renderer.render(tilted(), Camera{8, 8, 0, 5, 4, 4}, out), Error);
  EXPECT_THROW(renderer.render(tilted(), Camera{8, 8, 5, 5, nan, 4}, out), Error);
  EXPECT_THROW(renderer.render(tilted(), Camera{8, 8, 1e-30, 5, 4, 4}, out), Error);  // a ray without end
}

}  // namespace
}  // namespace vantage
