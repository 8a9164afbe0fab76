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
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/sim/footprint.hpp>
#include <vantage/sim/procedural_texture.hpp>
#include <vantage/sim/scene_builder.hpp>

namespace vantage {

struct ObjectSceneConfig {
  double area_m = 2.6;                        ///< side of the square around the origin in which objects stand; > 0
  double min_size_m = 0.6, max_size_m = 1.0;  ///< an object's longest side is uniform in between; > 0
  double margin_m = 0.05;                     ///< between footprints; >= 0
  double ground_m = 6;                        ///< side of the textured ground; 0: none

  void validate() const {
    Check check("ObjectSceneConfig");
    check.positive("area_m", area_m);
    check.positive("min_size_m", min_size_m);
    check(std::isfinite(max_size_m) && max_size_m >= min_size_m, "max_size_m", max_size_m, "at least min_size_m");
    check.not_negative("margin_m", margin_m);
    check.not_negative("ground_m", ground_m);
    check.done();
  }
};

/// Objects on a ground plane, and where they stand.
struct ObjectScene {
  Scene scene;
  std::vector<Footprint> footprints;  ///< of the objects, in the order given
  Box3 bounds;                        ///< of all objects, without the ground
};

/// Adds a model, moved and scaled, to a scene; classes are joined by name. Expects valid scenes. O(triangles of both).
inline void append(Scene& scene, const Scene& model, const Eigen::Affine3d& place) {
  const std::size_t old_vertices = scene.mesh.vertices.size(), old_triangles = scene.mesh.triangles.size();
  const std::size_t triangles = model.mesh.triangles.size(), all = old_triangles + triangles;
  const auto first_vertex = static_cast<std::uint32_t>(old_vertices);
  const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
  const auto first_texture = static_cast<std::uint32_t>(scene.textures.size());
  for (const Eigen::Vector3f& v : model.mesh.vertices)
    scene.mesh.vertices.push_back((place * v.cast<double>()).cast<float>());
  for (const auto& [a, b, c] : model.mesh.triangles)
    scene.mesh.triangles.push_back({a + first_vertex, b + first_vertex, c + first_vertex});

  if (!scene.mesh.colours.empty() || !model.mesh.colours.empty()) {  // white multiplies nothing away
    scene.mesh.colours.resize(old_vertices, Eigen::Vector3f::Ones());
    scene.mesh.colours.insert(scene.mesh.colours.end(), model.mesh.colours.begin(), model.mesh.colours.end());
    scene.mesh.colours.resize(scene.mesh.vertices.size(), Eigen::Vector3f::Ones());
  }
  if (!scene.uv.empty() || !model.uv.empty()) {
    const Eigen::Vector2f zero = Eigen::Vector2f::Zero();
    scene.uv.resize(old_triangles, {zero, zero, zero});
    scene.uv.insert(scene.uv.end(), model.uv.begin(), model.uv.end());
    scene.uv.resize(all, {zero, zero, zero});
  }
  scene.material.resize(old_triangles, 0);
  for (std::size_t i = 0; i < triangles; ++i)
    scene.material.push_back(first_material + (model.material.empty() ? 0 : model.material[i]));
  for (Material m : model.materials) {
    if (m.texture) *m.texture += first_texture;
    // Without coordinates a texture is not drawn; the scene may have some now.
    if (model.uv.empty()) m.texture.reset();
    scene.materials.push_back(std::move(m));
  }
  scene.textures.insert(scene.textures.end(), model.textures.begin(), model.textures.end());

  scene.label.resize(old_triangles, 0);
  std::vector<std::uint16_t> class_of = {0};  // the model's classes in the scene; unknown stays unknown
  for (std::size_t i = 1; i < model.classes.size(); ++i) class_of.push_back(scene.class_of(model.classes[i]));
  for (std::size_t i = 0; i < triangles; ++i) scene.label.push_back(class_of[model.label.empty() ? 0 : model.label[i]]);
  for (const std::string& note : model.notes)
    if (std::find(scene.notes.begin(), scene.notes.end(), note) == scene.notes.end()) scene.notes.push_back(note);
}

/// Objects at random places, sizes and headings on a ground plane (z = 0, class "ground"), none of whose footprints
/// overlap: the scenes of ch. 5, and, with one object, of ch. 4, to be seen from a hemisphere of 2 m around the origin.
/// A footprint is that of the bounding box. Rejection, and once more from the beginning when there is no place left.
/// Throws Error for a bad object, naming which, and if 100 beginnings do not suffice. O(triangles).
inline ObjectScene compose_objects(std::span<const Scene> objects, const Rng& rng,
                                   const ObjectSceneConfig& config = {}) {
  config.validate();
  if (objects.empty()) throw Error("compose_objects", "no object", "at least one");
  std::vector<Box3> bounds;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string where = concat("compose_objects: object ", i);
    objects[i].validate(where);
    Box3& box = bounds.emplace_back();  // of what triangles use
    for (const auto& triangle : objects[i].mesh.triangles)
      for (const std::uint32_t v : triangle) box.extend(objects[i].mesh.vertices[v].cast<double>());
    if (!(box.sizes().maxCoeff() > 0)) throw Error(where, "it has no extent", "a surface");
  }

