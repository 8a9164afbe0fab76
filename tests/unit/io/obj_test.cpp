// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/obj.hpp>

#include <string>

#include <gtest/gtest.h>

#include <vantage/io/png.hpp>

#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace vantage {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

LoadedScene parse(std::string_view text, const std::string& mtl = "") {
  const auto library = [&](const std::string&) { return mtl.empty() ? std::nullopt : std::optional(mtl); };
  return ObjReader(text, "a.obj", {}).read(library, "nowhere");
}

constexpr std::string_view square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(Obj, ReadsFacesOfEveryForm) {
  const LoadedScene s = parse(std::string(square) +
                              "vt 0 0\nvt 1 0.5\nvn 0 0 1\nf 1 2 3\nf 1/1 2/2 3/1\r\nf 1//1 2//1 3//1\n"
                              "f 1/1/1 2/1/1 3/2/1\nf -4 -3 -2 -1 # a comment\nf 1 \\\n2 3\n");
  EXPECT_EQ(s.scene.mesh.triangles,
            (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
  EXPECT_EQ(s.scene.mesh.vertices[2], Eigen::Vector3f(1, 1, 0));
  s.scene.validate("a");
}

TEST(Obj, TellsPartsAndMaterialsApart) {
  const LoadedScene s = parse(std::string(square) +
                                  "f 1 2 3\no chair 1\nusemtl wood\nf 1 2 3\nf 1 3 4\ng leg\nusemtl iron\n"
                                  "f 1 2 3\no table\nf 1 2 3\no chair 1\nf 1 2 3\n",
                              "newmtl iron\nKd 0.1 0.2 0.3\nd 0.5\nnewmtl unused\nKd 1 1 1\n");
  EXPECT_EQ(s.parts, (std::vector<std::string>{"", "chair 1", "table"}));
  EXPECT_EQ(s.part, (std::vector<std::uint32_t>{0, 1, 1, 1, 2, 1}));
  ASSERT_EQ(s.scene.materials.size(), 3u);
  EXPECT_EQ(s.scene.materials[2].name, "iron");
  EXPECT_EQ(s.scene.material, (std::vector<std::uint32_t>{0, 1, 1, 2, 2, 2}));
  EXPECT_TRUE(s.scene.notes.empty()) << "no mtllib, no complaint about materials";

  const LoadedScene with =
      parse(std::string("mtllib a.mtl\n") + std::string(square) + "usemtl iron\nf 1 2 3\nusemtl gold\nf 1 2 3\n",
            "newmtl iron\nKd 0.1 0.2 0.3\nd 0.5\n");
  EXPECT_TRUE(with.scene.materials[0].colour.isApprox(Eigen::Vector3f(0.1F, 0.2F, 0.3F)));
  EXPECT_EQ(with.scene.notes, (std::vector<std::string>{"a.obj: transparent materials are opaque",
                                                        "a.obj: no material 'gold'; it is grey"}));
  EXPECT_EQ(parse("g leg\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n").parts, std::vector<std::string>{"leg"});
}

TEST(Obj, ReadsVertexColours) {
  const LoadedScene s = parse("v 0 0 0 1 0 0.5\nv 1 0 0\nv 1 1 0 0 2 0\nf 1 2 3\n");
  ASSERT_EQ(s.scene.mesh.colours.size(), 3u);
  EXPECT_EQ(s.scene.mesh.colours[0], Eigen::Vector3f(1, 0, 0.5F));
  EXPECT_EQ(s.scene.mesh.colours[1], Eigen::Vector3f(1, 1, 1));
  EXPECT_EQ(s.scene.mesh.colours[2], Eigen::Vector3f(0, 1, 0));
  EXPECT_EQ(s.scene.notes.size(), 1u) << "colours above 1";
}

TEST(Obj, ReadsTexturesAndReplacesWhatIsMissing) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "tex");
  write_png(folder.path() / "tex" / "a b.png", Picture(3, 2, {10, 20, 30}));
  folder.put("broken.jpg", "\xFF\xD8\xFF");
  folder.put("m.mtl",
             "newmtl one\nKd 1 1 1\nmap_Kd -s 1 1 1 -clamp on tex\\a b.png\nnewmtl two\nKd 0.5 0 0\nmap_Kd none.png\n"
             "newmtl three\nmap_Kd none.png\nnewmtl four\nmap_Kd broken.jpg\n");
  const auto path = folder.put("m.obj",
                               "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0.25 0.75\nusemtl two\nf 1/1 2/1 3/1\n"
                               "usemtl one\nf 1/1 2/1 3/1\nusemtl three\nf 1 2 3\nusemtl four\nf 1 2 3\n");
  const Scene s = read_obj(path).scene;
  s.validate("m");
  ASSERT_EQ(s.textures.size(), 1u);
  EXPECT_EQ(s.textures[0].rgb[5], (Rgb{10, 20, 30}));
  EXPECT_FALSE(s.materials[0].texture);
  EXPECT_EQ(s.materials[0].colour, Eigen::Vector3f(0.5F, 0, 0));
  EXPECT_EQ(s.materials[1].texture, 0u);
  EXPECT_EQ(s.uv[1][2], Eigen::Vector2f(0.25F, 0.75F));
  ASSERT_EQ(s.notes.size(), 2u) << "each once";
  EXPECT_NE(s.notes[0].find("none.png: no such file"), std::string::npos) << s.notes[0];
  EXPECT_NE(s.notes[1].find("broken.jpg: ends at byte 3"), std::string::npos) << s.notes[1];
  EXPECT_REFUSED(read_obj(path, {.texture_pixels = 5}), "6 pixels in all; expected at most 5");

  const auto long_name =
      folder.put("l.obj", "mtllib " + std::string(5000, 'm') + "\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n");
  EXPECT_EQ(read_obj(long_name).scene.notes.size(), 1u) << "a name that no file can have";

  const Scene plain = parse("mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n").scene;
  ASSERT_EQ(plain.notes.size(), 1u);
  EXPECT_EQ(plain.notes[0], "a.obj: there is no 'x.mtl'; its materials are grey");
}

