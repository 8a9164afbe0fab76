// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <tiny_gltf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/srgb.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/gltf_accessor.hpp>
#include <vantage/io/gltf_texture_place.hpp>
#include <vantage/io/json.hpp>
#include <vantage/io/loaded_scene.hpp>
#include <vantage/io/printable.hpp>

namespace vantage {

/// Reads the triangles of glTF 2.0: nodes with their transforms, base colours and their textures (where
/// KHR_texture_transform puts them), vertex colours. glTF is y up: the scene is turned to z up. A part is a node.
/// Colours, which glTF keeps linear, become display-encoded.
class GltfReader {
 public:
  GltfReader(std::string_view bytes, std::string where, const SceneLimits& limits)
      : bytes_(bytes), where_(std::move(where)), limits_(limits) {}

  /// `folder`: what buffers and textures are relative to.
  LoadedScene read(const std::filesystem::path& folder) && {
    folder_ = folder;
    parse();
    for (const std::string& needed : model_.extensionsRequired)
      if (needed != "KHR_mesh_quantization" && needed != "KHR_materials_unlit" && needed != "KHR_texture_transform")
        throw Error(where_, concat("the extension '", printable(needed), "' is required"),
                    "none but KHR_mesh_quantization, KHR_materials_unlit, KHR_texture_transform");
    make_materials();
    std::vector<int> roots;
    const int scene = model_.defaultScene >= 0 ? model_.defaultScene : 0;
    if (static_cast<std::size_t>(scene) < model_.scenes.size()) {
      roots = model_.scenes[static_cast<std::size_t>(scene)].nodes;
    } else if (!model_.scenes.empty()) {
      throw Error(where_, concat("scene ", scene), concat("below ", model_.scenes.size()));
    }
    seen_.assign(model_.nodes.size(), false);
    Eigen::Matrix4d z_up;
    z_up << 1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1;
    for (const int root : roots) add_node(root, z_up, 0);
    if (loaded_.scene.mesh.empty()) throw Error(where_, "no triangle", "a scene with a mesh");
    textures_.load(loaded_);
    if (loaded_.scene.textures.empty()) loaded_.scene.uv.clear();
    return std::move(loaded_);
  }

