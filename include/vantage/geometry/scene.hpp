// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/triangle_mesh.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// A picture on a surface; it repeats in both directions.
struct Texture {
  int width = 0, height = 0;                     ///< [px]
  std::vector<std::array<std::uint8_t, 3>> rgb;  ///< row-major, the top row first (v = 1 is the top, as in OBJ)
};

/// What a triangle looks like.
struct Material {
  std::string name;
  Eigen::Vector3f colour = Eigen::Vector3f::Constant(0.8F);  ///< RGB in [0, 1]; where there is a texture: its factor
  std::optional<std::uint32_t> texture = std::nullopt;       ///< which of Scene::textures
};

/// What a simulated camera looks at: triangles, what they look like, and what they are. World frame, z up, [m].
struct Scene {
  TriangleMesh mesh;                               ///< its colours, if any, multiply the materials'
  std::vector<std::array<Eigen::Vector2f, 3>> uv;  ///< of each triangle's corners; empty: no textures
  std::vector<std::uint32_t> material;             ///< of each triangle; empty: all are materials[0]
  std::vector<std::uint16_t> label;                ///< of each triangle, which of classes; empty: all 0
  std::vector<Material> materials = {{.name = "default"}};
  std::vector<Texture> textures;
  std::vector<std::string> classes = {"unknown"};  ///< names; 0 is what has no class
  std::optional<View> start = std::nullopt;        ///< where a robot may begin
  std::vector<std::string> notes;                  ///< what a reader had to replace or leave out, each once

  /// The class of this name, appended if it is new.
  std::uint16_t class_of(const std::string& name) {
    for (std::size_t i = 0; i < classes.size(); ++i)
      if (classes[i] == name) return static_cast<std::uint16_t>(i);
    if (classes.size() > 0xFFFF) throw Error("Scene::class_of", "more than 65536 classes", "fewer");
    classes.push_back(name);
    return static_cast<std::uint16_t>(classes.size() - 1);
  }
  /// Throws Error naming the first thing that does not fit together. O(size).
  void validate(std::string_view where) const {
    mesh.validate(where);
    const std::size_t n = mesh.triangles.size();
    if (n == 0) throw Error(where, "the scene has no triangle", "at least one");
    const auto one_each = [&](std::size_t size, std::string_view name) {
      if (size != 0 && size != n)
        throw Error(where, concat(size, " ", name), concat("none, or one for each of ", n, " triangles"));
    };
    one_each(uv.size(), "texture coordinates");
    one_each(material.size(), "materials of triangles");
    one_each(label.size(), "labels of triangles");
    if (materials.empty() || classes.empty()) throw Error(where, "no material or no class", "at least one of each");
    for (std::size_t i = 0; i < n; ++i) {
      if (!material.empty() && material[i] >= materials.size())
        throw Error(where, concat("triangle ", i, " has material ", material[i]), concat("below ", materials.size()));
      if (!label.empty() && label[i] >= classes.size())
        throw Error(where, concat("triangle ", i, " has class ", label[i]), concat("below ", classes.size()));
      if (!uv.empty())
        for (const Eigen::Vector2f& corner : uv[i])
          if (!corner.allFinite())
            throw Error(where, concat("triangle ", i, " has texture coordinates that are not finite"),
                        "finite numbers");
    }
    for (const Material& m : materials) {
      if (m.colour.hasNaN() || m.colour.minCoeff() < 0 || m.colour.maxCoeff() > 1)
        throw Error(where, concat("material '", m.name, "' has colour (", m.colour.transpose(), ")"), "in [0, 1]");
      if (m.texture && *m.texture >= textures.size())
        throw Error(where, concat("material '", m.name, "' has texture ", *m.texture),
                    concat("below ", textures.size()));
    }
    for (std::size_t i = 0; i < textures.size(); ++i)
      if (const Texture& t = textures[i];
          t.width < 1 || t.height < 1 ||
          t.rgb.size() != static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height))
        throw Error(where, concat("texture ", i, " of ", t.width, " x ", t.height, " px has ", t.rgb.size(), " texels"),
                    "width x height > 0");
  }
};

}  // namespace vantage