TEST(Obj, TexturesAreRelativeToTheirMtlFile) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "looks" / "tex");
  write_png(folder.path() / "looks" / "tex" / "a.png", Picture(3, 2, {10, 20, 30}));
  write_png(folder.path() / "b.png", Picture(1, 1, {40, 50, 60}));
  folder.put("looks/m.mtl", "newmtl one\nmap_Kd tex\\a.png\nnewmtl two\nmap_Kd ../b.png\n");
  folder.put("n.mtl", "newmtl three\nmap_Kd looks/tex/a.png\n");
  const auto path = folder.put("m.obj",
                               "mtllib looks/m.mtl\nmtllib n.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\n"
                               "usemtl one\nf 1/1 2/1 3/1\nusemtl two\nf 1/1 2/1 3/1\nusemtl three\nf 1/1 2/1 3/1\n");
  const Scene s = read_obj(path).scene;
  EXPECT_TRUE(s.notes.empty());
  ASSERT_EQ(s.textures.size(), 2u) << "a picture that two materials share is one texture";
  EXPECT_EQ(s.textures[0].rgb[5], (Rgb{10, 20, 30}));
  EXPECT_EQ(s.textures[1].rgb[0], (Rgb{40, 50, 60}));
  EXPECT_EQ(s.materials[0].texture, 0u);
  EXPECT_EQ(s.materials[1].texture, 1u);
  EXPECT_EQ(s.materials[2].texture, 0u);
}

TEST(Obj, ManyNotesEndInOne) {
  std::string text = "mtllib m\nmtllib m\n" + std::string(square);
  for (int i = 0; i < 1000; ++i) text += concat("usemtl m", i, "\nf 1 2 3\n");
  const std::vector<std::string> notes = parse(text, "newmtl a\n").scene.notes;
  ASSERT_EQ(notes.size(), 101u);
  EXPECT_EQ(notes[0], "a.obj: no material 'm0'; it is grey");
  EXPECT_EQ(notes[100], "and more");
}

TEST(Obj, RefusesWithTheLine) {
  EXPECT_REFUSED(parse("v 0 0 0\nv 1 nan 0\n"), "a.obj:2: vertex 1 is (");
  EXPECT_REFUSED(parse("v 0 0 0\n\nv 1 1e99 0\n"), "a.obj:3: vertex 1 is (");
  EXPECT_REFUSED(parse("v 0 0\n"), "a.obj:1: 2 numbers of a vertex; expected 3");
  EXPECT_REFUSED(parse("v 0 0 0 1 1\n"), "a.obj:1: 5 numbers of a vertex");
  EXPECT_REFUSED(parse("v 0 0 x\n"), "a.obj:1: 'x'; expected a number");
  EXPECT_REFUSED(parse(std::string(square) + "f 1 2 5\n"), "a.obj:5: a face uses vertex 5; expected 1 to 4");
  EXPECT_REFUSED(parse(std::string(square) + "f 1 2 0\n"), "a face uses vertex 0");
  EXPECT_REFUSED(parse(std::string(square) + "f 1 2 -5\n"), "a face uses vertex -5");
  EXPECT_REFUSED(parse(std::string(square) + "f 1/1 2/1 3/1\n"), "a face uses texture coordinates 1");
  EXPECT_REFUSED(parse(std::string(square) + "f 1 2 99999999999999999999\n"), "'9999999999999999...' in a face");
  EXPECT_REFUSED(parse(std::string(square) + "f 1 2 3x\n"), "'x' in a face");
  EXPECT_REFUSED(parse(std::string(square) + "f 1 2\n"), "a face of 2 corners");
  EXPECT_REFUSED(parse(std::string("v 0 0 \0\n", 8)), "a.obj:1: a byte 0");
  EXPECT_REFUSED(parse("hello\n"), "a.obj: no face");
  EXPECT_REFUSED(parse(square), "no face");
  EXPECT_REFUSED(parse("mtllib m\n", "Kd 1 1 1\n"), "m:1: 'Kd' before the first 'newmtl'");
  EXPECT_REFUSED(parse("mtllib m\n", "newmtl a\nKd 1 1\n"), "m:2: 2 numbers of a colour; expected 3");
  EXPECT_REFUSED(ObjReader("v 0 0 0\nf 1 1 1 1 1\n", "a", {.triangles = 2}).read({}, ""), "more than 2 triangles");
}

}  // namespace
}  // namespace vantage
