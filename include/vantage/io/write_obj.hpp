// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/io/file.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/io/png.hpp>

namespace vantage {

namespace detail {

/// Appends " x" for each number, as short as it can be to be read back bit for bit.
template <class Vector>
void append_numbers(std::string& text, const Vector& v) {
  char digits[32];
  for (Eigen::Index k = 0; k < v.size(); ++k) {
    text += ' ';
    text.append(digits, std::to_chars(digits, digits + sizeof digits, v[k]).ptr);
  }
}
/// A name as one line of a text file can hold it.
inline std::string on_one_line(std::string name) {
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 0x20 || c == '\\') c = '_';
  return name;
}
inline void append_vertices(std::string& text, const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    text += 'v';
    append_numbers(text, mesh.vertices[i]);
    if (!mesh.colours.empty()) append_numbers(text, mesh.colours[i]);
    text += '\n';
  }
}

}  // namespace detail

/// A mesh as Wavefront OBJ, axes as they are, with its colours behind the vertices (a habit of many programs, no part
/// of the format). Throws Error if the mesh is not valid.
inline std::string encode_obj(const TriangleMesh& mesh) {
  mesh.validate("encode_obj");
  std::string text;
  detail::append_vertices(text, mesh);
  for (const auto& [a, b, c] : mesh.triangles) text += concat("f ", a + 1, " ", b + 1, " ", c + 1, "\n");
  return text;
}
inline void write_obj(const std::filesystem::path& path, const TriangleMesh& mesh) {
  write_file(path, encode_obj(mesh));
}

/// Writes a scene as NAME.obj, NAME.mtl and its textures NAME_0.png, ...; an object of the OBJ is a run of triangles of
/// one class, with that class' name. Throws Error if the scene is not valid.
inline void write_obj(const std::filesystem::path& path, const Scene& scene) {
  scene.validate("write_obj");
  const std::string stem = path.stem().string();
  const auto picture = [&](std::size_t i) { return concat(stem, "_", i, ".png"); };
  const auto name = [&](std::size_t i) { return concat(i, " ", detail::on_one_line(scene.materials[i].name)); };
  std::string mtl;
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    mtl += concat("newmtl ", name(i), "\nKd");
    detail::append_numbers(mtl, scene.materials[i].colour);
    mtl += '\n';
    if (scene.materials[i].texture) mtl += concat("map_Kd ", picture(*scene.materials[i].texture), "\n");
  }
  for (std::size_t i = 0; i < scene.textures.size(); ++i)
    write_png(path.parent_path() / picture(i), to_picture(scene.textures[i]));

  std::string text = concat("mtllib ", stem, ".mtl\n");
  detail::append_vertices(text, scene.mesh);
  for (const auto& corners : scene.uv)
    for (const Eigen::Vector2f& c : corners) {
      text += "vt";
      detail::append_numbers(text, c);
      text += '\n';
    }
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    const auto changes = [&](const auto& of_each) {
      return !of_each.empty() && (t == 0 || of_each[t] != of_each[t - 1]);
    };
    if (changes(scene.label)) text += concat("o ", detail::on_one_line(scene.classes[scene.label[t]]), "\n");
    if (t == 0 || changes(scene.material))
      text += concat("usemtl ", name(scene.material.empty() ? 0 : scene.material[t]), "\n");
    text += 'f';
    for (std::size_t k = 0; k < 3; ++k) {
      text += concat(" ", scene.mesh.triangles[t][k] + 1);
      if (!scene.uv.empty()) text += concat("/", 3 * t + k + 1);
    }
    text += '\n';
  }
  write_file(path.parent_path() / (stem + ".mtl"), mtl);
  write_file(path, text);
}

}  // namespace vantage
