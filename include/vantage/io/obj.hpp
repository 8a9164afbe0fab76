// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/loaded_scene.hpp>
#include <vantage/io/mtl.hpp>
#include <vantage/io/printable.hpp>

namespace vantage {

/// Reads the polygons of Wavefront OBJ text: v (with colours, if any), vt, f, o, g, usemtl, mtllib; curves, lines and
/// points become a note. Faces of more than three corners are taken for convex. A part is an object (o), or a group (g)
/// of a file without objects.
class ObjReader {
 public:
  /// The text of an MTL file that the OBJ names, or none; a name may have a folder.
  using Library = std::function<std::optional<std::string>(const std::string& name)>;

  ObjReader(std::string_view text, std::string where, SceneLimits limits)
      : lines_(text, std::move(where)), limits_(limits) {
    loaded_.scene.materials.clear();
    reserve(text);
  }

  /// `folder`: where the OBJ lies; MTL files are relative to it, and textures to their MTL file.
  LoadedScene read(const Library& library, const std::filesystem::path& folder) && {
    for (std::string_view key = lines_.next(); !key.empty(); key = lines_.next()) {
      if (key == "v")
        vertex();
      else if (key == "vt")
        texture_coordinates();
      else if (key == "f")
        face();
      else if (key == "usemtl")
        material_ = index_of(material_names_, std::string(lines_.rest()));
      else if (key == "o")
        part(true);
      else if (key == "g")
        part(false);
      else if (key == "mtllib")
        add_library(library);
      else if (key == "l" || key == "p" || key == "curv" || key == "curv2" || key == "surf")
        loaded_.note(concat(lines_.where(), ": lines, points and curves are left out"));
    }
    Scene& scene = loaded_.scene;
    if (scene.mesh.empty()) throw Error(lines_.where(), "no face", "at least one 'f' line");
    if (!scene.mesh.colours.empty()) scene.mesh.colours.resize(scene.mesh.vertices.size(), Eigen::Vector3f::Ones());
    if (!scene.uv.empty())
      scene.uv.resize(scene.mesh.triangles.size(),
                      {Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()});
    loaded_.parts = std::move(part_names_.names);
    make_materials(folder);
    return std::move(loaded_);
  }

 private:
  /// Room for what the lines promise: growing step by step would take half of the time.
  void reserve(std::string_view text) {
    std::size_t vertices = 0, coordinates = 0, faces = 0;
    for (std::size_t at = 0; at + 2 < text.size(); at = std::min(text.find('\n', at), text.size() - 1) + 1) {
      vertices += text[at] == 'v' && text[at + 1] == ' ';
      coordinates += text[at] == 'v' && text[at + 1] == 't';
      faces += text[at] == 'f';
    }
    const std::size_t most = text.size() / 8;  // the shortest line that is whole: "f 1 2 3"
    faces = std::min({faces, most, limits_.triangles});
    loaded_.scene.mesh.vertices.reserve(std::min(vertices, most));
    loaded_.scene.mesh.triangles.reserve(faces);
    loaded_.scene.material.reserve(faces);
    loaded_.part.reserve(faces);
    uv_.reserve(std::min(coordinates, most));
    if (coordinates != 0) loaded_.scene.uv.reserve(faces);
  }
  /// Names in the order in which they were first met.
  struct Names {
    std::vector<std::string> names;
    std::unordered_map<std::string, std::uint32_t> index;
  };
  static std::uint32_t index_of(Names& all, const std::string& name) {
    const auto [it, fresh] = all.index.emplace(name, static_cast<std::uint32_t>(all.names.size()));
    if (fresh) all.names.push_back(name);
    return it->second;
  }

  void vertex() {
    TriangleMesh& mesh = loaded_.scene.mesh;
    const Eigen::Vector3f v = lines_.numbers<3>("vertex").cast<float>();
    if (!v.allFinite())
      lines_.refuse(concat("vertex ", mesh.vertices.size(), " is (", v.transpose(), ")"), "finite coordinates");
    mesh.vertices.push_back(v);
    Eigen::Vector3d c;
    if (!lines_.number(c[0]) || !lines_.number(c[1])) return;  // a weight, which polygons do not have
    if (!lines_.number(c[2])) lines_.refuse("5 numbers of a vertex", "3, or 6 with its colour");
    mesh.colours.resize(mesh.vertices.size(), Eigen::Vector3f::Ones());
    mesh.colours.back() = bounded(c, "vertex colours");
  }
  Eigen::Vector3f bounded(const Eigen::Vector3d& colour, std::string_view what) {
    if ((colour.array() >= 0).all() && (colour.array() <= 1).all()) return colour.cast<float>();
    if (!colour.allFinite()) lines_.refuse("a colour that is not finite", "in [0, 1]");
    loaded_.note(concat(lines_.where(), ": ", what, " outside of [0, 1] are cut off"));
    return colour.cwiseMax(0).cwiseMin(1).cast<float>();
  }
  void texture_coordinates() {
    double v = 0;
    const double u = lines_.numbers<1>("texture coordinate")[0];
    lines_.number(v);
    const Eigen::Vector2f uv(static_cast<float>(u), static_cast<float>(v));
    if (!uv.allFinite()) lines_.refuse("texture coordinates that are not finite", "finite numbers");
    uv_.push_back(uv);
  }

