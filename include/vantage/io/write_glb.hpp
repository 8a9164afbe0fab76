// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <vantage/core/error.hpp>
#include <vantage/core/srgb.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/json.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/io/png.hpp>

namespace vantage {

/// Builds the JSON and the one buffer of a binary glTF 2.0 file. World coordinates, z up, become glTF's, y up; colours
/// become linear.
class GlbWriter {
 public:
  GlbWriter() {
    json_["asset"] = {{"version", "2.0"}, {"generator", "vantage"}};
    json_["scene"] = 0;
    json_["scenes"] = {{{"nodes", {0}}}};
    json_["nodes"] = {{{"mesh", 0}}};
    json_["meshes"] = {{{"primitives", nlohmann::json::array()}}};
  }

  /// The index of a new material; `texture` is one of add_picture's or -1.
  std::size_t add_material(const std::string& name, const Eigen::Vector3f& colour, int texture = -1) {
    nlohmann::json base = {
        {"baseColorFactor", {srgb_linear(colour[0]), srgb_linear(colour[1]), srgb_linear(colour[2]), 1}},
        {"metallicFactor", 0},
        {"roughnessFactor", 1}};
    if (texture >= 0) base["baseColorTexture"] = {{"index", texture}};
    json_["materials"].push_back({{"name", name}, {"pbrMetallicRoughness", base}, {"doubleSided", true}});
    return json_["materials"].size() - 1;
  }
  int add_picture(const Picture& picture) {
    const std::vector<std::byte> png = encode_png(picture);
    json_["images"].push_back({{"bufferView", add_view(png, 0)}, {"mimeType", "image/png"}});
    json_["textures"].push_back({{"source", json_["images"].size() - 1}});
    return static_cast<int>(json_["textures"].size() - 1);
  }
  /// Triangles of one material; `colours` and `uv` are one a vertex, or none.
  void add_primitive(std::span<const Eigen::Vector3f> vertices, std::span<const std::uint32_t> indices,
                     std::span<const Eigen::Vector3f> colours, std::span<const Eigen::Vector2f> uv,
                     std::size_t material) {
    std::vector<Eigen::Vector3f> y_up;
    Eigen::AlignedBox3f box;
    for (const Eigen::Vector3f& v : vertices) box.extend(y_up.emplace_back(v.x(), v.z(), -v.y()));
    nlohmann::json attributes;
    attributes["POSITION"] = add_accessor(std::as_bytes(std::span(y_up)), y_up.size(), "VEC3", 5126, 34962);
    json_["accessors"].back()["min"] = {box.min().x(), box.min().y(), box.min().z()};
    json_["accessors"].back()["max"] = {box.max().x(), box.max().y(), box.max().z()};
    if (!colours.empty()) {
      std::vector<std::array<std::uint16_t, 4>> rgba;
      const auto step = [](float c) { return static_cast<std::uint16_t>(std::lround(65535 * srgb_linear(c))); };
      for (const Eigen::Vector3f& c : colours) rgba.push_back({step(c[0]), step(c[1]), step(c[2]), 65535});
      attributes["COLOR_0"] = add_accessor(std::as_bytes(std::span(rgba)), rgba.size(), "VEC4", 5123, 34962);
      json_["accessors"].back()["normalized"] = true;
    }
    if (!uv.empty()) {
      std::vector<Eigen::Vector2f> down;  // glTF: v = 0 is the top
      for (const Eigen::Vector2f& c : uv) down.emplace_back(c.x(), 1 - c.y());
      attributes["TEXCOORD_0"] = add_accessor(std::as_bytes(std::span(down)), down.size(), "VEC2", 5126, 34962);
    }
    const std::size_t index = add_accessor(std::as_bytes(indices), indices.size(), "SCALAR", 5125, 34963);
    json_["meshes"][0]["primitives"].push_back(
        {{"attributes", attributes}, {"indices", index}, {"material", material}});
  }
  /// The file's bytes. Throws Error if they are 4 GB or more.
  [[nodiscard]] std::string take() && {
    json_["buffers"] = {{{"byteLength", buffer_.size()}}};
    std::string text = json_text(json_);
    text.append((4 - text.size() % 4) % 4, ' ');
    const std::size_t size = 28 + text.size() + buffer_.size();
    if (size > 0xFFFFFFFF) throw Error("GlbWriter", concat(size, " bytes"), "less than 4 GB");
    std::string file = "glTF";
    const auto put = [&](std::size_t value) {
      for (int i = 0; i < 4; ++i) file.push_back(static_cast<char>(value >> (8 * i)));
    };
    put(2);
    put(size);
    put(text.size());
    file.append("JSON").append(text);
    put(buffer_.size());
    file.append("BIN\0", 4).append(buffer_);
    return file;
  }

