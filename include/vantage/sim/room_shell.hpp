// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/sim/footprint.hpp>
#include <vantage/sim/procedural_texture.hpp>
#include <vantage/sim/scene_builder.hpp>

namespace vantage::procedural {

inline constexpr double wall_thickness_m = 0.12, door_height_m = 2.05, door_width_m = 0.9, skirting_m = 0.012;

/// One side of a room, seen from inside: a plane above a line on the ground.
struct Wall {
  Eigen::Vector2d start, along, inward;  ///< unit vectors; inward is along turned to the left
  double length_m = 0;
  bool outer = true;
  std::optional<double> doorway_m = std::nullopt;  ///< where an opening into the next room begins

  /// What hangs on the wall or stands before it: from, to along the wall; low, high [m].
  struct Taken {
    double from, to, low, high;
  };
  std::vector<Taken> taken = {};

  [[nodiscard]] bool free(const Taken& t, double margin_m = 0.05) const {
    if (t.from < margin_m || t.to > length_m - margin_m) return false;
    return std::none_of(taken.begin(), taken.end(), [&](const Taken& o) {
      return t.from < o.to + margin_m && o.from < t.to + margin_m && t.low < o.high && o.low < t.high;
    });
  }
  /// The frame of a thing at s along the wall: x along, y inward, z up.
  [[nodiscard]] Eigen::Isometry3d pose(double s_m) const {
    return Footprint{start + s_m * along, {0, 0}, std::atan2(along.y(), along.x())}.pose();
  }
};

/// The four walls around `area`, counter-clockwise, the one towards -y first.
inline std::array<Wall, 4> walls_around(const Box2& area) {
  const Eigen::Vector2d size = area.sizes(), x(1, 0), y(0, 1);
  return {Wall{area.corner(Box2::BottomLeft), x, y, size.x()}, Wall{area.corner(Box2::BottomRight), y, -x, size.y()},
          Wall{area.corner(Box2::TopRight), -x, -y, size.x()}, Wall{area.corner(Box2::TopLeft), -y, x, size.y()}};
}

/// Draws what encloses a room: floor, ceiling, walls with skirting, doors, windows and pictures. Surfaces reach past
/// the corners, so that a room is closed although its sides share no vertices.
class RoomShell {
 public:
  using Look = SceneBuilder::Look;

  RoomShell(SceneBuilder& b, double height_m, Rng rng) : b_(b), height_m_(height_m), rng_(rng) {
    const auto pick = [&](std::initializer_list<Colour> colours) -> Colour {
      return *(colours.begin() + static_cast<std::ptrdiff_t>(rng_.index(colours.size())));
    };
    floor_ = rng_.uniform() < 0.65
                 ? b.textured("floor",
                              planks(pick({{0.78F, 0.58F, 0.38F}, {0.62F, 0.43F, 0.28F}, {0.85F, 0.70F, 0.52F}}), 8,
                                     rng_.fork(1)),
                              1.4)
                 : b.textured("floor",
                              tiles(pick({{0.88F, 0.86F, 0.80F}, {0.80F, 0.72F, 0.62F}}),
                                    pick({{0.38F, 0.40F, 0.42F}, {0.62F, 0.38F, 0.30F}}), 4, rng_.fork(1)),
                              1.6);
    const Colour paint =
        pick({{0.93F, 0.90F, 0.82F}, {0.80F, 0.87F, 0.90F}, {0.90F, 0.84F, 0.78F}, {0.82F, 0.88F, 0.80F}});
    wall_ = b.textured("wall", plaster(paint, rng_.fork(2)), 1.5);
    accent_ =
        rng_.uniform() < 0.5
            ? b.textured("brick wall", bricks(pick({{0.70F, 0.36F, 0.26F}, {0.78F, 0.68F, 0.58F}}), rng_.fork(3)), 1.0)
            : b.textured(
                  "accent wall",
                  plaster(pick({{0.36F, 0.50F, 0.56F}, {0.72F, 0.46F, 0.36F}, {0.45F, 0.54F, 0.40F}}), rng_.fork(3)),
                  1.5);
    ceiling_ = b.textured("ceiling", plaster({0.97F, 0.97F, 0.95F}, rng_.fork(4)), 1.5);
    door_ = b.textured("door", wood({0.68F, 0.47F, 0.30F}, rng_.fork(5)), 0.8);
    outlook_ = b.textured("outlook", outlook(rng_.fork(6)), 0);
    white_ = b.plain("white paint", {0.95F, 0.95F, 0.93F});
    metal_ = b.plain("metal", {0.62F, 0.60F, 0.55F});
  }

  void floor_and_ceiling(const Box2& area) {
    const double lap = wall_thickness_m / 2 + 0.001;
    const Eigen::Vector2d low = area.min().array() - lap, size = area.sizes().array() + 2 * lap;
    b_.pose.setIdentity();
    b_.label = b_.class_of("floor");
    b_.quad({low.x(), low.y(), 0}, {size.x(), 0, 0}, {0, size.y(), 0}, floor_);
    b_.label = b_.class_of("ceiling");
    b_.quad({low.x(), low.y(), height_m_}, {0, size.y(), 0}, {size.x(), 0, 0}, ceiling_);
    b_.label = b_.class_of("lamp");
    const auto shade = b_.plain("ceiling lamp", {1.0F, 0.97F, 0.88F});
    b_.turned({area.center().x(), area.center().y(), height_m_ - 0.1},
              std::array<Eigen::Vector2d, 3>{{{0.14, 0}, {0.22, 0.06}, {0.22, 0.1}}}, shade);
  }

