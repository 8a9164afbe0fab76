// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/io/json.hpp>
#include <vantage/io/loaded_scene.hpp>
#include <vantage/io/printable.hpp>

// What a scene.json (or object.json) says. Everything may be left out; keys that are not listed do not count.
//
// clang-format off
//     {
//       "mesh": "room.obj",           a mesh beside it; else scene.obj or model.obj if there is one
//       "up": "z",                    or "y": which axis of that mesh points up (not of glTF, which says so itself)
//       "class": "car",               of all of the mesh that has no other
//       "instances": [{"id": "chair_3", "class": "chair"}, ...],   classes of the mesh's parts, by their names
//       "classes": ["chair", "floor", ...],                        or {"chair": 2, ...}; if given, there are no others
//       "room": {"min": [x, y, z], "max": [x, y, z], "colour": [r, g, b]},   seen from inside: floor, ceiling, wall
//       "boxes": [{"min": [x, y, z], "max": [x, y, z], "class": "table", "colour": [r, g, b]}, ...],
//       "start": {"position": [x, y, z], "yaw": 0, "pitch": 0}     or "start_pose"; [rad], yaw 0 looks along x
//     }
// clang-format on
//
// Metres, z up, colours in [0, 1].
namespace vantage {

/// Turns y up into z up: (x, y, z) becomes (x, -z, y).
inline void turn_y_up_to_z_up(TriangleMesh& mesh) {
  for (Eigen::Vector3f& v : mesh.vertices) v = Eigen::Vector3f(v.x(), -v.z(), v.y());
}

/// Gives a mesh, which may be empty, what a JSON text says of it.
class SceneDescription {
 public:
  SceneDescription(const JsonItem& root, LoadedScene loaded) : root_(root), loaded_(std::move(loaded)) {}

  /// Throws Error that names the way to what is wrong: a class that is not listed, a box inside out, a number too few.
  Scene apply() && {
    list_classes();
    if (const auto up = root_.find("up")) {
      if (up->text() == "y")
        turn_y_up_to_z_up(scene().mesh);
      else if (up->text() != "z")
        up->refuse(concat("'", printable(up->text()), "'"), "y or z");
    }
    label_parts();
    if (const auto room = root_.find("room")) add_room(*room);
    if (const auto boxes = root_.find("boxes")) boxes->each([&](const JsonItem& box) { add_box(box); });
    const auto start = root_.find("start") ? root_.find("start") : root_.find("start_pose");
    if (start) scene().start = view(*start);
    return std::move(loaded_.scene);
  }

 private:
  Scene& scene() { return loaded_.scene; }

  void list_classes() {
    const auto classes = root_.find("classes");
    if (!classes) return;
    const auto add = [&](const JsonItem& item, const std::string& name) {
      if (known_.size() > 0xFFFF) item.refuse("more than 65535 classes", "fewer");
      number(name);
    };
    if (classes->is_object())
      classes->each_member([&](const std::string& name, const JsonItem& i) { add(i, name); });
    else
      classes->each([&](const JsonItem& item) { add(item, item.text()); });
    closed_ = true;
  }
  std::uint16_t number(const std::string& name) {
    const auto [it, fresh] = known_.emplace(name, std::uint16_t{0});
    if (fresh) it->second = scene().class_of(name);
    return it->second;
  }
  std::uint16_t class_at(const JsonItem& item) {
    const std::string& name = item.text();
    if (closed_ && !known_.contains(name)) {
      std::string all;
      for (std::size_t i = 1; i < scene().classes.size() && all.size() < 400; ++i)
        all += concat(i == 1 ? "" : ", ", printable(scene().classes[i]));
      item.refuse(concat("unknown class '", printable(name), "'"), "one of " + all);
    }
    if (name.empty()) item.refuse("a class without a name", "a name");
    if (known_.size() > 0xFFFF) item.refuse("more than 65535 classes", "fewer");
    return number(name);
  }

  void label_parts() {
    const auto all = root_.find("class");
    const std::uint16_t otherwise = all ? class_at(*all) : std::uint16_t{0};
    std::vector<std::optional<std::uint16_t>> label(loaded_.parts.size());
    if (const auto instances = root_.find("instances")) {
      std::unordered_map<std::string, std::size_t> part;
      for (std::size_t i = 0; i < loaded_.parts.size(); ++i) part.emplace(loaded_.parts[i], i);
      instances->each([&](const JsonItem& instance) {
        const JsonItem id = instance.at("id");
        const std::uint16_t c = class_at(instance.at("class"));
        const auto it = part.find(id.text());
        if (it == part.end())
          return loaded_.note(concat("'", printable(id.text()), "' is in the description, but not in the mesh"));
        if (label[it->second]) id.refuse(concat("a second '", printable(id.text()), "'"), "one class a part");
        label[it->second] = c;
      });
      if (!all)
        for (std::size_t i = 0; i < label.size(); ++i)
          if (!label[i]) loaded_.note(concat("'", printable(loaded_.parts[i]), "' has no class"));
    }
    scene().label.resize(scene().mesh.triangles.size());
    for (std::size_t i = 0; i < scene().label.size(); ++i)
      scene().label[i] = (i < loaded_.part.size() ? label[loaded_.part[i]] : std::nullopt).value_or(otherwise);
  }

