// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/maps/surfel/surfel_mesh.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/core/units.hpp>
#include <vantage/maps/surfel/surfel_presets.hpp>

#include "message_of.hpp"
#include "voxel_scenes.hpp"

// The surface that renderings show: of a room that draws itself, to the voxel, and of a map that has learned it.
namespace vantage::test {
namespace {

const Eigen::Vector3d eye(-0.6, -0.3, 0.8), ball(0.4, 0.2, 0.6);
constexpr double ball_radius_m = 0.35;
constexpr int size_px = 128;

/// The small room with its ball, as exact as a map can be. The ball is more or less opaque, the rest is; a speck half a
/// metre before the camera is.
struct DrawnRoom : archetype::Map {
  struct Taken {
    Camera camera;
    View view;
  };
  std::vector<Taken> taken;
  float ball_opacity = 1;
  bool has_speck = false;

  [[nodiscard]] const std::vector<Taken>& frames() const { return taken; }
  void render(const View& view, const Camera& camera,
              Rendering<channel::Colour, channel::Depth, channel::Opacity>& out) const {
    const Frame seen = observe_room(view, camera), walls = observe(Cuboid{small_room}, view, camera, small_room);
    static_cast<ColourImage&>(out) = seen.colour;
    out.depth = seen.depth;
    out.opacity.setOnes(camera.height, camera.width);
    for (Eigen::Index k = 0; k < out.depth.size(); ++k)
      if (seen.depth.data()[k] < walls.depth.data()[k]) out.opacity.data()[k] = ball_opacity;
    if (!has_speck) return;
    out.depth.block(size_px / 2 - 20, size_px / 2 - 20, 40, 40).setConstant(0.5F);
    out.opacity.block(size_px / 2 - 20, size_px / 2 - 20, 40, 40).setOnes();
  }
};
static_assert(Renders<DrawnRoom, channel::Colour, channel::Depth, channel::Opacity>);

std::vector<View> all_around() {
  std::vector<View> views;
  for (int turn = 0; turn < 360; turn += 30)
    for (const double up : {-1.5, -0.6, 0.0, 0.6, 1.5})
      views.push_back(look_at(eye, eye + Eigen::Vector3d(std::cos(deg(turn)), std::sin(deg(turn)), up)));
  for (const double z : {-1.0, 1.0}) views.push_back(look_at(eye, eye + Eigen::Vector3d(0, 0, z)));
  return views;
}
DrawnRoom drawn_room(const std::vector<View>& views) {
  DrawnRoom room;
  for (const View& view : views) room.taken.push_back({Camera::from_fov(size_px, size_px, deg(70)), view});
  return room;
}
double from_walls_m(const Eigen::Vector3f& vertex) {
  const Eigen::Array3d p = vertex.cast<double>().array();
  return std::min((p - small_room.min().array()).abs().minCoeff(), (p - small_room.max().array()).abs().minCoeff());
}
double from_ball_m(const Eigen::Vector3f& vertex) {
  return std::abs((vertex.cast<double>() - ball).norm() - ball_radius_m);
}

constexpr SurfelMeshConfig coarse = {.voxel_m = 0.05, .truncation_m = 0.15};

TEST(SurfelMesh, IsWhereItIsOpaque) {
  DrawnRoom room = drawn_room(all_around());
  room.ball_opacity = 0.6F;
  const TriangleMesh both = surfel_mesh(room, small_room, coarse);
  EXPECT_EQ(both.colours.size(), both.vertices.size());
  std::size_t of_ball = 0;
  for (const Eigen::Vector3f& v : both.vertices) {
    EXPECT_LT(std::min(from_walls_m(v), from_ball_m(v)), 3 * coarse.voxel_m) << v.transpose();
    of_ball += from_ball_m(v) < coarse.voxel_m;
  }
  EXPECT_GT(of_ball, 100U);

  room.ball_opacity = 0.5F;
  const TriangleMesh walls = surfel_mesh(room, small_room, coarse);
  EXPECT_GT(walls.triangles.size(), 10'000U);
  for (const Eigen::Vector3f& v : walls.vertices) EXPECT_LT(from_walls_m(v), 2 * coarse.voxel_m) << v.transpose();
}

TEST(SurfelMesh, LeavesCrumbsOut) {
  const View view = look_at(eye, {1.4, -0.3, 0.8});
  DrawnRoom room = drawn_room({view});
  room.ball_opacity = 0;
  room.has_speck = true;
  const Eigen::Vector3f speck = (eye + 0.5 * view.forward()).cast<float>();
  const auto at_speck = [&](std::size_t least_triangles) {
    SurfelMeshConfig config = coarse;
    config.least_triangles = least_triangles;
    const TriangleMesh mesh = surfel_mesh(room, small_room, config);
    EXPECT_GT(mesh.triangles.size(), 1000U) << "the wall";
    return std::ranges::count_if(mesh.vertices, [&](const Eigen::Vector3f& v) { return (v - speck).norm() < 0.3F; });
  };
  EXPECT_GT(at_speck(1), 0);
  EXPECT_EQ(at_speck(1000), 0);
}

TEST(SurfelMesh, OfAMapThatLearned) {
  ActiveGsMap<>::Config config = surfel_config<ActiveGsMap<>>(small_room);
  config.voxels.voxel_m = 0.1;
  config.iterations = 5;
  ActiveGsMap<> map(config);
  const Camera camera = Camera::from_fov(64, 64, deg(70));
  Rng rng(1);
  for (int k = 0; k < 8; ++k) {
    const double heading = deg(45.0 * k);
    const View view = look_at(eye, eye + Eigen::Vector3d(std::cos(heading), std::sin(heading), -0.1));
    map.integrate(observe(Cuboid{small_room}, view, camera, small_room), rng);
  }
  const TriangleMesh mesh = surfel_mesh(map, small_room, coarse);
  EXPECT_GT(mesh.triangles.size(), 1000U);
  const auto near = std::ranges::count_if(
      mesh.vertices, [](const Eigen::Vector3f& v) { return from_walls_m(v) < 2 * coarse.voxel_m; });
  EXPECT_GT(static_cast<double>(near), 0.9 * static_cast<double>(mesh.vertices.size()));
}

TEST(SurfelMesh, NothingSeenIsNoSurface) {
  EXPECT_TRUE(surfel_mesh(DrawnRoom{}, small_room, coarse).empty());
  EXPECT_TRUE(surfel_mesh(ActiveGsMap<>(surfel_config<ActiveGsMap<>>(small_room)), small_room, coarse).empty());
}

TEST(SurfelMesh, RefusesABadConfig) {
  const DrawnRoom room{};
  EXPECT_REFUSED(surfel_mesh(room, small_room, {.voxel_m = 0}), "voxel_m");
  EXPECT_REFUSED(surfel_mesh(room, small_room, {.voxel_m = 0.2, .truncation_m = 0.1}), "truncation_m");
  EXPECT_REFUSED(surfel_mesh(room, small_room, {.least_opacity = 1}), "least_opacity");
  EXPECT_REFUSED(surfel_mesh(room, Box3(), coarse), "bounds");
  EXPECT_REFUSED(surfel_mesh(room, small_room, {.max_bytes = 1000}), "bytes");
}

}  // namespace
}  // namespace vantage::test
