// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/sim/footprint.hpp>
#include <vantage/sim/furniture.hpp>
#include <vantage/sim/room_shell.hpp>
#include <vantage/sim/scene_builder.hpp>

namespace vantage {

struct RoomConfig {
  Eigen::Vector3d size_m = {6, 5, 2.6};  ///< of each room, inside: 3 to 30 m, 3 to 30 m, 2.4 to 6 m
  int rooms_x = 1, rooms_y = 1;          ///< a grid of rooms that doorways connect; 1 to 8 each way
  int pieces = 14;                       ///< of furniture in each room, at most: 0 to 100; fewer if it is full
  double edge_m = 0.25;  ///< longest edge of a flat face's triangles: 0.02 to infinity; 0.04 makes 200 k

  void validate() const {
    Check check("RoomConfig");
    const auto within = [](double x, double low, double high) { return x >= low && x <= high; };
    check(within(size_m.x(), 3, 30) && within(size_m.y(), 3, 30), "size_m", size_m.transpose(), "3 to 30 m each way");
    check(within(size_m.z(), 2.4, 6), "size_m.z", size_m.z(), "2.4 to 6 m");
    check(rooms_x >= 1 && rooms_x <= 8, "rooms_x", rooms_x, "1 to 8");
    check(rooms_y >= 1 && rooms_y <= 8, "rooms_y", rooms_y, "1 to 8");
    check(pieces >= 0 && pieces <= 100, "pieces", pieces, "0 to 100");
    check(edge_m >= 0.02, "edge_m", edge_m, "at least 0.02 m");
    check.done();
  }
};

/// A furnished room, or several. The scene's start is free: nothing lies within half a metre of it, and it looks across
/// the first room.
struct Room {
  /// A piece that stands on the floor: its triangles are [first, end), inside of footprint x [0, height_m].
  struct Placed {
    std::string name;
    Footprint footprint;
    double height_m;
    std::size_t first_triangle, end_triangle;
  };
  Scene scene;
  std::vector<Placed> furniture;
};

namespace detail {

/// Furnishes one room of a home.
class RoomMaker {
 public:
  RoomMaker(SceneBuilder& b, const Box2& area, const RoomConfig& config, Rng rng)
      : b_(b),
        area_(area),
        config_(config),
        rng_(rng),
        palette_(b, rng.fork(0)),
        shell_(b, config.size_m.z(), rng.fork(1)),
        walls_(procedural::walls_around(area)) {}

  std::array<procedural::Wall, 4>& walls() { return walls_; }

  /// `first`: which of the catalogue comes first.
  void make(bool entrance, std::size_t first, std::vector<Room::Placed>& furniture) {
    shell_.floor_and_ceiling(area_);
    const std::uint64_t accent = rng_.index(4);
    for (std::size_t i = 0; i < 4; ++i) {
      shell_.wall(walls_[i], i == accent);
      if (walls_[i].doorway_m) keep_free(walls_[i], *walls_[i].doorway_m + procedural::door_width_m / 2);
    }
    for (int attempt = 0; entrance && attempt < 20; ++attempt) {
      procedural::Wall& w = random_outer_wall();
      if (!shell_.door(w)) continue;
      keep_free(w, (w.taken.back().from + w.taken.back().to) / 2);
      break;
    }
    for (int attempt = 0, windows = 0; attempt < 8 && windows < 2; ++attempt)
      if (procedural::Wall& w = random_outer_wall(); w.outer && shell_.window(w)) ++windows;

    const Eigen::Vector2d inner = area_.sizes() / 2 - Eigen::Vector2d::Constant(0.7);  // where a robot may begin
    start_ = area_.center() + 0.6 * inner.cwiseProduct(Eigen::Vector2d(rng_.uniform(-1, 1), rng_.uniform(-1, 1)));
    taken_.push_back({start_, Eigen::Vector2d::Constant(0.5)});
    const auto& catalogue = procedural::catalogue();
    for (std::size_t i = 0; i < static_cast<std::size_t>(config_.pieces); ++i)
      place(catalogue[(first + i) % catalogue.size()], furniture);
    for (int attempt = 0, pictures = 0; attempt < 20 && pictures < 4; ++attempt)
      if (shell_.picture(walls_[rng_.index(4)])) ++pictures;
  }

  /// Across the room, to the corner that is farthest.
  [[nodiscard]] View start() const {
    Eigen::Vector2d far = start_;
    for (const auto corner : {Box2::BottomLeft, Box2::BottomRight, Box2::TopLeft, Box2::TopRight})
      if ((area_.corner(corner) - start_).norm() > (far - start_).norm()) far = area_.corner(corner);
    return look_at({start_.x(), start_.y(), 1.4}, {far.x(), far.y(), 0.9});
  }

 private:
  procedural::Wall& random_outer_wall() {
    procedural::Wall* w = &walls_[rng_.index(4)];
    for (int i = 0; i < 8 && !w->outer; ++i) w = &walls_[rng_.index(4)];
    return *w;
  }
  void keep_free(const procedural::Wall& w, double s_m) {
    const double half = procedural::door_width_m / 2 + 0.1;
    taken_.push_back({w.start + s_m * w.along + half * w.inward, {half, half}, std::atan2(w.along.y(), w.along.x())});
  }
  [[nodiscard]] bool free(const Footprint& f, double margin_m) const {
    return std::all_of(taken_.begin(), taken_.end(),
                       [&](const Footprint& other) { return gap_m(f, other) > margin_m; });
  }