  struct Corners {
    Eigen::Vector3d min, max;
  };
  static Corners corners(const JsonItem& box) {
    Corners c{box.at("min").vector<3>(), box.at("max").vector<3>()};
    if (!(c.max.array() > c.min.array()).all()) box.refuse("a box inside out", "min below max on every axis");
    if (!(c.max - c.min).cast<float>().allFinite() || c.min.cwiseAbs().maxCoeff() > 1e9)
      box.refuse("a box that is too large", "within 1e9 m");
    return c;
  }
  std::uint32_t material(const JsonItem& box, const std::string& name) {
    Material m{.name = name};
    if (const auto colour = box.find("colour")) {
      if (colour->size() != 3) colour->refuse(concat(colour->size(), " elements"), "red, green and blue");
      for (std::size_t k = 0; k < 3; ++k)
        m.colour[static_cast<Eigen::Index>(k)] = static_cast<float>(colour->at(k).number(0, 1));
    }
    Scene& s = scene();
    if (s.mesh.empty()) s.materials.clear();  // the default, which nothing uses
    s.materials.push_back(std::move(m));
    return static_cast<std::uint32_t>(s.materials.size() - 1);
  }
  void add_box(const JsonItem& box) {
    const auto name = box.find("class");
    const std::uint16_t label = name ? class_at(*name) : std::uint16_t{0};
    const Corners c = corners(box);
    const std::uint32_t m = material(box, name ? name->text() : "box");
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) add_side(c, axis, high, high, m, label);
  }
  void add_room(const JsonItem& room) {
    const Corners c = corners(room);
    const std::uint32_t m = material(room, "room");
    for (int axis = 0; axis < 3; ++axis)
      for (const bool high : {false, true}) {
        const std::string name = axis < 2 ? "wall" : high ? "ceiling" : "floor";
        if (closed_ && !known_.contains(name))
          room.refuse(concat("'classes' does not list '", name, "'"), "floor, ceiling and wall");
        add_side(c, axis, high, !high, m, number(name));
      }
  }
  /// A rectangle across `axis`, whose normal points along it (`along`) or against it.
  void add_side(const Corners& c, int axis, bool high, bool along, std::uint32_t material, std::uint16_t label) {
    Scene& s = scene();
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;  // u x v = axis
    const auto first = static_cast<std::uint32_t>(s.mesh.vertices.size());
    for (const auto& [at_u, at_v] : {std::pair{false, false}, {true, false}, {true, true}, {false, true}}) {
      Eigen::Vector3d p;
      p[axis] = high ? c.max[axis] : c.min[axis];
      p[u] = at_u ? c.max[u] : c.min[u];
      p[v] = at_v ? c.max[v] : c.min[v];
      s.mesh.vertices.push_back(p.cast<float>());
      if (!s.mesh.colours.empty()) s.mesh.colours.push_back(Eigen::Vector3f::Ones());
    }
    // In a mesh whose triangles all have the first material, none says so.
    s.material.resize(s.mesh.triangles.size(), 0);
    using Triangle = std::array<std::uint32_t, 3>;
    for (Triangle t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}}) {
      if (!along) std::swap(t[1], t[2]);
      s.mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      s.material.push_back(material);
      s.label.push_back(label);
      if (!s.uv.empty()) s.uv.push_back({Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()});
    }
  }

  static View view(const JsonItem& start) {
    const Eigen::Vector3d position = start.at("position").vector<3>();
    const auto angle = [&](const char* name, double most) {
      const auto item = start.find(name);
      return item ? item->number(-most, most) : 0.0;
    };
    const double yaw = angle("yaw", 1e6), pitch = angle("pitch", std::numbers::pi / 2);
    if (position.cwiseAbs().maxCoeff() > 1e9) start.refuse("a position that is too far", "within 1e9 m");
    View view;  // camera x right, y down, z forward
    const Eigen::Vector3d right(std::sin(yaw), -std::cos(yaw), 0);
    const Eigen::Vector3d forward(std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch));
    view.T_W_C.linear() << right, forward.cross(right), forward;
    view.T_W_C.translation() = position;
    return view;
  }

  const JsonItem& root_;
  LoadedScene loaded_;
  std::unordered_map<std::string, std::uint16_t> known_;
  bool closed_ = false;
};

}  // namespace vantage
