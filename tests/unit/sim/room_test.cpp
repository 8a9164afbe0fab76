// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/room.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/sim/ray_scene.hpp>

namespace vantage {
namespace {

Eigen::Vector3d direction(Rng& rng) {
  const double z = rng.uniform(-1, 1), angle = rng.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

TEST(Footprint, GapsAreThoseOfRectangles) {
  const Footprint a{{0, 0}, {1, 2}}, beside{{3, 0}, {1, 1}}, turned{{3, 0}, {1, 1}, std::numbers::pi / 4};
  EXPECT_DOUBLE_EQ(gap_m(a, beside), 1);
  EXPECT_NEAR(gap_m(a, turned), 2 - std::sqrt(2.0), 1e-12);
  EXPECT_DOUBLE_EQ(gap_m(beside, a), gap_m(a, beside));
  EXPECT_LT(gap_m(a, {{1.5, 0}, {1, 1}}), 0);
  // The boxes around both overlap; the rectangles do not.
  const Footprint thin{{0, 0}, {3, 0.1}, std::numbers::pi / 4}, other{{1, -1}, {0.5, 0.5}, std::numbers::pi / 4};
  EXPECT_TRUE(thin.bounds().intersects(other.bounds()));
  EXPECT_NEAR(gap_m(thin, other), std::sqrt(2.0) - 0.6, 1e-12);
}

// Several sizes, grids and seeds.
std::vector<Room> rooms() {
  std::vector<Room> all;
  for (std::uint64_t seed = 0; seed < 3; ++seed)
    for (const RoomConfig& config : {RoomConfig{}, RoomConfig{.size_m = {3, 3, 2.4}, .edge_m = 1},
                                     RoomConfig{.size_m = {12, 7, 3}, .pieces = 40, .edge_m = 0.5},
                                     RoomConfig{.size_m = {4.5, 4, 2.5}, .rooms_x = 2, .rooms_y = 2, .edge_m = 0.5}})
      all.push_back(procedural_room(config, Rng(seed)));
  return all;
}

TEST(Room, IsAValidClosedScene) {
  for (const Room& room : rooms()) {
    room.scene.validate("test");
    ASSERT_TRUE(room.scene.start);
    const RayScene rays(room.scene);
    Rng rng(1);
    for (int i = 0; i < 20000; ++i) {
      // From the start, and from where a first ray has led: along walls, out of doorways, below tables.
      Ray ray{room.scene.start->position(), direction(rng)};
      const auto hit = rays.cast(ray);
      ASSERT_TRUE(hit) << "ray " << i;
      ray.origin += (hit->distance_m - 1e-3) * ray.direction;
      if (hit->distance_m < 0.01) continue;
      ray.direction = direction(rng);
      ASSERT_TRUE(rays.cast(ray)) << "second ray " << i;
    }
  }
}

TEST(Room, FurnitureStaysInItsFootprintAndApart) {
  for (const Room& room : rooms()) {
    for (std::size_t i = 0; i < room.furniture.size(); ++i) {
      const Room::Placed& piece = room.furniture[i];
      const Eigen::Isometry3d to_piece = piece.footprint.pose().inverse();
      ASSERT_LT(piece.first_triangle, piece.end_triangle);
      for (std::size_t t = piece.first_triangle; t < piece.end_triangle; ++t)
        for (const Eigen::Vector3d& corner : room.scene.mesh.corners(t)) {
          const Eigen::Vector3d p = to_piece * corner;
          ASSERT_LE(std::abs(p.x()), piece.footprint.half.x() + 1e-5) << piece.name << p.transpose();
          ASSERT_LE(std::abs(p.y()), piece.footprint.half.y() + 1e-5) << piece.name << p.transpose();
          ASSERT_GE(p.z(), -1e-6) << piece.name;
          ASSERT_LE(p.z(), piece.height_m + 1e-5) << piece.name;
        }
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(gap_m(piece.footprint, room.furniture[j].footprint), 0)
            << piece.name << " and " << room.furniture[j].name;
      const Eigen::Vector2d start = room.scene.start->position().head<2>();
      EXPECT_GT(gap_m(piece.footprint, {start, {0.5, 0.5}}), 0) << piece.name << " at the start";
    }
  }
}

TEST(Room, StartIsFreeAndLooksAcrossTheRoom) {
  for (const Room& room : rooms()) {
    const RayScene rays(room.scene);
    Rng rng(1);
    for (int i = 0; i < 2000; ++i) {
      Eigen::Vector3d d = direction(rng);
      d.z() = 0;
      EXPECT_FALSE(rays.occluded({room.scene.start->position(), d, 0, 0.49}));
    }
    const Eigen::Vector3d forward = room.scene.start->forward();
    EXPECT_GT(rays.cast({room.scene.start->position(), {forward.x(), forward.y(), 0.15}})->distance_m, 1.0);
  }
}

TEST(Room, DefaultRoomHasManyKindsOfThings) {
  std::set<std::string> names;
  std::size_t pieces = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Room room = procedural_room({}, Rng(seed));
    pieces += room.furniture.size();
    EXPECT_GE(room.furniture.size(), 8U);
    std::set<std::uint16_t> used(room.scene.label.begin(), room.scene.label.end());
    EXPECT_FALSE(used.contains(0));  // everything has a class
    for (const std::uint16_t label : used) names.insert(room.scene.classes[label]);
    for (const char* name : {"floor", "ceiling", "wall", "lamp"})
      EXPECT_TRUE(std::any_of(used.begin(), used.end(), [&](std::uint16_t l) { return room.scene.classes[l] == name; }))
          << name;
  }
  for (const char* name :
       {"door", "window", "picture", "table", "chair", "sofa", "armchair", "bookcase", "cabinet", "box", "plant"})
    EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Room, SeedsRepeatAndDiffer) {
  const auto bytes = [](const Scene& s) {
    std::vector<std::byte> all(s.mesh.vertices.size() * 12);
    std::memcpy(all.data(), s.mesh.vertices.data(), all.size());
    return all;
  };
  const Scene a = procedural_room({}, Rng(1)).scene, b = procedural_room({}, Rng(1)).scene,
              c = procedural_room({}, Rng(2)).scene;
  EXPECT_EQ(bytes(a), bytes(b));
  EXPECT_TRUE(a.textures[3].rgb == b.textures[3].rgb && a.start->T_W_C.isApprox(b.start->T_W_C));
  EXPECT_NE(bytes(a), bytes(c));
}

TEST(Room, DetailIsChosen) {
  const auto triangles = [](double edge_m) {
    return procedural_room({.edge_m = edge_m}, Rng(1)).scene.mesh.triangles.size();
  };
  const std::size_t coarse = triangles(std::numeric_limits<double>::infinity()), fine = triangles(0.04);
  EXPECT_LT(coarse, 15000U);
  EXPECT_GT(fine, 200000U);
}

TEST(Room, RoomsOfAGridSeeEachOtherThroughDoorways) {
  const Room room = procedural_room({.size_m = {4, 4, 2.5}, .rooms_x = 2, .rooms_y = 1, .pieces = 0}, Rng(3));
  const RayScene rays(room.scene);
  int through = 0;
  for (int i = 0; i < 4000; ++i) {  // horizontally through the wall between, at x = 0
    const double y = -2 + 4 * (i + 0.5) / 4000;
    const auto hit = rays.cast({{-1, y, 1.5}, {1, 0, 0}});
    ASSERT_TRUE(hit);
    if (hit->distance_m > 1.2) ++through;
  }
  EXPECT_NEAR(through / 1000.0, procedural::door_width_m, 0.01);
}

TEST(Room, RefusesBadConfigurations) {
  const auto refused = [](const RoomConfig& config, const std::string& name) {
    try {
      procedural_room(config, Rng(1));
    } catch (const Error& e) { return std::string(e.what()).find(name) != std::string::npos; }
    return false;
  };
  EXPECT_TRUE(refused({.size_m = {2, 5, 2.6}}, "size_m"));
  EXPECT_TRUE(refused({.size_m = {6, std::nan(""), 2.6}}, "size_m"));
  EXPECT_TRUE(refused({.size_m = {6, 5, 9}}, "size_m.z"));
  EXPECT_TRUE(refused({.rooms_x = 0}, "rooms_x"));
  EXPECT_TRUE(refused({.rooms_y = 9}, "rooms_y"));
  EXPECT_TRUE(refused({.pieces = -1}, "pieces"));
  EXPECT_TRUE(refused({.edge_m = 0}, "edge_m"));
  EXPECT_TRUE(refused({.edge_m = std::nan("")}, "edge_m"));
}

}  // namespace
}  // namespace vantage