 private:
  std::size_t add_view(std::span<const std::byte> bytes, int target) {
    nlohmann::json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
    if (target != 0) view["target"] = target;
    json_["bufferViews"].push_back(view);
    buffer_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    buffer_.append((4 - buffer_.size() % 4) % 4, '\0');
    return json_["bufferViews"].size() - 1;
  }
  std::size_t add_accessor(std::span<const std::byte> bytes, std::size_t count, const char* type, int component,
                           int target) {
    json_["accessors"].push_back(
        {{"bufferView", add_view(bytes, target)}, {"componentType", component}, {"count", count}, {"type", type}});
    return json_["accessors"].size() - 1;
  }

  nlohmann::json json_;
  std::string buffer_;
};

/// A mesh as binary glTF 2.0 with its colours, if any. Throws Error if it is not valid or has no triangle.
inline std::string encode_glb(const TriangleMesh& mesh) {
  mesh.validate("encode_glb");
  if (mesh.empty()) throw Error("encode_glb", "no triangle", "at least one");
  GlbWriter out;
  const std::size_t material =
      out.add_material("default", mesh.colours.empty() ? Eigen::Vector3f::Constant(0.8F) : Eigen::Vector3f::Ones());
  out.add_primitive(mesh.vertices, std::span(mesh.triangles.front().data(), 3 * mesh.triangles.size()), mesh.colours,
                    {}, material);
  return std::move(out).take();
}

/// A scene as binary glTF 2.0 with its materials and textures (PNG inside); classes have no place in it. Throws Error
/// if it is not valid.
inline std::string encode_glb(const Scene& scene) {
  scene.validate("encode_glb");
  GlbWriter out;
  std::vector<int> textures;
  for (const Texture& t : scene.textures) textures.push_back(out.add_picture(to_picture(t)));
  std::vector<std::vector<std::size_t>> triangles(scene.materials.size());
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t)
    triangles[scene.material.empty() ? 0 : scene.material[t]].push_back(t);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const Material& material = scene.materials[m];
    const std::size_t index =
        out.add_material(material.name, material.colour, material.texture ? textures[*material.texture] : -1);
    if (triangles[m].empty()) continue;
    std::vector<Eigen::Vector3f> vertices, colours;  // three of its own for each triangle: corners differ in uv
    std::vector<Eigen::Vector2f> uv;
    std::vector<std::uint32_t> indices;
    for (const std::size_t t : triangles[m])
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = scene.mesh.triangles[t][k];
        indices.push_back(static_cast<std::uint32_t>(vertices.size()));
        vertices.push_back(scene.mesh.vertices[v]);
        if (!scene.mesh.colours.empty()) colours.push_back(scene.mesh.colours[v]);
        if (!scene.uv.empty()) uv.push_back(scene.uv[t][k]);
      }
    out.add_primitive(vertices, indices, colours, uv, index);
  }
  return std::move(out).take();
}

/// Writes a .glb file, whole or not at all.
template <class T>
void write_glb(const std::filesystem::path& path, const T& what) {
  write_file(path, encode_glb(what));
}

}  // namespace vantage