 private:
  void parse() {
    const bool binary = bytes_.starts_with("glTF");
    check_container(binary);
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_image, this);
    loader.SetFsCallbacks(
        {[](const std::string& name, void*) { return file_exists(name); },
         [](const std::string& name, void*) { return name; }, read_companion,
         [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }, this});
    std::string error, warning;
    const auto size = static_cast<unsigned>(bytes_.size());
    const bool read =
        binary
            ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(bytes_.data()), size, folder_.string())
            : loader.LoadASCIIFromString(&model_, &error, &warning, bytes_.data(), size, folder_.string());
    if (!read)
      throw Error(where_, complaint_.empty() ? printable(error.substr(0, error.find('\n')), 200) : complaint_,
                  "glTF 2.0");
  }
  /// tinygltf recurses into JSON, and hands on pictures of a buffer without a look at the buffer's size: its text is
  /// bounded here, and what views promise is compared with what buffers have.
  void check_container(bool binary) {
    const JsonLimits json{.bytes = limits_.bytes};
    if (bytes_.size() > 0x7FFFFFFF) throw Error(where_, concat(bytes_.size(), " bytes"), "less than 2 GB");
    if (!binary) {
      const std::size_t first = bytes_.find_first_not_of(" \t\r\n");
      if (first == bytes_.npos || bytes_[first] != '{')
        throw Error(where_, "no glTF file", "JSON, or a file that begins with 'glTF'");
      return take_json(parse_json(bytes_, where_, json));
    }
    const auto number = [&](std::size_t at) {
      if (at + 4 > bytes_.size())
        throw Error(where_, concat("ends at byte ", bytes_.size()), "the rest of a GLB header");
      std::uint32_t value = 0;
      std::memcpy(&value, bytes_.data() + at, sizeof value);
      return std::size_t{value};
    };
    const std::size_t version = number(4), length = number(8), text = number(12);
    if (version != 2) throw Error(where_, concat("version ", version, " at byte 4"), "2");
    if (length > bytes_.size() || text + 20 > bytes_.size())
      throw Error(where_, concat("ends at byte ", bytes_.size()), concat(std::max(length, text + 20), " bytes"));
    if (number(16) != 0x4E4F534A) throw Error(where_, "no JSON chunk at byte 12", "JSON first");
    take_json(parse_json(bytes_.substr(20, text), where_ + ", JSON chunk", json));
  }
  /// Where textures are looked up is read from the text itself: a number that is none is refused with the way to it.
  void take_json(const nlohmann::json& json) {
    const JsonItem root(json, where_);
    check_views(root);
    if (const auto materials = root.find("materials"))
      materials->each([&](const JsonItem& material) {
        const auto model = material.find("pbrMetallicRoughness");
        const auto info = model ? model->find("baseColorTexture") : std::optional<JsonItem>();
        places_.push_back(info ? GltfTexturePlace(*info) : GltfTexturePlace());
      });
  }
  static void check_views(const JsonItem& root) {
    const auto views = root.find("bufferViews"), buffers = root.find("buffers");
    if (!views) return;
    views->each([&](const JsonItem& view) {
      if (!buffers) view.refuse("there is no buffer", "'buffers'");
      const JsonItem buffer = buffers->at(view.at("buffer").count(std::size_t{1} << 31));
      const std::size_t size = buffer.at("byteLength").count(std::size_t{1} << 31);
      const auto offset = view.find("byteOffset");
      const std::size_t begin = offset ? offset->count(size) : 0, length = view.at("byteLength").count(size);
      if (length == 0 || length > size - begin)
        view.refuse(concat(length, " bytes from byte ", begin, " of a buffer"), concat("1 or more, within ", size));
    });
  }
  /// In place of a decoder of tinygltf's: pictures wait for ours.
  static bool keep_image(tinygltf::Image* image, const int, std::string*, std::string*, int, int,
                         const unsigned char* data, int size, void*) {
    image->image.assign(data, data + std::max(size, 0));
    return true;
  }
  static bool read_companion(std::vector<unsigned char>* out, std::string* error, const std::string& name, void* self) {
    auto& reader = *static_cast<GltfReader*>(self);
    try {
      const std::string bytes = read_file(name, reader.limits_.bytes);
      out->assign(bytes.begin(), bytes.end());
      return true;
    } catch (const Error& e) {
      reader.complaint_ = *error = e.what();
      return false;
    }
  }

  static float encoded(double linear) { return static_cast<float>(srgb_encoded(linear)); }
  void make_materials() {
    // As many, whatever tinygltf made of the text.
    places_.resize(model_.materials.size());
    Scene& scene = loaded_.scene;  // materials[0] is the default, which glTF wants white
    scene.materials[0].colour.setOnes();
    for (std::size_t i = 0; i < model_.materials.size(); ++i) {
      const tinygltf::Material& m = model_.materials[i];
      const std::vector<double>& factor = m.pbrMetallicRoughness.baseColorFactor;
      Material material{.name = m.name.empty() ? concat("material ", i) : m.name};
      material.colour.setOnes();
      for (std::size_t k = 0; k < 3 && k < factor.size(); ++k) {
        if (!std::isfinite(factor[k]))
          throw Error(where_, concat("material ", i, " has a colour that is not finite"), "in [0, 1]");
        material.colour[static_cast<Eigen::Index>(k)] = encoded(factor[k]);
      }
      if (m.alphaMode == "BLEND") loaded_.note(concat(where_, ": transparent materials are opaque"));
      material.texture = texture(m.pbrMetallicRoughness.baseColorTexture.index);
      scene.materials.push_back(std::move(material));
    }
  }
  std::optional<std::uint32_t> texture(int index) {
    if (index < 0) return std::nullopt;
    if (static_cast<std::size_t>(index) >= model_.textures.size())
      throw Error(where_, concat("texture ", index), concat("below ", model_.textures.size()));
    const int source = model_.textures[static_cast<std::size_t>(index)].source;
    if (source < 0 || static_cast<std::size_t>(source) >= model_.images.size()) {
      loaded_.note(concat(where_, ": texture ", index, " has no picture"));
      return std::nullopt;
    }
    const tinygltf::Image& image = model_.images[static_cast<std::size_t>(source)];
    if (image.image.empty() && !image.uri.empty()) return textures_.from_file(folder_ / image.uri);
    const std::string name = concat(where_, ": picture ", source);
    return textures_.from_bytes(name, std::string(image.image.begin(), image.image.end()));
  }

  void add_node(int index, const Eigen::Matrix4d& parent, int depth) {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.nodes.size())
      throw Error(where_, concat("node ", index), concat("below ", model_.nodes.size()));
    const auto i = static_cast<std::size_t>(index);
    if (seen_[i]) throw Error(where_, concat("node ", index, " has two parents"), "a tree of nodes");
    seen_[i] = true;
    if (depth == 256) throw Error(where_, concat("node ", index, " is deeper than 256"), "a flatter tree");
    const tinygltf::Node& node = model_.nodes[i];
    const Eigen::Matrix4d to_world = parent * transform(node, index);
    if (!to_world.allFinite())
      throw Error(where_, concat("node ", index, " has a transform that is not finite"), "finite numbers");
    if (node.mesh >= 0) {
      if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
        throw Error(where_, concat("mesh ", node.mesh), concat("below ", model_.meshes.size()));
      const tinygltf::Mesh& mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
      const std::string name = !node.name.empty() ? node.name : !mesh.name.empty() ? mesh.name : concat("node ", index);
      const auto [it, fresh] = part_.emplace(name, static_cast<std::uint32_t>(loaded_.parts.size()));
      if (fresh) loaded_.parts.push_back(name);
      for (const tinygltf::Primitive& p : mesh.primitives) add_primitive(p, to_world, it->second);
    }
    for (const int child : node.children) add_node(child, to_world, depth + 1);
  }
  Eigen::Matrix4d transform(const tinygltf::Node& node, int index) const {
    const auto sized = [&](const std::vector<double>& v, std::size_t size, const char* what) {
      if (!v.empty() && v.size() != size)
        throw Error(where_, concat("node ", index, " has a ", what, " of ", v.size(), " numbers"), concat(size));
      return !v.empty();
    };
    if (sized(node.matrix, 16, "matrix")) return Eigen::Map<const Eigen::Matrix4d>(node.matrix.data());
    Eigen::Affine3d t = Eigen::Affine3d::Identity();
    if (sized(node.translation, 3, "translation"))
      t.translate(Eigen::Map<const Eigen::Vector3d>(node.translation.data()));
    if (sized(node.rotation, 4, "rotation")) {  // x, y, z, w as Eigen stores them
      const Eigen::Quaterniond q(Eigen::Map<const Eigen::Vector4d>(node.rotation.data()));
      if (!(q.norm() > 1e-6)) throw Error(where_, concat("node ", index, " has a rotation of 0"), "a unit quaternion");
      t.rotate(q.normalized());
    }
    if (sized(node.scale, 3, "scale")) t.scale(Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(node.scale.data())));
    return t.matrix();
  }

  void add_primitive(const tinygltf::Primitive& p, const Eigen::Matrix4d& to_world, std::uint32_t part) {
    const bool strip = p.mode == TINYGLTF_MODE_TRIANGLE_STRIP, fan = p.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    if (p.mode != TINYGLTF_MODE_TRIANGLES && p.mode != -1 && !strip && !fan)
      return loaded_.note(concat(where_, ": points and lines are left out"));
    const auto attribute = [&](const std::string& name, std::size_t least) -> std::optional<GltfAccessor> {
      const auto it = p.attributes.find(name);
      if (it == p.attributes.end()) return std::nullopt;
      GltfAccessor a(model_, it->second, where_);
      if (a.components() < least)
        throw Error(where_, concat(name, " of ", a.components(), " components"), concat(least));
      return a;
    };
    const auto position = attribute("POSITION", 3);
    if (!position) return loaded_.note(concat(where_, ": a primitive without positions is left out"));
    if (p.material >= 0 && static_cast<std::size_t>(p.material) >= model_.materials.size())
      throw Error(where_, concat("material ", p.material), concat("below ", model_.materials.size()));
    const GltfTexturePlace place = p.material >= 0 ? places_[static_cast<std::size_t>(p.material)] : GltfTexturePlace();
    const auto uv = attribute(concat("TEXCOORD_", place.set), 2), colour = attribute("COLOR_0", 3);
    for (const auto* other : {&uv, &colour})
      if (*other && (*other)->size() < position->size())
        throw Error(where_, concat((*other)->size(), " values of an attribute for ", position->size(), " vertices"),
                    "one each");
    const auto indices =
        p.indices >= 0 ? std::optional<GltfAccessor>(GltfAccessor(model_, p.indices, where_)) : std::nullopt;

    Scene& scene = loaded_.scene;
    const std::size_t n = indices ? indices->size() : position->size();
    const std::size_t triangles = strip || fan ? n - std::min<std::size_t>(n, 2) : n / 3;
    if (scene.mesh.triangles.size() + triangles > limits_.triangles ||
        scene.mesh.vertices.size() + position->size() > 3 * limits_.triangles)
      throw Error(where_, concat("more than ", limits_.triangles, " triangles"), "fewer");
    const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
    if (colour && scene.mesh.colours.empty()) scene.mesh.colours.resize(first, Eigen::Vector3f::Ones());
    for (std::size_t i = 0; i < position->size(); ++i) {
      const Eigen::Vector4d local(position->number(i, 0), position->number(i, 1), position->number(i, 2), 1);
      const Eigen::Vector3f v = (to_world * local).head<3>().cast<float>();
      if (!v.allFinite())
        throw Error(where_, concat("vertex ", i, " of '", printable(loaded_.parts[part]), "' is (", v.transpose(), ")"),
                    "finite coordinates");
      scene.mesh.vertices.push_back(v);
      if (colour) {
        const Eigen::Vector3f linear(colour->number(i, 0), colour->number(i, 1), colour->number(i, 2));
        if (!linear.allFinite())
          throw Error(
              where_,
              concat("vertex ", i, " of '", printable(loaded_.parts[part]), "' has a colour that is not finite"),
              "in [0, 1]");
        scene.mesh.colours.emplace_back(encoded(linear[0]), encoded(linear[1]), encoded(linear[2]));
      } else if (!scene.mesh.colours.empty()) {
        scene.mesh.colours.emplace_back(Eigen::Vector3f::Ones());
      }
    }
    const bool mirrored = to_world.topLeftCorner<3, 3>().determinant() < 0;
    const auto corner = [&](std::size_t k) {
      const std::uint32_t v = indices ? indices->index(k) : static_cast<std::uint32_t>(k);
      if (v >= position->size())
        throw Error(where_, concat("a triangle uses vertex ", v), concat("below ", position->size()));
      return v;
    };
    const std::array<Eigen::Vector2f, 3> no_uv = {Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(),
                                                  Eigen::Vector2f::Zero()};
    for (std::size_t t = 0; t < triangles; ++t) {
      std::array<std::size_t, 3> at = {3 * t, 3 * t + 1, 3 * t + 2};
      if (strip) at = t % 2 == 0 ? std::array{t, t + 1, t + 2} : std::array{t + 1, t, t + 2};
      if (fan) at = {0, t + 1, t + 2};
      std::array<std::uint32_t, 3> v = {corner(at[0]), corner(at[1]), corner(at[2])};
      if (mirrored) std::swap(v[1], v[2]);
      scene.mesh.triangles.push_back({first + v[0], first + v[1], first + v[2]});
      scene.material.push_back(static_cast<std::uint32_t>(p.material + 1));
      loaded_.part.push_back(part);
      scene.uv.push_back(no_uv);
      if (!uv) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        Eigen::Vector2f& c = scene.uv.back()[k];
        c = place({uv->number(v[k], 0), uv->number(v[k], 1)}).cast<float>();
        c.y() = 1 - c.y();  // glTF: v = 0 is the top
        if (!c.allFinite())
          throw Error(where_, concat("vertex ", v[k], " has texture coordinates that are not finite"),
                      "finite numbers");
      }
    }
  }

  std::string_view bytes_;
  std::string where_;
  SceneLimits limits_;
  std::filesystem::path folder_;
  tinygltf::Model model_;
  std::string complaint_;
  std::vector<bool> seen_;
  std::vector<GltfTexturePlace> places_;  // of each material's texture
  std::unordered_map<std::string, std::uint32_t> part_;
  TextureLoader textures_{limits_};
  LoadedScene loaded_;
};

/// Reads a .gltf or .glb file with its buffers and textures, turned from y up to z up. Throws Error; a picture that is
/// missing is a note.
inline LoadedScene read_gltf(const std::filesystem::path& path, const SceneLimits& limits = {}) {
  const std::string bytes = read_file(path, limits.bytes);
  return GltfReader(bytes, path.string(), limits).read(path.parent_path());
}

}  // namespace vantage
