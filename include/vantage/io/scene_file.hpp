// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include <vantage/core/error.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/gltf.hpp>
#include <vantage/io/json.hpp>
#include <vantage/io/loaded_scene.hpp>
#include <vantage/io/obj.hpp>
#include <vantage/io/ply.hpp>
#include <vantage/io/printable.hpp>
#include <vantage/io/scene_json.hpp>

namespace vantage {

/// Reads a mesh with its materials and textures: OBJ, glTF (.gltf, .glb) or PLY, by its name's end. Throws Error.
inline LoadedScene read_mesh_scene(const std::filesystem::path& path, const SceneLimits& limits = {}) {
  const std::string kind = extension_of(path);
  if (kind == "obj") return read_obj(path, limits);
  if (kind == "gltf" || kind == "glb") return read_gltf(path, limits);
  if (kind == "ply") {
    LoadedScene loaded;
    loaded.scene.mesh = read_ply_mesh(path, {.bytes = limits.bytes, .triangles = limits.triangles});
    if (!loaded.scene.mesh.colours.empty()) loaded.scene.materials[0].colour.setOnes();
    return loaded;
  }
  if (std::error_code none; !std::filesystem::exists(path, none)) throw Error(path.string(), "no such file or folder");
  throw Error(path.string(), concat("a file of kind '", printable(kind), "'"), "obj, gltf, glb, ply or a scene's json");
}

/// Reads a scene: a folder with a scene.json or object.json (or either file itself; see scene_json.hpp), or a mesh
/// alone, whose triangles have no class. Throws Error naming the file, and the line or the byte, or the way in the
/// JSON; a texture that is missing is a note.
inline Scene read_scene(const std::filesystem::path& path, const SceneLimits& limits = {}) {
  namespace fs = std::filesystem;
  fs::path description = path;
  if (folder_exists(path)) {
    description = path / "scene.json";
    if (!file_exists(description)) description = path / "object.json";
    if (!file_exists(description))
      throw Error(path.string(), "a folder without a scene", "scene.json or object.json in it");
  }
  Scene scene;
  if (extension_of(description) == "json") {
    const nlohmann::json json = read_json(description);
    const JsonItem root(json, description.string());
    std::optional<fs::path> mesh;
    if (const auto name = root.find("mesh")) {
      mesh = description.parent_path() / name->text();
    } else {
      for (const char* usual : {"scene.obj", "model.obj"})
        if (!mesh && file_exists(description.parent_path() / usual)) mesh = description.parent_path() / usual;
    }
    scene = SceneDescription(root, mesh ? read_mesh_scene(*mesh, limits) : LoadedScene{}).apply();
  } else {
    scene = read_mesh_scene(description, limits).scene;
  }
  scene.validate(path.string());
  return scene;
}

}  // namespace vantage
