// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/scene_file.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include <vantage/io/write_ply.hpp>

#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

/// Signed volume [m^3] that the triangles enclose: positive if they are counter-clockwise from outside.
double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto [a, b, c] = mesh.corners(i);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

Scene describe(const std::string& text) {
  const test::TemporaryFolder folder;
  return read_scene(folder.put("scene.json", text));
}

TEST(SceneFile, BoxesAndARoomByHand) {
  const Scene s = describe(R"({"room": {"min": [-2, -2, 0], "max": [2, 2, 3], "colour": [0.9, 0.9, 0.8]},
    "boxes": [{"min": [0, 0, 0], "max": [1, 2, 0.5], "class": "table", "colour": [1, 0, 0]},
              {"min": [-1, -1, 0], "max": [0, 0, 1]}],
    "start": {"position": [0, 1, 1.5], "yaw": 1.5707963267948966, "pitch": -0.5}})");
  EXPECT_EQ(s.classes, (std::vector<std::string>{"unknown", "wall", "floor", "ceiling", "table"}));
  EXPECT_EQ(s.mesh.triangles.size(), 36u);
  std::map<std::string, int> count;
  for (std::size_t i = 0; i < s.label.size(); ++i) {
    ++count[s.classes[s.label[i]]];
    const Eigen::Vector3d n = s.mesh.area_normal(i);
    const double up = s.classes[s.label[i]] == "floor" ? 1 : s.classes[s.label[i]] == "ceiling" ? -1 : 0;
    EXPECT_GE(up * n.z(), 4 * std::abs(up)) << "a room is seen from inside";
  }
  EXPECT_EQ(count,
            (std::map<std::string, int>{{"wall", 8}, {"floor", 2}, {"ceiling", 2}, {"table", 12}, {"unknown", 12}}));
  EXPECT_NEAR(volume(s.mesh), -48 + 1 + 1, 1e-4) << "boxes are seen from outside";
  EXPECT_EQ(s.materials.size(), 3u);
  EXPECT_EQ(s.materials[s.material[12]].colour, Eigen::Vector3f(1, 0, 0));
  ASSERT_TRUE(s.start);
  check_view(*s.start, "start");
  EXPECT_EQ(s.start->position(), Eigen::Vector3d(0, 1, 1.5));
  EXPECT_TRUE(s.start->forward().isApprox(Eigen::Vector3d(0, std::cos(0.5), -std::sin(0.5))));
  EXPECT_NEAR(s.start->T_W_C.linear().col(0).z(), 0, 1e-12) << "upright";
  EXPECT_LT(s.start->T_W_C.linear().col(1).z(), 0);
}

TEST(SceneFile, ClassesOfAMeshByItsParts) {
  const test::TemporaryFolder folder;
  folder.put("scene.obj", "o a\nv 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\no b\nf 1 2 3\nf 1 2 3\no c\nf 3 2 1\n");
  folder.put(
      "scene.json",
      R"({"classes": ["x", "y"], "class": "x", "instances": [{"id": "b", "class": "y"}, {"id": "?", "class": "x"}],
                               "boxes": [{"min": [0, 0, 0], "max": [1, 1, 1], "class": "y"}], "up": "y"})");
  const Scene s = read_scene(folder.path());
  EXPECT_EQ(s.classes, (std::vector<std::string>{"unknown", "x", "y"}));
  EXPECT_EQ(std::vector<std::uint16_t>(s.label.begin(), s.label.begin() + 5),
            (std::vector<std::uint16_t>{1, 2, 2, 1, 2}));
  EXPECT_EQ(s.mesh.vertices[2], Eigen::Vector3f(0, 0, 2)) << "y is up in the mesh, but not in the boxes";
  EXPECT_EQ(s.mesh.bounds().max(), Eigen::Vector3d(1, 1, 2));
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_EQ(s.notes[0], "'?' is in the description, but not in the mesh");
}

