// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/sim/footprint.hpp>

namespace vantage {

struct ObjectSceneConfig {
  double area_m = 3;      ///< side of the square around the origin in which objects stand, > 0
  double size_m = 1;      ///< what an object's longest side is made; > 0
  double margin_m = 0.1;  ///< between footprints, >= 0
  double ground_m = 6;    ///< side of the ground plane; at least area_m
  int attempts = 1000;    ///< at a place for each object, > 0

  void validate() const {
    Check check("ObjectSceneConfig");
    check.positive("area_m", area_m);
    check.positive("size_m", size_m);
    check.not_negative("margin_m", margin_m);
    check(std::isfinite(ground_m) && ground_m >= area_m, "ground_m", ground_m, "finite and >= area_m");
    check(attempts > 0, "attempts", attempts, "> 0");
    check.done();
  }
};

/// Objects on a ground plane, and where they stand.
struct ObjectScene {
  Scene scene;
  std::vector<Footprint> footprints;  ///< of each object
  Box3 bounds;                        ///< of all objects, without the ground
};

namespace detail {

// Appends a part to a whole: its triangles as `place` puts them, its materials and textures behind those there are.
inline void append(Scene& whole, const Scene& part, const Eigen::Affine3d& place) {
  const auto vertices = static_cast<std::uint32_t>(whole.mesh.vertices.size()),
             materials = static_cast<std::uint32_t>(whole.materials.size()),
             textures = static_cast<std::uint32_t>(whole.textures.size());
  for (const Eigen::Vector3f& v : part.mesh.vertices)
    whole.mesh.vertices.push_back((place * v.cast<double>()).cast<float>());
  for (std::size_t i = 0; i < part.mesh.vertices.size(); ++i)
    whole.mesh.colours.push_back(part.mesh.colours.empty() ? Eigen::Vector3f::Ones() : part.mesh.colours[i]);
  std::vector<std::uint16_t> classes;
  for (const std::string& name : part.classes) classes.push_back(whole.class_of(name));
  for (std::size_t i = 0; i < part.mesh.triangles.size(); ++i) {
    auto triangle = part.mesh.triangles[i];
    for (std::uint32_t& v : triangle) v += vertices;
    whole.mesh.triangles.push_back(triangle);
    whole.uv.push_back(
        part.uv.empty()
            ? std::array<Eigen::Vector2f, 3>{Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()}
            : part.uv[i]);
    whole.material.push_back(materials + (part.material.empty() ? 0 : part.material[i]));
    whole.label.push_back(part.label.empty() ? classes[0] : classes[part.label[i]]);
  }
  for (Material m : part.materials) {
    if (m.texture) *m.texture += textures;
    whole.materials.push_back(std::move(m));
  }
  whole.textures.insert(whole.textures.end(), part.textures.begin(), part.textures.end());
  for (const std::string& note : part.notes)
    if (std::find(whole.notes.begin(), whole.notes.end(), note) == whole.notes.end()) whole.notes.push_back(note);
}

// The ground: two triangles under a texture of pale stone, seeded.
inline Scene ground(double side_m, Rng rng) {
  const auto h = static_cast<float>(side_m / 2);
  Scene s;
  s.mesh.vertices = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
  s.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto repeats = static_cast<float>(side_m);  // once a metre
  const Eigen::Vector2f a(0, 0), b(repeats, 0), c(repeats, repeats), d(0, repeats);
  s.uv = {{a, b, c}, {a, c, d}};
  s.label.assign(2, s.class_of("ground"));
  Texture t{128, 128, {}};
  for (int i = 0; i < t.width * t.height; ++i) {
    const auto grey = static_cast<std::uint8_t>(std::clamp(168 + 14 * rng.normal(), 100.0, 230.0));
    t.rgb.push_back({grey, grey, static_cast<std::uint8_t>(grey - 8)});
  }
  s.textures.push_back(std::move(t));
  s.materials[0] = {.name = "ground", .colour = Eigen::Vector3f::Ones(), .texture = 0};
  return s;
}

}  // namespace detail

/// Puts objects on a ground plane at random places and headings, none within the margin of another: the scenes of
/// chapters 4 and 5. Each is scaled so that its longest side is size_m, turned about the vertical and set on z = 0; its
/// footprint is that of its bounding box, so that what stands apart does not interpenetrate. Objects without a class of
/// their own stay unknown; the ground has the class "ground". Throws Error if there is no object, one does not fit
/// together (Scene::validate), or there is no room for one.
inline ObjectScene compose_objects(std::span<const Scene> objects, const Rng& rng,
                                   const ObjectSceneConfig& config = {}) {
  config.validate();
  if (objects.empty()) throw Error("compose_objects", "no objects", "at least one");
  ObjectScene made;
  made.scene.materials.clear();
  detail::append(made.scene, detail::ground(config.ground_m, rng.fork(0)), Eigen::Affine3d::Identity());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    objects[i].validate(concat("compose_objects (object ", i, ")"));
    Box3 box;  // of what triangles use
    for (const auto& triangle : objects[i].mesh.triangles)
      for (const std::uint32_t v : triangle) box.extend(objects[i].mesh.vertices[v].cast<double>());
    const double longest = box.sizes().maxCoeff();
    if (!(longest > 0)) throw Error("compose_objects", concat("object ", i, " has no extent"), "a surface");
    const double scale = config.size_m / longest;
    Rng draw = rng.fork(1 + i);
    Footprint f{Eigen::Vector2d::Zero(), scale * 0.5 * box.sizes().head<2>()};
    const auto fits = [&] {
      for (const Eigen::Vector2d& c : f.corners())
        if (c.cwiseAbs().maxCoeff() > config.area_m / 2) return false;
      return std::none_of(made.footprints.begin(), made.footprints.end(),
                          [&](const Footprint& other) { return gap_m(f, other) <= config.margin_m; });
    };
    int attempt = 0;
    do {
      if (attempt++ == config.attempts)
        throw Error("compose_objects", concat("no room for object ", i, " of ", objects.size()),
                    concat("fewer or smaller objects on ", config.area_m, " m x ", config.area_m, " m"));
      f.centre = {draw.uniform(-0.5, 0.5) * config.area_m, draw.uniform(-0.5, 0.5) * config.area_m};
      f.yaw_rad = draw.uniform(0, 2 * std::numbers::pi);
    } while (!fits());
    const Eigen::Vector3d foot(box.center().x(), box.center().y(), box.min().z());
    detail::append(made.scene, objects[i],
                   f.pose() * Eigen::Scaling(scale) * Eigen::Translation3d(Eigen::Vector3d(-foot)));
    made.footprints.push_back(f);
    for (const Eigen::Vector2d& c : f.corners()) {
      made.bounds.extend(Eigen::Vector3d(c.x(), c.y(), 0));
      made.bounds.extend(Eigen::Vector3d(c.x(), c.y(), scale * box.sizes().z()));
    }
  }
  return made;
}

}  // namespace vantage
