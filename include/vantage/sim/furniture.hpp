// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/sim/procedural_texture.hpp>
#include <vantage/sim/scene_builder.hpp>

// Furniture made of boxes, turned and round things. A piece stands on the ground in its own frame: origin in the middle
// of its footprint, back to -y, front to +y, inside of |x| <= size.x / 2, |y| <= size.y / 2, 0 <= z <= size.z.
namespace vantage::procedural {

/// What a room's surfaces are made of; drawn once a room.
struct Palette {
  using Look = SceneBuilder::Look;
  Look light_wood, dark_wood, sofa, armchair, cushion, linen, metal, white, black, lamp, clay, leaves, cardboard;
  std::vector<Look> books;

  Palette(SceneBuilder& b, Rng rng) {
    const auto pick = [&](std::initializer_list<Colour> colours) -> Colour {
      return *(colours.begin() + static_cast<std::ptrdiff_t>(rng.index(colours.size())));
    };
    light_wood =
        b.textured("light wood",
                   wood(pick({{0.86F, 0.66F, 0.42F}, {0.80F, 0.58F, 0.36F}, {0.92F, 0.76F, 0.54F}}), rng.fork(1)), 0.7);
    dark_wood =
        b.textured("dark wood",
                   wood(pick({{0.50F, 0.30F, 0.18F}, {0.42F, 0.26F, 0.20F}, {0.60F, 0.36F, 0.20F}}), rng.fork(2)), 0.7);
    sofa = b.textured(
        "sofa fabric",
        fabric(pick({{0.25F, 0.42F, 0.55F}, {0.62F, 0.30F, 0.26F}, {0.35F, 0.45F, 0.32F}, {0.58F, 0.55F, 0.52F}}),
               rng.fork(3)),
        0.4);
    armchair = b.textured(
        "armchair fabric",
        fabric(pick({{0.85F, 0.62F, 0.25F}, {0.30F, 0.34F, 0.46F}, {0.72F, 0.42F, 0.36F}}), rng.fork(4)), 0.4);
    cushion = b.textured("cushion",
                         plaid(pick({{0.9F, 0.85F, 0.72F}, {0.85F, 0.5F, 0.3F}}),
                               pick({{0.6F, 0.15F, 0.15F}, {0.15F, 0.3F, 0.5F}}), rng.fork(5)),
                         0.3);
    linen = b.textured("linen",
                       plaid({0.92F, 0.92F, 0.90F},
                             pick({{0.45F, 0.6F, 0.8F}, {0.7F, 0.5F, 0.65F}, {0.5F, 0.7F, 0.55F}}), rng.fork(6)),
                       0.5);
    clay = b.textured("clay", mottled({0.62F, 0.32F, 0.20F}, {0.80F, 0.46F, 0.30F}, 16, rng.fork(7)), 0.4);
    leaves = b.textured("leaves", mottled({0.08F, 0.26F, 0.07F}, {0.42F, 0.66F, 0.25F}, 12, rng.fork(8)), 0.35);
    cardboard = b.textured("cardboard", plaster({0.76F, 0.60F, 0.42F}, rng.fork(9)), 0.5);
    for (std::uint64_t i = 0; i < 3; ++i)
      books.push_back(b.textured("books", procedural::books(rng.fork(10 + i)), 0.8));
    metal = b.plain("metal", {0.55F, 0.56F, 0.58F});
    white = b.plain("white paint", {0.93F, 0.92F, 0.89F});
    black = b.plain("black plastic", {0.09F, 0.09F, 0.10F});
    lamp = b.plain("lampshade", pick({{1.0F, 0.93F, 0.74F}, {1.0F, 0.80F, 0.62F}, {0.96F, 0.96F, 0.92F}}));
  }
};

/// Draws into the frame `at`, in which the builder's own was.
struct Piece {
  std::string name;      ///< and the class of most of it
  Eigen::Vector3d size;  ///< [m]
  bool at_wall;
  void (*draw)(SceneBuilder& b, const Palette& p, const Eigen::Vector3d& size, Rng& rng);
};

namespace detail {

using Vec = Eigen::Vector3d;

inline void legs(SceneBuilder& b, const SceneBuilder::Look& look, double x, double y, double height, double thick) {
  for (const double sx : {-1.0, 1.0})
    for (const double sy : {-1.0, 1.0})
      b.box({sx * x - thick / 2, sy * y - thick / 2, 0}, {sx * x + thick / 2, sy * y + thick / 2, height}, look);
}

inline void table(SceneBuilder& b, const SceneBuilder::Look& look, const Vec& s) {
  b.label = b.class_of("table");
  legs(b, look, s.x() / 2 - 0.06, s.y() / 2 - 0.06, s.z() - 0.04, 0.06);
  b.box({-s.x() / 2, -s.y() / 2, s.z() - 0.04}, {s.x() / 2, s.y() / 2, s.z()}, look);
}

/// 0.42 x 0.45 x 0.92 m, its back at -y.
inline void chair(SceneBuilder& b, const Palette& p, const SceneBuilder::Look& look) {
  b.label = b.class_of("chair");
  legs(b, look, 0.18, 0.195, 0.42, 0.04);
  b.box({-0.21, -0.225, 0.42}, {0.21, 0.225, 0.44}, look);
  b.box({-0.20, -0.185, 0.44}, {0.20, 0.215, 0.47}, p.cushion);
  for (const double x : {-0.19, 0.15}) b.box({x, -0.225, 0.44}, {x + 0.04, -0.19, 0.86}, look);
  for (const double z : {0.56, 0.70, 0.86}) b.box({-0.21, -0.225, z}, {0.21, -0.19, z + 0.06}, look);
}

inline void upholstered(SceneBuilder& b, const Palette& p, const SceneBuilder::Look& look, const Vec& s, int seats) {
  const double x = s.x() / 2, y = s.y() / 2, arm = 0.16, back = 0.2;
  legs(b, p.dark_wood, x - 0.08, y - 0.08, 0.1, 0.05);
  b.box({-x, -y, 0.1}, {x, y, 0.28}, look);          // base
  b.box({-x, -y, 0.28}, {-x + arm, y, 0.60}, look);  // arms
  b.box({x - arm, -y, 0.28}, {x, y, 0.60}, look);
  b.box({-x + arm, -y, 0.28}, {x - arm, -y + back, s.z()}, look);  // back
  const double seat = 2 * (x - arm) / seats;
  for (int i = 0; i < seats; ++i) {
    const double left = -x + arm + i * seat;
    b.box({left + 0.01, -y + back + 0.005, 0.28}, {left + seat - 0.01, y - 0.01, 0.44}, look);
    b.ellipsoid({left + seat / 2, -y + back + 0.09, 0.60}, {0.20, 0.07, 0.155}, p.cushion);
  }
}

inline void draw_sofa(SceneBuilder& b, const Palette& p, const Vec& s, Rng&) {
  b.label = b.class_of("sofa");
  upholstered(b, p, p.sofa, s, 3);
}

inline void draw_armchair(SceneBuilder& b, const Palette& p, const Vec& s, Rng&) {
  b.label = b.class_of("armchair");
  upholstered(b, p, p.armchair, s, 1);
}

inline void draw_bookcase(SceneBuilder& b, const Palette& p, const Vec& s, Rng& rng) {
  b.label = b.class_of("bookcase");
  const double x = s.x() / 2, y = s.y() / 2, board = 0.025;
  b.box({-x, -y, 0}, {-x + board, y, s.z()}, p.dark_wood);
  b.box({x - board, -y, 0}, {x, y, s.z()}, p.dark_wood);
  b.box({-x + board, -y, 0}, {x - board, -y + 0.012, s.z()}, p.dark_wood);
  const int shelves = 5;
  const double step = (s.z() - board) / shelves;
  for (int i = 0; i <= shelves; ++i) {
    const double z = i * step;
    b.box({-x + board, -y + 0.012, z}, {x - board, y, z + board}, p.dark_wood);
    if (i == shelves) break;
    b.label = b.class_of("book");
    double left = -x + board + 0.01;
    while (left < x - board - 0.12) {  // rows of books, and gaps between them
      const double width = std::min(rng.uniform(0.15, 0.5), x - board - 0.01 - left);
      const double height = rng.uniform(0.6, 0.85) * (step - board);
      const SceneBuilder::Look& look = p.books[static_cast<std::size_t>(rng.index(p.books.size()))];
      b.box({left, -y + 0.03, z + board}, {left + width, y - rng.uniform(0.02, 0.06), z + board + height},
            {look.material, 0});
      left += width + (rng.uniform() < 0.5 ? rng.uniform(0.05, 0.25) : 0.004);
    }
    b.label = b.class_of("bookcase");
  }
}

inline void draw_cabinet(SceneBuilder& b, const Palette& p, const Vec& s, Rng& rng) {
  b.label = b.class_of("cabinet");
  const double x = s.x() / 2, y = s.y() / 2, top = s.z() > 1.1 ? 0.75 : s.z();
  b.box({-x + 0.02, -y + 0.02, 0}, {x - 0.02, y - 0.05, 0.07}, p.black);
  b.box({-x, -y, 0.07}, {x, y - 0.03, top}, p.light_wood);
  const int columns = 3, rows = 2;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const double w = 2 * x / columns, h = (top - 0.09) / rows, left = -x + i * w, low = 0.08 + j * h;
      b.box({left + 0.01, y - 0.03, low + 0.01}, {left + w - 0.01, y - 0.012, low + h - 0.01}, p.light_wood);
      b.box({left + w / 2 - 0.05, y - 0.012, low + h - 0.07}, {left + w / 2 + 0.05, y, low + h - 0.055}, p.metal);
    }
  if (top == s.z()) return;
  b.label = b.class_of("screen");
  const double half = std::min(0.8 * x, 0.55);
  b.box({-0.15, -0.1, top}, {0.15, 0.1, top + 0.02}, p.black);
  b.box({-0.03, -0.03, top + 0.02}, {0.03, 0, top + 0.1}, p.black);
  b.box({-half, -0.03, top + 0.1}, {half, 0.01, s.z()}, p.black);
  const auto programme = b.textured("screen", rng.uniform() < 0.5 ? outlook(rng.fork(0)) : painting(rng.fork(0)), 0);
  b.quad({half - 0.02, 0.0105, top + 0.12}, {-2 * half + 0.04, 0, 0}, {0, 0, s.z() - top - 0.14}, programme);
}

inline void draw_wardrobe(SceneBuilder& b, const Palette& p, const Vec& s, Rng&) {
  b.label = b.class_of("wardrobe");
  const double x = s.x() / 2, y = s.y() / 2;
  b.box({-x, -y, 0}, {x, y - 0.035, s.z()}, p.light_wood);
  for (const double left : {-x, 0.0}) {
    b.box({left + 0.008, y - 0.035, 0.08}, {left + x - 0.008, y - 0.015, s.z() - 0.03}, p.white);
    b.box({left + 0.08, y - 0.015, 0.2}, {left + x - 0.08, y - 0.010, s.z() - 0.15}, p.light_wood);
  }
  for (const double at : {-0.04, 0.02}) b.box({at, y - 0.015, 0.95}, {at + 0.02, y, 1.15}, p.metal);
}

inline void draw_bed(SceneBuilder& b, const Palette& p, const Vec& s, Rng&) {
  b.label = b.class_of("bed");
  const double x = s.x() / 2, y = s.y() / 2;
  b.box({-x, -y, 0}, {x, -y + 0.06, s.z()}, p.dark_wood);  // headboard
  b.box({-x, y - 0.04, 0}, {x, y, 0.42}, p.dark_wood);
  b.box({-x, -y + 0.06, 0.12}, {x, y - 0.04, 0.3}, p.dark_wood);
  legs(b, p.dark_wood, x - 0.06, y - 0.12, 0.12, 0.06);
  b.box({-x + 0.03, -y + 0.065, 0.3}, {x - 0.03, y - 0.045, 0.48}, p.white);
  b.box({-x + 0.015, -y + 0.6, 0.48}, {x - 0.015, y - 0.05, 0.53}, p.linen);
  for (const double at : {-x / 2, x / 2}) b.ellipsoid({at, -y + 0.34, 0.56}, {0.3, 0.2, 0.08}, p.white);
}

inline void draw_desk(SceneBuilder& b, const Palette& p, const Vec& s, Rng& rng) {
  const double x = s.x() / 2, y = s.y() / 2, back = -y, front = -y + 0.65;  // the chair stands in front
  b.label = b.class_of("table");
  b.box({-x, back, 0.70}, {x, front, 0.74}, p.light_wood);
  for (const double at : {-x, x - 0.04}) b.box({at, back + 0.03, 0}, {at + 0.04, front - 0.03, 0.70}, p.light_wood);
  b.box({x - 0.45, back + 0.05, 0.2}, {x - 0.04, front - 0.05, 0.69}, p.white);
  b.label = b.class_of("screen");
  b.box({-0.12, back + 0.12, 0.74}, {0.12, back + 0.30, 0.755}, p.black);
  b.box({-0.02, back + 0.2, 0.755}, {0.02, back + 0.23, 0.88}, p.black);
  b.box({-0.28, back + 0.2, 0.86}, {0.28, back + 0.23, 1.2}, p.black);
  const auto picture = b.textured("screen", outlook(rng.fork(0)), 0);
  b.quad({0.27, back + 0.2305, 0.87}, {-0.54, 0, 0}, {0, 0, 0.32}, picture);
  b.box({-0.22, back + 0.38, 0.74}, {0.22, back + 0.52, 0.76}, p.black);  // keyboard
  const Eigen::Isometry3d desk = b.pose;
  b.pose.translate(Vec(-0.1, y - 0.225, 0));
  b.pose.rotate(Eigen::AngleAxisd(deg(180), Vec::UnitZ()));
  chair(b, p, p.dark_wood);
  b.pose = desk;
}

inline void draw_dining(SceneBuilder& b, const Palette& p, const Vec& s, Rng& rng) {
  const Eigen::Isometry3d middle = b.pose;
  const double along = s.x() - 0.5, across = s.y() - 0.8;  // the table; chairs reach below it
  table(b, p.light_wood, {along, across, 0.74});
  b.label = b.class_of("bowl");
  b.turned({0.1, 0, 0.74}, std::array<Eigen::Vector2d, 3>{{{0.05, 0}, {0.16, 0.07}, {0.14, 0.07}}}, p.clay);
  for (const double x : {-along / 4, along / 4})
    for (const double side : {-1.0, 1.0}) {
      b.pose = middle;
      b.pose.translate(Vec(x, side * (s.y() / 2 - 0.24), 0));
      b.pose.rotate(Eigen::AngleAxisd((side < 0 ? 0 : deg(180)) + rng.uniform(-0.03, 0.03), Vec::UnitZ()));
      chair(b, p, p.dark_wood);
    }
  b.pose = middle;
}

inline void draw_coffee_table(SceneBuilder& b, const Palette& p, const Vec& s, Rng& rng) {
  b.label = b.class_of("carpet");
  const auto carpet = b.textured("rug", rug({0.55F, 0.20F, 0.18F}, {0.88F, 0.78F, 0.58F}, rng.fork(0)), 0);
  b.box({-s.x() / 2, -s.y() / 2, 0}, {s.x() / 2, s.y() / 2, 0.012}, carpet);
  const Eigen::Isometry3d ground = b.pose;
  b.pose.translate(Vec(0, 0, 0.012));
  table(b, p.dark_wood, {0.55 * s.x(), 0.45 * s.y(), s.z() - 0.012 - 0.06});
  b.label = b.class_of("book");
  b.pose.translate(Vec(0.1, 0.02, s.z() - 0.012 - 0.06));
  b.pose.rotate(Eigen::AngleAxisd(rng.uniform(-0.4, 0.4), Vec::UnitZ()));
  b.box({-0.11, -0.08, 0}, {0.11, 0.08, 0.03}, {p.books[0].material, 0});
  b.box({-0.10, -0.07, 0.03}, {0.09, 0.08, 0.055}, {p.books[1].material, 0});
  b.pose = ground;
}

inline void draw_lamp(SceneBuilder& b, const Palette& p, const Vec& s, Rng&) {
  b.label = b.class_of("lamp");
  b.cylinder({0, 0, 0}, 0.16, 0.15, 0.025, p.black);
  b.cylinder({0, 0, 0.025}, 0.014, 0.014, s.z() - 0.345, p.metal);
  b.turned({0, 0, s.z() - 0.32}, std::array<Eigen::Vector2d, 2>{{{s.x() / 2, 0}, {0.6 * s.x() / 2, 0.32}}}, p.lamp);
}

inline void draw_plant(SceneBuilder& b, const Palette& p, const Vec& s, Rng& rng) {
  b.label = b.class_of("plant");
  b.turned({0, 0, 0}, std::array<Eigen::Vector2d, 4>{{{0.12, 0}, {0.17, 0.28}, {0.18, 0.32}, {0.15, 0.32}}}, p.clay);
  b.cylinder({0, 0, 0.32}, 0.022, 0.014, 0.6 * s.z() - 0.32, p.dark_wood);
  const double reach = s.x() / 2 - 0.13;
  for (int i = 0; i < 14; ++i) {
    const double angle = 2.4 * i, t = (i + 0.5) / 14, r = reach * std::sin(std::numbers::pi * (0.15 + 0.8 * t));
    const Vec half(rng.uniform(0.08, 0.13), rng.uniform(0.08, 0.13), rng.uniform(0.06, 0.1));
    b.ellipsoid({r * std::cos(angle), r * std::sin(angle), std::lerp(0.42 * s.z(), s.z() - 0.11, t)}, half, p.leaves);
  }
}

inline void draw_boxes(SceneBuilder& b, const Palette& p, const Vec& s, Rng& rng) {
  b.label = b.class_of("box");
  const Eigen::Isometry3d ground = b.pose;
  double z = 0, half = s.x() / 2 / std::sqrt(2.0);  // at any angle inside
  for (int i = 0; i < 3; ++i) {
    const double height = (i == 2 ? s.z() - z : rng.uniform(0.25, 0.4) * s.z());
    b.pose = ground;
    b.pose.rotate(Eigen::AngleAxisd(rng.uniform(-0.4, 0.4), Vec::UnitZ()));
    b.box({-half, -0.8 * half, z}, {half, 0.8 * half, z + height}, p.cardboard);
    b.box({-0.03, -0.8 * half - 0.001, z + 0.3 * height}, {0.03, 0.8 * half + 0.001, z + height - 0.001},
          p.lamp);  // tape
    z += height;
    half *= 0.8;
  }
  b.pose = ground;
}

inline void draw_stool(SceneBuilder& b, const Palette& p, const Vec& s, Rng&) {
  b.label = b.class_of("stool");
  b.cylinder({0, 0, 0}, 0.9 * s.x() / 2, 0.5 * s.x() / 2, 0.04, p.metal);
  b.cylinder({0, 0, 0.04}, 0.03, 0.03, s.z() - 0.1, p.metal);
  b.turned({0, 0, s.z() - 0.06},
           std::array<Eigen::Vector2d, 3>{{{0.9 * s.x() / 2, 0}, {s.x() / 2, 0.03}, {0.85 * s.x() / 2, 0.06}}},
           p.armchair);
}

}  // namespace detail

