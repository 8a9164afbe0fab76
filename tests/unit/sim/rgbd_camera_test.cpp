// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/rgbd_camera.hpp>

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

namespace vantage {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();

Scene floor_of(float s, float grey = 0.5F) {
  Scene scene;
  scene.mesh.vertices = {{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}};
  scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.classes = {"unknown", "floor"};
  scene.label = {1, 1};
  scene.materials = {{.name = "grey", .colour = Eigen::Vector3f::Constant(grey)}};
  return scene;
}

RgbdConfig exact(double max_depth_m = infinity) {
  return {.camera = Camera::from_fov(160, 120, deg(60)),
          .depth_noise = 0,
          .max_depth_m = max_depth_m,
          .renderer = {.lighting = Lighting::none()}};
}

template <class T>
bool same(const Image<T>& a, const Image<T>& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(T)) == 0;
}
bool same(const Frame& a, const Frame& b) {
  return same(a.colour.r, b.colour.r) && same(a.colour.g, b.colour.g) && same(a.colour.b, b.colour.b) &&
         same(a.depth, b.depth) && same(a.labels, b.labels);
}

TEST(RgbdCamera, WithoutNoiseShowsWhatIsThere) {
  const RgbdCamera camera(floor_of(100), exact());
  const Frame frame = camera.capture(nadir(1, 2, 3), Rng(1));
  frame.validate("test");
  EXPECT_TRUE(frame.view.T_W_C.isApprox(nadir(1, 2, 3).T_W_C));
  EXPECT_EQ(frame.camera.width, 160);
  EXPECT_TRUE((frame.depth - 3).abs().maxCoeff() < 1e-5F);
  EXPECT_TRUE((frame.labels == 1).all());
  EXPECT_TRUE((frame.colour.r == 0.5F).all() && (frame.colour.b == 0.5F).all());
}

TEST(RgbdCamera, DepthNoiseGrowsWithDepth) {
  RgbdConfig config = exact();
  config.depth_noise = 0.02;
  const RgbdCamera camera(floor_of(100), config);
  for (const double height : {1.0, 4.0}) {
    const Frame frame = camera.capture(nadir(0, 0, height), Rng(1));
    const Eigen::ArrayXXd error = frame.depth.cast<double>() - height;
    const auto n = static_cast<double>(error.size());
    const double sigma = 0.02 * height;
    EXPECT_NEAR(error.mean(), 0, 5 * sigma / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(error.square().mean()), sigma, 5 * sigma / std::sqrt(2 * n));
    EXPECT_TRUE((frame.labels == 1).all() && (frame.colour.r == 0.5F).all());  // of depth only
  }
}

TEST(RgbdCamera, ColourNoiseIsClampedAndIndependentBetweenChannels) {
  RgbdConfig config = exact();
  config.colour_noise = 0.05;
  const Frame grey = RgbdCamera(floor_of(100), config).capture(nadir(0, 0, 2), Rng(1));
  const Eigen::ArrayXXd r = grey.colour.r.cast<double>() - 0.5, g = grey.colour.g.cast<double>() - 0.5,
                        b = grey.colour.b.cast<double>() - 0.5;
  const auto n = static_cast<double>(r.size());
  for (const Eigen::ArrayXXd* x : {&r, &g, &b}) {
    EXPECT_NEAR(x->mean(), 0, 5 * 0.05 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(x->square().mean()), 0.05, 5 * 0.05 / std::sqrt(2 * n));
  }
  EXPECT_NEAR((r * g).mean(), 0, 5 * 0.0025 / std::sqrt(n));
  EXPECT_NEAR((g * b).mean(), 0, 5 * 0.0025 / std::sqrt(n));
  EXPECT_TRUE((grey.depth - 2).abs().maxCoeff() < 1e-5F);

  const Frame white = RgbdCamera(floor_of(100, 1), config).capture(nadir(0, 0, 2), Rng(1));
  white.validate("test");
  EXPECT_NEAR((white.colour.r == 1.F).cast<double>().mean(), 0.5, 0.03);
}

TEST(RgbdCamera, ReadingsOutOfRangeHaveNoValue) {
  const Camera camera = Camera::from_fov(160, 120, deg(60));
  RgbdConfig config = exact(5);
  config.min_depth_m = 1;
  const RgbdCamera sensor(floor_of(100), config);
  EXPECT_TRUE(sensor.capture(nadir(0, 0, 5.001), Rng(1)).depth.isNaN().all());
  EXPECT_TRUE((sensor.capture(nadir(0, 0, 4.999), Rng(1)).depth > 4.9F).all());
  EXPECT_TRUE((sensor.capture(nadir(0, 0, 1.001), Rng(1)).depth > 1.F).all());
  EXPECT_TRUE(sensor.capture(nadir(0, 0, 0.999), Rng(1)).depth.isNaN().all());
  const Frame far = sensor.capture(nadir(0, 0, 9), Rng(1));
  EXPECT_TRUE((far.labels == 1).all() && (far.colour.g == 0.5F).all());  // seen, though not measured

  config.depth_noise = 0.01;  // at the limit a half of the readings is above; none that is may pass
  const Frame limit = RgbdCamera(floor_of(100), config).capture(nadir(0, 0, 5), Rng(1));
  limit.validate("test");
  EXPECT_NEAR(limit.depth.isNaN().cast<double>().mean(), 0.5, 0.02);
  EXPECT_TRUE((limit.depth.isNaN() || limit.depth <= 5.F).all());
  EXPECT_EQ(limit.depth.cols(), camera.width);
}