  /// The wall's own surface; `accent`: in the room's second colour. Takes the doorway's place.
  void wall(Wall& w, bool accent) {
    const double lap = w.outer ? wall_thickness_m : 0;
    b_.pose = w.pose(0);
    b_.label = b_.class_of("wall");
    const Look& look = accent ? accent_ : wall_;
    const auto surface = [&](double from, double to, double low, double high) {  // seen from inside
      b_.quad({to, 0, low}, {from - to, 0, 0}, {0, 0, high - low}, look);
    };
    const auto skirting = [&](double from, double to) { b_.box({from, 0, 0}, {to, skirting_m, 0.08}, white_); };
    if (!w.doorway_m) {
      surface(-lap, w.length_m + lap, -lap, height_m_ + lap);
      skirting(0, w.length_m);
      return;
    }
    const double a = *w.doorway_m, b = a + door_width_m, half = wall_thickness_m / 2 + 0.001;
    surface(-lap, a, 0, height_m_);
    surface(b, w.length_m + lap, 0, height_m_);
    surface(a, b, door_height_m, height_m_);
    skirting(0, a);
    skirting(b, w.length_m);
    b_.label = b_.class_of("door");  // the reveal, to the middle of the wall
    b_.quad({a, 0, 0}, {0, -half, 0}, {0, 0, door_height_m}, white_);
    b_.quad({b, -half, 0}, {0, half, 0}, {0, 0, door_height_m}, white_);
    b_.quad({a, 0, door_height_m}, {0, -half, 0}, {door_width_m, 0, 0}, white_);
    w.taken.push_back({a - 0.05, b + 0.05, 0, door_height_m + 0.05});
  }

  /// A closed door; false if there is no room for it.
  bool door(Wall& w) {
    const double s = 0.3 + rng_.uniform() * (w.length_m - door_width_m - 0.6), e = s + door_width_m;
    if (!w.free({s - 0.08, e + 0.08, 0, door_height_m + 0.08})) return false;
    w.taken.push_back({s - 0.08, e + 0.08, 0, door_height_m + 0.08});
    b_.pose = w.pose(0);
    b_.label = b_.class_of("door");
    frame(s, e, 0, door_height_m, 0.08, 0.035, true);
    b_.box({s, 0, 0}, {e, 0.025, door_height_m}, door_);
    for (const double low : {0.2, 1.15}) b_.box({s + 0.15, 0.025, low}, {e - 0.15, 0.032, low + 0.72}, door_);
    b_.box({s + 0.06, 0.025, 1.0}, {s + 0.08, 0.07, 1.02}, metal_);
    b_.box({s + 0.06, 0.055, 1.0}, {s + 0.18, 0.07, 1.02}, metal_);
    return true;
  }

  /// A window with a sill; false if there is no room for it.
  bool window(Wall& w) {
    const double width = std::min(rng_.uniform(1.0, 2.0), w.length_m - 0.6), low = 0.9,
                 high = std::min(2.15, height_m_ - 0.2);
    if (width < 0.6) return false;
    const double s = 0.3 + rng_.uniform() * (w.length_m - width - 0.6), e = s + width;
    if (!w.free({s - 0.08, e + 0.08, low - 0.06, high + 0.06})) return false;
    w.taken.push_back({s - 0.08, e + 0.08, low - 0.06, high + 0.06});
    b_.pose = w.pose(0);
    b_.label = b_.class_of("window");
    frame(s, e, low, high, 0.06, 0.04, false);
    b_.box({s - 0.08, 0, low - 0.03}, {e + 0.08, 0.06, low}, white_);
    const int panes = width > 1.3 ? 3 : 2;
    for (int i = 1; i < panes; ++i)
      b_.box({s + i * width / panes - 0.025, 0, low}, {s + i * width / panes + 0.025, 0.03, high}, white_);
    b_.quad({e, 0.008, low}, {s - e, 0, 0}, {0, 0, high - low}, outlook_);
    return true;
  }

  /// A framed picture; false if there is no room for it.
  bool picture(Wall& w) {
    const double width = rng_.uniform(0.4, 0.9), tall = rng_.uniform(0.4, 0.65), low = 1.66 - tall / 2;
    if (w.length_m < width + 0.2) return false;
    const double s = 0.1 + rng_.uniform() * (w.length_m - width - 0.2), e = s + width;
    if (!w.free({s, e, low, low + tall}, 0.1)) return false;
    w.taken.push_back({s, e, low, low + tall});
    b_.pose = w.pose(0);
    b_.label = b_.class_of("picture");
    const Look canvas = b_.textured("painting", painting(rng_.fork(100 + pictures_++)), 0);
    frame(s + 0.03, e - 0.03, low + 0.03, low + tall - 0.03, 0.03, 0.03, false);
    b_.quad({e, 0.02, low}, {-width, 0, 0}, {0, 0, tall}, canvas);
    return true;
  }

 private:
  /// Bars of the given width around an opening.
  void frame(double s, double e, double low, double high, double width, double depth, bool to_floor) {
    const double bottom = to_floor ? 0 : low - width;
    b_.box({s - width, 0, bottom}, {s, depth, high + width}, white_);
    b_.box({e, 0, bottom}, {e + width, depth, high + width}, white_);
    b_.box({s, 0, high}, {e, depth, high + width}, white_);
    if (!to_floor) b_.box({s, 0, bottom}, {e, depth, low}, white_);
  }

  SceneBuilder& b_;
  double height_m_;
  Rng rng_;
  Look floor_, wall_, accent_, ceiling_, door_, outlook_, white_, metal_;
  std::uint64_t pictures_ = 0;
};

}  // namespace vantage::procedural