/// Every kind of piece there is, in the order in which a room is furnished; sizes in metres.
inline const std::vector<Piece>& catalogue() {
  static const std::vector<Piece> pieces = {{"sofa", {2.0, 0.9, 0.82}, true, detail::draw_sofa},
                                            {"dining table", {1.9, 1.75, 1.0}, false, detail::draw_dining},
                                            {"coffee table", {1.9, 1.2, 0.45}, false, detail::draw_coffee_table},
                                            {"bookcase", {1.1, 0.32, 1.95}, true, detail::draw_bookcase},
                                            {"cabinet", {1.5, 0.45, 1.4}, true, detail::draw_cabinet},
                                            {"armchair", {0.85, 0.85, 0.84}, false, detail::draw_armchair},
                                            {"lamp", {0.45, 0.45, 1.6}, false, detail::draw_lamp},
                                            {"plant", {0.7, 0.7, 1.25}, false, detail::draw_plant},
                                            {"desk", {1.4, 1.15, 1.3}, true, detail::draw_desk},
                                            {"bed", {1.5, 2.1, 0.95}, true, detail::draw_bed},
                                            {"wardrobe", {1.2, 0.6, 2.05}, true, detail::draw_wardrobe},
                                            {"boxes", {0.6, 0.6, 0.9}, false, detail::draw_boxes},
                                            {"stool", {0.36, 0.36, 0.5}, false, detail::draw_stool},
                                            {"chest", {1.0, 0.45, 0.85}, true, detail::draw_cabinet}};
  return pieces;
}

}  // namespace vantage::procedural