TEST(SceneFile, ReadsPlyByItsName) {
  const test::TemporaryFolder folder;
  write_ply(folder.path() / "m.PLY",
            TriangleMesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
  const Scene s = read_scene(folder.path() / "m.PLY");
  EXPECT_EQ(s.mesh.colours[1], Eigen::Vector3f(0, 1, 0));
  EXPECT_EQ(s.materials[0].colour, Eigen::Vector3f(1, 1, 1)) << "a factor of the vertices' colours";
  folder.put("d.json", R"({"mesh": "m.PLY", "class": "flag"})");
  EXPECT_EQ(read_scene(folder.path() / "d.json").label, std::vector<std::uint16_t>{1});
}

TEST(SceneFile, RefusesWithTheWayToIt) {
  EXPECT_REFUSED(describe(R"({"classes": ["chair"], "boxes": [{"min": [0,0,0], "max": [1,1,1], "class": "chiar"}]})"),
                 "scene.json: /boxes/0/class: unknown class 'chiar'; expected one of chair");
  EXPECT_REFUSED(describe(R"({"boxes": [{"min": [0,0,0], "max": [1,-1,1]}]})"), "/boxes/0: a box inside out");
  EXPECT_REFUSED(describe(R"({"boxes": [{"min": [0,0,0]}]})"), "/boxes/0: no 'max'");
  EXPECT_REFUSED(describe(R"({"boxes": [{"min": [0,0], "max": [1,1,1]}]})"),
                 "/boxes/0/min: 2 elements; expected 3 numbers");
  EXPECT_REFUSED(describe(R"({"boxes": [{"min": [0,0,0], "max": [1,1,1], "colour": [1,2,0]}]})"),
                 "/boxes/0/colour/1: 2");
  EXPECT_REFUSED(describe(R"({"classes": ["a"], "room": {"min": [0,0,0], "max": [1,1,1]}})"), "does not list 'wall'");
  EXPECT_REFUSED(describe(R"({"boxes": [{"min": [0,0,0], "max": [1,1,1]}], "start": {"position": [0, 0]}})"),
                 "/start/position");
  EXPECT_REFUSED(describe(R"({"up": "x"})"), "/up: 'x'; expected y or z");
  EXPECT_REFUSED(describe("{}"), "the scene has no triangle");
  EXPECT_REFUSED(describe("{"), "scene.json:1: ends at byte 1");
  EXPECT_REFUSED(describe(R"({"mesh": "none.obj"})"), "none.obj: no such file");
  EXPECT_REFUSED(describe(R"({"mesh": "m.blend"})"), "m.blend: no such file or folder");
  const test::TemporaryFolder folder;
  EXPECT_REFUSED(read_scene(folder.put("m.blend", "")), "a file of kind 'blend'; expected obj, gltf, glb, ply");
  EXPECT_REFUSED(read_scene(folder.path()), "a folder without a scene; expected scene.json or object.json");
  EXPECT_REFUSED(read_scene(folder.path() / "no.obj"), "no.obj: no such file");
  EXPECT_REFUSED(read_scene(folder.path() / "nowhere"), "nowhere: no such file or folder");
  folder.put("scene.obj", "o a\nv 0 0 0\nv 1 0 0\nv 0 2 0\nf 1 2 3\n");
  folder.put("scene.json", R"({"instances": [{"id": "a", "class": "x"}, {"id": "a", "class": "y"}]})");
  EXPECT_REFUSED(read_scene(folder.path()), "/instances/1/id: a second 'a'");
}

/// Folders of the shared data that hold scenes or objects, each with what its description says.
std::vector<fs::path> shared_scenes() {
  std::vector<fs::path> all;
  for (const char* kind : {"scenes", "captures", "objects"})
    if (const fs::path root = fs::path(VANTAGE_DATA_DIR) / kind; fs::is_directory(root))
      for (const auto& entry : fs::directory_iterator(root)) all.push_back(entry.path());
  std::sort(all.begin(), all.end());
  return all;
}

TEST(SceneFile, AllSharedScenesAreAsTheirDescriptionsSay) {
  if (std::string(VANTAGE_DATA_DIR).empty()) GTEST_SKIP() << "no folder of shared data (VANTAGE_DATA_DIR)";
  const std::vector<fs::path> folders = shared_scenes();
  ASSERT_GE(folders.size(), 30u);
  for (const fs::path& folder : folders) {
    SCOPED_TRACE(folder.string());
    const bool object = fs::exists(folder / "object.json");
    const nlohmann::json json = read_json(folder / (object ? "object.json" : "scene.json"));
    const Scene s = read_scene(folder);
    const std::size_t said = json["triangles"], lines = [&] {
      const std::string text = read_file(folder / (object ? "model.obj" : "scene.obj"), std::size_t{1} << 30);
      std::size_t n = 0;
      for (std::size_t at = text.find("\nf "); at != text.npos; at = text.find("\nf ", at + 1)) ++n;
      return n;
    }();
    EXPECT_EQ(s.mesh.triangles.size(), lines) << "they are triangles already";
    EXPECT_LE(s.mesh.triangles.size(), said);
    EXPECT_GE(static_cast<double>(s.mesh.triangles.size()), 0.985 * static_cast<double>(said))
        << "some were degenerate";
    EXPECT_EQ(s.textures.size(), json["textures"].get<std::size_t>());
    for (const std::string& note : s.notes) EXPECT_NE(note.find("transparent materials"), std::string::npos) << note;
    std::map<std::string, std::size_t> triangles;  // of each class
    for (const std::uint16_t l : s.label) ++triangles[s.classes[l]];
    const Box3 bounds = s.mesh.bounds();
    if (object) {
      EXPECT_EQ(triangles, (std::map<std::string, std::size_t>{{json["class"], s.mesh.triangles.size()}}));
      EXPECT_NEAR(bounds.sizes().maxCoeff(), 1, 2e-4);
      EXPECT_LT(bounds.center().norm(), 2e-4);
      continue;
    }
    EXPECT_EQ(s.classes.size(), json["classes"].size() + 1);
    std::map<std::string, std::size_t> expected;
    for (const auto& instance : json["instances"])
      expected[instance["class"]] += instance["triangles"].get<std::size_t>();
    for (const auto& [name, n] : expected) {
      EXPECT_LE(triangles[name], n) << name;
      EXPECT_GE(static_cast<double>(triangles[name]) + 16, 0.9 * static_cast<double>(n)) << name;
    }
    EXPECT_EQ(triangles.count("unknown"), 0u);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(bounds.min()[k], json["bounding_box_mesh"]["min"][static_cast<std::size_t>(k)].get<double>(), 2e-3);
      EXPECT_NEAR(bounds.max()[k], json["bounding_box_mesh"]["max"][static_cast<std::size_t>(k)].get<double>(), 2e-3);
    }
    ASSERT_TRUE(s.start);
    EXPECT_TRUE(bounds.contains(s.start->position()));
  }
}

}  // namespace
}  // namespace vantage