  struct Corner {
    std::uint32_t vertex = 0;
    std::optional<std::uint32_t> uv = std::nullopt;
  };
  void face() {
    Scene& scene = loaded_.scene;
    corners_.clear();
    for (std::string_view w = lines_.word(); !w.empty() && w[0] != '#'; w = lines_.word())
      corners_.push_back(corner(w));
    if (corners_.size() < 3) lines_.refuse(concat("a face of ", corners_.size(), " corners"), "3 or more");
    if (scene.mesh.triangles.size() + corners_.size() - 2 > limits_.triangles)
      lines_.refuse(concat("more than ", limits_.triangles, " triangles"), "fewer");
    if (!part_) part_ = index_of(part_names_, "");
    if (!material_) material_ = index_of(material_names_, "");
    for (std::size_t k = 1; k + 1 < corners_.size(); ++k) {
      const std::array<Corner, 3> t = {corners_[0], corners_[k], corners_[k + 1]};
      scene.mesh.triangles.push_back({t[0].vertex, t[1].vertex, t[2].vertex});
      scene.material.push_back(*material_);
      loaded_.part.push_back(*part_);
      if (!t[0].uv || !t[1].uv || !t[2].uv) continue;
      scene.uv.resize(scene.mesh.triangles.size(),
                      {Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()});
      scene.uv.back() = {uv_[*t[0].uv], uv_[*t[1].uv], uv_[*t[2].uv]};
    }
  }
  /// v, v/vt, v//vn or v/vt/vn.
  Corner corner(std::string_view w) {
    Corner c{index(w, loaded_.scene.mesh.vertices.size(), "vertex")};
    if (w.starts_with('/')) {
      w.remove_prefix(1);
      if (!w.starts_with('/') && !w.empty()) c.uv = index(w, uv_.size(), "texture coordinates");
    }
    if (w.starts_with('/')) w.remove_prefix(std::min(w.find_first_not_of("-0123456789", 1), w.size()));
    if (!w.empty()) lines_.refuse(concat("'", printable(w, 16), "' in a face"), "v, v/vt, v//vn or v/vt/vn");
    return c;
  }
  /// Takes an index that counts from 1, or backwards from -1.
  std::uint32_t index(std::string_view& w, std::size_t size, std::string_view what) const {
    std::int64_t i = 0;
    const auto [end, failed] = std::from_chars(w.data(), w.data() + w.size(), i);
    if (failed != std::errc{}) lines_.refuse(concat("'", printable(w, 16), "' in a face"), "v, v/vt, v//vn or v/vt/vn");
    w.remove_prefix(static_cast<std::size_t>(end - w.data()));
    const auto n = static_cast<std::int64_t>(size);
    if (i == 0 || i > n || i < -n)
      lines_.refuse(concat("a face uses ", what, " ", i), concat("1 to ", n, ", or -", n, " to -1"));
    return static_cast<std::uint32_t>(i > 0 ? i - 1 : n + i);
  }

  void part(bool object) {
    if (objects_ && !object) return;
    objects_ = object;
    part_ = index_of(part_names_, std::string(lines_.rest()));
  }
  void add_library(const Library& library) {
    const std::string name(lines_.rest());
    if (!libraries_.insert(name).second) return;
    const std::optional<std::string> text = library(name);
    if (!text)
      return loaded_.note(concat(lines_.where(), ": there is no '", printable(name), "'; its materials are grey"));
    const std::filesystem::path folder = std::filesystem::path(name).parent_path();
    std::map<std::string, MtlMaterial> materials = parse_mtl(*text, name);
    for (auto& [material, known] : materials) {
      std::string& file = known.texture;
      std::replace(file.begin(), file.end(), '\\', '/');
      if (!file.empty()) file = (folder / file).string();
    }
    known_.merge(materials);
  }
  void make_materials(const std::filesystem::path& folder) {
    TextureLoader textures(limits_);
    for (const std::string& name : material_names_.names) {
      Material material{.name = name.empty() ? "default" : name};
      const auto known = known_.find(name);
      if (known != known_.end()) {
        material.colour = bounded(known->second.colour, "colours of materials");
        if (const std::string& file = known->second.texture; !file.empty())
          material.texture = textures.from_file(folder / file);
        if (known->second.transparent) loaded_.note(concat(lines_.where(), ": transparent materials are opaque"));
      } else if (!name.empty() && !known_.empty()) {
        loaded_.note(concat(lines_.where(), ": no material '", printable(name), "'; it is grey"));
      }
      loaded_.scene.materials.push_back(std::move(material));
    }
    textures.load(loaded_);
    if (loaded_.scene.textures.empty()) loaded_.scene.uv.clear();
  }

  ObjLines lines_;
  SceneLimits limits_;
  std::vector<Eigen::Vector2f> uv_;
  std::vector<Corner> corners_;
  Names part_names_, material_names_;
  std::optional<std::uint32_t> part_, material_;
  bool objects_ = false;
  std::set<std::string> libraries_;
  std::map<std::string, MtlMaterial> known_;
  LoadedScene loaded_;
};

/// Reads an OBJ file with its MTL files and textures, axes as they are. Throws Error, naming the line, for a vertex
/// that is not finite, an index that does not exist or text that is no OBJ. O(bytes); textures are decoded
/// concurrently.
inline LoadedScene read_obj(const std::filesystem::path& path, const SceneLimits& limits = {}) {
  const std::filesystem::path folder = path.parent_path();
  const std::string text = read_file(path, limits.bytes);
  const auto library = [&](const std::string& name) -> std::optional<std::string> {
    if (!file_exists(folder / name)) return std::nullopt;
    return read_file(folder / name, limits.bytes);
  };
  return ObjReader(text, path.string(), limits).read(library, folder);
}

}  // namespace vantage