TEST(RgbdCamera, OpenScenesHaveABackground) {
  RgbdConfig config;
  config.camera = Camera::from_fov(64, 64, deg(90));
  config.renderer.background = {0.2F, 0.3F, 0.4F};
  const Frame frame = RgbdCamera(floor_of(1), config).capture(nadir(0, 0, 2), Rng(1));
  frame.validate("test");
  EXPECT_EQ(frame.labels(0, 0), 0);
  EXPECT_TRUE(std::isnan(frame.depth(0, 0)));
  EXPECT_EQ(frame.colour.g(0, 0), 0.3F);
  EXPECT_EQ(frame.labels(32, 32), 1);
  const Frame sky = RgbdCamera(floor_of(1), config).capture(look_at({0, 0, 2}, {0, 0, 3}), Rng(1));
  EXPECT_TRUE(sky.depth.isNaN().all() && (sky.labels == 0).all());
}

TEST(RgbdCamera, NoiseIsAFunctionOfSeedAndView) {
  RgbdConfig config = exact();
  config.depth_noise = config.colour_noise = 0.01;
  const RgbdCamera camera(floor_of(100), config), twin(floor_of(100), config);
  const View here = nadir(0, 0, 2), there = nadir(0, 1e-12, 2);
  const Frame first = camera.capture(here, Rng(1));
  EXPECT_FALSE(same(camera.capture(there, Rng(1)).depth, first.depth));
  EXPECT_TRUE(same(camera.capture(here, Rng(1)), first));  // whatever was looked at between
  EXPECT_TRUE(same(twin.capture(here, Rng(1)), first));
  EXPECT_FALSE(same(camera.capture(here, Rng(2)).depth, first.depth));
  View minus_zero = here;
  minus_zero.T_W_C.translation().x() = -0.0;
  EXPECT_TRUE(same(camera.capture(minus_zero, Rng(1)), first));
  Frame used;  // of another size before
  used.depth.resize(3, 3);
  camera.capture(here, Rng(1), used);
  EXPECT_TRUE(same(used, first));
  const tbb::global_control eight(tbb::global_control::max_allowed_parallelism, 8);
  for (const int threads : {1, 2, 8}) {
    tbb::task_arena arena(threads);
    EXPECT_TRUE(same(arena.execute([&] { return camera.capture(here, Rng(1)); }), first));
  }
}

TEST(RgbdCamera, PresetsAreWhatTheChaptersSay) {
  const RgbdConfig rooms;
  EXPECT_EQ(rooms.camera.width, 512);
  EXPECT_NEAR(2 * std::atan(256 / rooms.camera.fx), deg(60), 1e-12);
  EXPECT_EQ(rooms.depth_noise, 0.01);
  EXPECT_EQ(rooms.max_depth_m, 5);
  EXPECT_EQ(RgbdConfig::image_based().camera.fx, 400);
  EXPECT_NEAR(RgbdConfig::semantic().camera.fx, 366.1, 0.05);
  for (const RgbdConfig& config : {RgbdConfig{}, RgbdConfig::image_based(), RgbdConfig::semantic()})
    RgbdCamera(floor_of(100), config).capture(nadir(0, 0, 2), Rng(1)).validate("test");
}

TEST(RgbdCamera, RefusesBadInput) {
  const Scene scene = floor_of(1);
  const auto refused = [&](const RgbdConfig& config, const std::string& name) {
    try {
      const RgbdCamera camera(scene, config);
    } catch (const Error& e) { return std::string(e.what()).find(name) != std::string::npos; }
    return false;
  };
  EXPECT_TRUE(refused({.camera = {0, 3, 1, 1, 1, 1}}, "width"));
  EXPECT_TRUE(refused({.camera = {3, 3, nan, 1, 1, 1}}, "fx"));
  EXPECT_TRUE(refused({.depth_noise = -1}, "depth_noise"));
  EXPECT_TRUE(refused({.depth_noise = nan}, "depth_noise"));
  EXPECT_TRUE(refused({.min_depth_m = 6}, "max_depth_m"));
  EXPECT_TRUE(refused({.max_depth_m = nan}, "max_depth_m"));
  EXPECT_TRUE(refused({.colour_noise = infinity}, "colour_noise"));
  EXPECT_THROW(RgbdCamera(Scene{}), Error);
  const RgbdCamera camera(scene);
  EXPECT_THROW((void)camera.capture(nadir(nan, 0, 1), Rng(1)), Error);
}

}  // namespace
}  // namespace vantage
