// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/maps/voxel/with_sides.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/geometry/look_around.hpp>

#include "message_of.hpp"
#include "voxel_scenes.hpp"

namespace vantage {
namespace {

using test::small_room;
using Map = WithSides<>;

const Camera camera = Camera::from_fov(64, 64, deg(60));

Map room_map() { return Map({.bounds = small_room, .voxel_m = 0.1, .clearance_m = 0.15}); }
/// Towards the ball, which is at (0.4, 0.2, 0.6).
View towards_ball(const Eigen::Vector3d& eye) { return look_at(eye, {0.4, 0.2, 0.6}); }
const View front = towards_ball({-0.8, 0.2, 0.6}), above = towards_ball({-0.5, 0.5, 1.3});

std::vector<std::byte> bytes_of(const Map& map) {
  Sink sink;
  map.save(sink);
  return std::move(sink).take();
}

TEST(WithSides, WhatWasSeenIsNotUnseenAnyMore) {
  Map map = room_map();
  EXPECT_FALSE(map.unseen_sides(front, camera, 5).empty());  // all that is unknown has sides
  map.integrate(test::observe_room(front, camera));
  EXPECT_TRUE(map.unseen_sides(front, camera, 5).empty());
  for (const View& view : look_all_around(front, deg(60))) map.integrate(test::observe_room(view, camera));
  EXPECT_GT(map.unseen_sides(above, camera, 5).size(), 100U);  // of what is known, from elsewhere
}

TEST(WithSides, ASideIsAVoxelFromADirection) {
  Map map = room_map();
  map.integrate(test::observe_room(front, camera));
  const Eigen::Vector3i facing = map.grid().voxel_at({0.06, 0.21, 0.61});
  ASSERT_EQ(map.state(facing), Space::occupied);
  // From -x, a little above or below, to the left or to the right: four of the 24 directions, no other.
  EXPECT_NE(map.seen_from(facing), 0U);
  std::uint32_t allowed = 0;
  for (const int octant : {0, 2, 4, 6}) allowed |= std::uint32_t{1} << 3 * octant;
  EXPECT_EQ(map.seen_from(facing) & ~allowed, 0U);
  EXPECT_EQ(map.seen_from({-1, 0, 0}), 0U);
  EXPECT_EQ(map.seen_from({0, 0, 100000}), 0U);
}

TEST(WithSides, NamesAreInOrderAndTheSameInEveryView) {
  Map map = room_map();
  for (const View& view : look_all_around(front, deg(60))) map.integrate(test::observe_room(view, camera));
  const auto one = map.unseen_sides(above, camera, 5), again = map.unseen_sides(above, camera, 5);
  EXPECT_EQ(one, again);
  EXPECT_GT(one.size(), 100U);
  EXPECT_TRUE(std::ranges::is_sorted(one));
  EXPECT_EQ(std::set(one.begin(), one.end()).size(), one.size());
  // A camera that sees half of the picture names no others; one that sees no farther than 10 cm, none.
  Camera left = camera;
  left.width /= 2;
  const auto part = map.unseen_sides(above, left, 5);
  EXPECT_LT(part.size(), one.size());
  EXPECT_TRUE(std::ranges::includes(one, part));
  EXPECT_TRUE(map.unseen_sides(front, camera, 0.1).empty());
}

TEST(WithSides, OccupancyIsTheBases) {
  Map map = room_map();
  VoxelMap<> base(map.config());
  for (std::uint64_t k = 0; k < 4; ++k) {
    const Frame f = test::random_frame(Rng(k));
    map.integrate(f);
    base.integrate(f);
  }
  ASSERT_EQ(map.known_blocks().size(), base.known_blocks().size());
  for (const Eigen::Vector3i& block : base.known_blocks()) {
    EXPECT_EQ(map.free_in(block), base.free_in(block));
    EXPECT_EQ(map.occupied_in(block), base.occupied_in(block));
  }
  EXPECT_GT(map.bytes(), base.bytes());
}

TEST(WithSides, ALargeFrameIsSeenByEverySoManyRays) {
  // What a view of few pixels would see is seen with a frame of many.
  Map map = room_map();
  map.integrate(test::observe_room(front, Camera::from_fov(300, 300, deg(60))));
  EXPECT_LT(map.unseen_sides(front, camera, 5).size(), 10U);
}

TEST(WithSides, ComesBackFromDisk) {
  Map map = room_map();
  for (std::uint64_t k = 0; k < 3; ++k) map.integrate(test::random_frame(Rng(k)));
  const std::vector<std::byte> saved = bytes_of(map);
  Map loaded = room_map();
  Source source(saved, "memory");
  loaded.load(source);
  EXPECT_EQ(bytes_of(loaded), saved);
  EXPECT_EQ(loaded.unseen_sides(above, camera, 5), map.unseen_sides(above, camera, 5));
}

TEST(WithSides, RefusesWhatItDidNotWriteAndStaysAsItWas) {
  Map map = room_map();
  map.integrate(test::random_frame(Rng(1)));
  const std::vector<std::byte> good = bytes_of(map);
  const VoxelMap<>& base = map;
  Sink of_base;
  base.save(of_base);
  const std::size_t sides = std::move(of_base).take().size();  // where the number of blocks stands
  const auto with = [&](std::size_t at, std::uint8_t value) {
    std::vector<std::byte> bad = good;
    bad.at(at) = std::byte{value};
    return bad;
  };
  Map other = room_map();
  const std::vector<std::byte> before = bytes_of(other);
  const auto load = [&](std::vector<std::byte> bytes) {
    return test::message_of([&] {
      Source source(bytes, "a file");
      other.load(source);
    });
  };
  EXPECT_NE(load(with(sides + 8 + 3, 0x7F)).find("blocks of the grid"), std::string::npos);   // far away
  EXPECT_NE(load(with(sides + 8 + 12 + 8 + 3, 0xFF)).find("directions"), std::string::npos);  // of the 32nd direction
  EXPECT_NE(load(std::vector<std::byte>(good.begin(), good.end() - 1)), "");                  // cut off
  EXPECT_EQ(bytes_of(other), before);
}

}  // namespace
}  // namespace vantage