  void place(const procedural::Piece& piece, std::vector<Room::Placed>& furniture) {
    const Eigen::Vector3d size = piece.size * rng_.uniform(0.94, 1.06);
    for (int attempt = 0; attempt < 200; ++attempt) {
      Footprint f{{0, 0}, size.head<2>() / 2, 0};
      if (piece.at_wall) {
        procedural::Wall& w = walls_[rng_.index(4)];
        const double s = rng_.uniform(size.x() / 2, std::max(size.x() / 2, w.length_m - size.x() / 2));
        const procedural::Wall::Taken t{s - size.x() / 2, s + size.x() / 2, 0, size.z()};
        f.yaw_rad = std::atan2(w.along.y(), w.along.x());
        f.centre = w.start + s * w.along + (size.y() / 2 + procedural::skirting_m + 0.02) * w.inward;
        if (!w.free(t) || !inside(f, 0.02) || !free(f, 0.05)) continue;
        w.taken.push_back(t);
      } else {
        f.centre = {rng_.uniform(area_.min().x(), area_.max().x()), rng_.uniform(area_.min().y(), area_.max().y())};
        f.yaw_rad = 0.5 * std::numbers::pi * static_cast<double>(rng_.index(4)) + rng_.uniform(-0.25, 0.25);
        if (!inside(f, 0.12) || !free(f, 0.12)) continue;
      }
      taken_.push_back(f);
      b_.pose = f.pose();
      const std::size_t first = b_.scene().mesh.triangles.size();
      Rng own = rng_.fork(taken_.size());
      piece.draw(b_, palette_, size, own);
      furniture.push_back({piece.name, f, size.z(), first, b_.scene().mesh.triangles.size()});
      return;
    }
  }
  [[nodiscard]] bool inside(const Footprint& f, double margin_m) const {
    const Box2 box = f.bounds();
    return (box.min().array() > area_.min().array() + margin_m).all() &&
           (box.max().array() < area_.max().array() - margin_m).all();
  }

  SceneBuilder& b_;
  Box2 area_;
  const RoomConfig& config_;
  Rng rng_;
  procedural::Palette palette_;
  procedural::RoomShell shell_;
  std::array<procedural::Wall, 4> walls_;
  std::vector<Footprint> taken_;
  Eigen::Vector2d start_;
};

}  // namespace detail

/// A seeded furnished room, or a grid of rooms with doorways between neighbours; needs no file. Floor at z = 0, the
/// origin in the middle of the floor plan. Closed: no ray from inside leaves it. Furniture does not interpenetrate and
/// leaves doors free. Classes: floor, ceiling, wall, door, window, picture, lamp, and those of the furniture. Throws
/// Error for a bad configuration. O(triangles).
inline Room procedural_room(const RoomConfig& config, const Rng& rng) {
  config.validate();
  using procedural::wall_thickness_m;
  const Eigen::Vector2d size = config.size_m.head<2>(), pitch = size.array() + wall_thickness_m;
  const Eigen::Vector2d whole(pitch.x() * config.rooms_x - wall_thickness_m,
                              pitch.y() * config.rooms_y - wall_thickness_m);
  SceneBuilder builder(config.edge_m);
  Room room;
  View start;
  for (int j = 0; j < config.rooms_y; ++j)
    for (int i = 0; i < config.rooms_x; ++i) {
      const Eigen::Vector2d low = -whole / 2 + Eigen::Vector2d(i, j).cwiseProduct(pitch);
      const auto index =
          static_cast<std::uint64_t>(j) * static_cast<std::uint64_t>(config.rooms_x) + static_cast<std::uint64_t>(i);
      detail::RoomMaker maker(builder, Box2(low, low + size), config, rng.fork(index));
      // A doorway to the right and one upwards: both rooms draw the same number for it, and measure it from either end.
      const auto doorway = [&](std::size_t side, bool exists, std::uint64_t owner, bool from_end) {
        procedural::Wall& w = maker.walls()[side];
        w.outer = !exists;
        if (!exists) return;
        const double room_for_it = w.length_m - procedural::door_width_m - 0.4;
        const double s = 0.2 + room_for_it * rng.fork(1000 + 2 * owner + side % 2).uniform();
        w.doorway_m = from_end ? w.length_m - procedural::door_width_m - s : s;
      };
      const auto columns = static_cast<std::uint64_t>(config.rooms_x);
      doorway(1, i + 1 < config.rooms_x, index, false);
      doorway(3, i > 0, index - 1, true);
      doorway(2, j + 1 < config.rooms_y, index, false);
      doorway(0, j > 0, index - columns, true);
      maker.make(index == 0, index % 2 == 0 ? 0 : 8, room.furniture);  // living room, bedroom
      if (index == 0) start = maker.start();
    }
  room.scene = std::move(builder).take();
  room.scene.start = start;
  return room;
}

}  // namespace vantage