  std::vector<Footprint> footprints;
  std::vector<double> scales;
  std::size_t most = 0;
  for (std::uint64_t start = 0; start < 100 && footprints.size() < objects.size(); ++start) {
    Rng draw = rng.fork(start);
    footprints.clear();
    scales.clear();
    for (const Box3& box : bounds) {
      const double scale = draw.uniform(config.min_size_m, config.max_size_m) / box.sizes().maxCoeff();
      const Eigen::Vector2d half = scale * box.sizes().head<2>() / 2;
      bool placed = false;
      for (int attempt = 0; attempt < 200 && !placed; ++attempt) {
        const double reach = config.area_m / 2;
        const Footprint f{
            {draw.uniform(-reach, reach), draw.uniform(-reach, reach)}, half, draw.uniform(0, 2 * std::numbers::pi)};
        placed = f.bounds().min().minCoeff() >= -reach && f.bounds().max().maxCoeff() <= reach &&
                 std::all_of(footprints.begin(), footprints.end(),
                             [&](const Footprint& other) { return gap_m(f, other) > config.margin_m; });
        if (!placed) continue;
        footprints.push_back(f);
        scales.push_back(scale);
      }
      if (!placed) break;
    }
    most = std::max(most, footprints.size());
  }
  if (footprints.size() < objects.size())
    throw Error("compose_objects",
                concat(most, " of ", objects.size(), " objects fit on ", config.area_m, " m x ", config.area_m, " m"),
                "a larger area_m, or fewer or smaller objects");

  ObjectScene out;
  SceneBuilder ground(0.25);
  if (config.ground_m > 0) {
    using procedural::Colour;
    const double side = config.ground_m;
    ground.label = ground.class_of("ground");
    ground.quad(
        {-side / 2, -side / 2, 0}, {side, 0, 0}, {0, side, 0},
        ground.textured(
            "ground", procedural::mottled(Colour(0.40F, 0.38F, 0.35F), Colour(0.72F, 0.70F, 0.66F), 6, rng.fork(1000)),
            1.0));
  }
  out.scene = std::move(ground).take();
  if (out.scene.materials.empty()) out.scene.materials.emplace_back();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    Eigen::Vector3d foot = bounds[i].center();
    foot.z() = bounds[i].min().z();
    const Eigen::Affine3d place =
        Eigen::Affine3d(footprints[i].pose()) * Eigen::Scaling(scales[i]) * Eigen::Translation3d(-foot);
    append(out.scene, objects[i], place);
    const double height = scales[i] * bounds[i].sizes().z();
    for (const Eigen::Vector2d& c : footprints[i].corners())
      for (const double z : {0.0, height}) out.bounds.extend(Eigen::Vector3d(c.x(), c.y(), z));
  }
  out.footprints = std::move(footprints);
  out.scene.start = look_at({2 * std::cos(0.6), 0, 2 * std::sin(0.6)}, {0, 0, 0});
  return out;
}

}  // namespace vantage
