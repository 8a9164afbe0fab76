// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/gltf.hpp>

#include <array>
#include <string>

#include <gtest/gtest.h>

#include <vantage/io/picture.hpp>
#include <vantage/io/png.hpp>
#include <vantage/io/scene_file.hpp>
#include <vantage/io/write_glb.hpp>
#include <vantage/io/write_obj.hpp>

#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace vantage {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// A triangle (0,0,0), (1,0,0), (0,1,0), whose indices are 0, 1, 2, in a data URI; %s is what a test puts in.
std::string triangle(const std::string& node, const std::string& more = "") {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"part")" + node +
         R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
         R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],"buffers":[{"byteLength":42,)"
         R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"}])" +
         more + "}";
}
LoadedScene read(const std::string& text) { return GltfReader(text, "a.gltf", {}).read("nowhere"); }

TEST(Gltf, TurnsYUpIntoZUp) {
  const LoadedScene s = read(triangle(R"(,"translation":[10,20,30],"scale":[1,2,1])"));
  EXPECT_EQ(s.parts, std::vector<std::string>{"part"});
  EXPECT_EQ(s.scene.mesh.vertices[0], Eigen::Vector3f(10, -30, 20));
  EXPECT_EQ(s.scene.mesh.vertices[2], Eigen::Vector3f(10, -30, 22)) << "y is up";
  EXPECT_EQ(s.scene.mesh.triangles, std::vector<Triangle>({{0, 1, 2}}));
  EXPECT_EQ(s.scene.materials[0].colour, Eigen::Vector3f(1, 1, 1)) << "the default of glTF";
  s.scene.validate("a");
}

TEST(Gltf, AppliesTheTransformsOfNodes) {
  // 90 degrees about y: x becomes -z, in the scene +y.
  EXPECT_TRUE(read(triangle(R"(,"rotation":[0,0.7071067811865476,0,0.7071067811865476])"))
                  .scene.mesh.vertices[1]
                  .isApprox(Eigen::Vector3f(0, 1, 0), 1e-6F));
  EXPECT_EQ(read(triangle(R"(,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,5,6,7,1])")).scene.mesh.vertices[1],
            Eigen::Vector3f(6, -7, 6));
  EXPECT_EQ(read(triangle(R"(,"scale":[-1,1,1])")).scene.mesh.triangles, std::vector<Triangle>({{0, 2, 1}}))
      << "mirrored";
}

TEST(Gltf, RefusesWhatDoesNotFit) {
  const auto with = [](std::string_view old, std::string_view now, std::string text = triangle("")) {
    text.replace(text.find(old), old.size(), now);
    return text;
  };
  EXPECT_REFUSED(read(with("\"count\":3,\"type\":\"VEC3\"", "\"count\":4,\"type\":\"VEC3\"")),
                 "accessor 0: 4 elements of 12 bytes");
  EXPECT_REFUSED(read(with("\"byteLength\":36", "\"byteLength\":99")), "a.gltf: /bufferViews/0/byteLength: 99");
  EXPECT_REFUSED(read(with("\"byteOffset\":36", "\"byteOffset\":40")),
                 "a.gltf: /bufferViews/1: 6 bytes from byte 40 of a buffer; expected 1 or more, within 42");
  EXPECT_REFUSED(read(triangle("", R"(,"images":[{"bufferView":9,"mimeType":"image/png"}])")), "image[0] bufferView");
  EXPECT_REFUSED(read(with("\"POSITION\":0", "\"POSITION\":7")), "accessor 7: there is none");
  EXPECT_REFUSED(read(with("AAAAAAABAAIA", "AAAAAAABAAcA")), "a triangle uses vertex 7; expected below 3");
  EXPECT_REFUSED(read(with("AACAPwAA", "AADAfwAA")), "vertex 1 of 'part' is (");
  const std::string not_a_number =
      with("\"POSITION\":0", "\"POSITION\":0,\"COLOR_0\":2",
           with("\"SCALAR\"}", "\"SCALAR\"},{\"bufferView\":2,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}",
                with("\"byteLength\":6}", "\"byteLength\":6},{\"buffer\":1,\"byteLength\":36}",
                     with("AAABAAIA\"}", R"(AAABAAIA"},{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
                                         R"(AACAPwAAgD8AAIA/AAAAAAAAwH8AAAAAAAAAAAAAAAAAAAAA"})"))));
  EXPECT_REFUSED(read(not_a_number), "vertex 1 of 'part' has a colour that is not finite; expected in [0, 1]");
  EXPECT_REFUSED(read(triangle(",\"children\":[0]")), "node 0 has two parents");
  EXPECT_REFUSED(read(triangle(",\"children\":[9]")), "node 9; expected below 1");
  EXPECT_REFUSED(read(triangle(",\"rotation\":[0,0,0,0]")), "a rotation of 0");
  EXPECT_REFUSED(
      read(triangle(
          "",
          R"(,"extensionsUsed":["KHR_draco_mesh_compression"],"extensionsRequired":["KHR_draco_mesh_compression"])")),
      "the extension 'KHR_draco_mesh_compression' is required");
  EXPECT_REFUSED(read(with("data:application/octet-stream;base64,AAAA", "none.bin?")), "none.bin");
  EXPECT_REFUSED(read("{"), "a.gltf:1: ends at byte 1");
  EXPECT_REFUSED(read("solid"), "no glTF file");
  EXPECT_REFUSED(read(with("\"2.0\"},", "\"2.0\"},\"extras\":" + std::string(99, '[') + std::string(99, ']') + ",")),
                 "nested deeper than 64");
}

TEST(Gltf, ReplacesAMissingPictureByTheColour) {
  std::string text =
      triangle("", R"(,"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0,0.2158605,1],)"
                   R"("baseColorTexture":{"index":0}}}],"textures":[{"source":0}],"images":[{"uri":"no.png"}])");
  text.replace(text.find("\"indices\":1"), 11, "\"indices\":1,\"material\":0");
  const Scene s = read(text).scene;
  ASSERT_EQ(s.notes.size(), 1u);
  EXPECT_NE(s.notes[0].find("no.png: no such file"), std::string::npos) << s.notes[0];
  EXPECT_TRUE(s.materials[s.material[0]].colour.isApprox(Eigen::Vector3f(1, 0, 128 / 255.0F), 1e-3F))
      << "display-encoded";
  s.validate("a");
}

// The texture coordinates of the triangle's corners, of which set `set` is the x and y of their positions, as a base
// colour texture with this KHR_texture_transform has them.
std::array<Eigen::Vector2f, 3> placed(const std::string& transform, const std::string& set = "TEXCOORD_0") {
  const test::TemporaryFolder folder;
  write_png(folder.path() / "a.png", Picture(1, 1));
  std::string text =
      triangle("", R"(,"extensionsUsed":["KHR_texture_transform"],"extensionsRequired":["KHR_texture_transform"],)"
                   R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{)"
                   R"("KHR_texture_transform":{)" +
                       transform + R"(}}}}}],"textures":[{"source":0}],"images":[{"uri":"a.png"}])");
  text.replace(text.find("\"POSITION\":0"), 12, "\"POSITION\":0,\"" + set + "\":0");
  text.replace(text.find("\"indices\":1"), 11, "\"indices\":1,\"material\":0");
  const Scene s = GltfReader(text, "a.gltf", {}).read(folder.path()).scene;
  s.validate("a");
  return s.uv.at(0);
}

TEST(Gltf, TexturesAreScaledTurnedAndMoved) {
  using Corners = std::array<Eigen::Vector2f, 3>;
  const auto expect = [](const Corners& found, const Corners& expected) {
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_LT((found[k] - expected[k]).norm(), 1e-6F) << "corner " << k << ": " << found[k].transpose();
  };
  // (0, 0), (1, 0) and (0, 1) with v down become ours, with v up.
  expect(placed(""), {Eigen::Vector2f(0, 1), Eigen::Vector2f(1, 1), Eigen::Vector2f(0, 0)});
  expect(placed(R"("offset":[0.25,0.5],"scale":[0.5,2])"),
         {Eigen::Vector2f(0.25F, 0.5F), Eigen::Vector2f(0.75F, 0.5F), Eigen::Vector2f(0.25F, -1.5F)});
  // The extension's own example: the lower left quadrant, turned clockwise by 90 degrees: what is on top in it is on
  // the right of the square. In the picture, v down: (0, 1), (0, 0.5), (0.5, 1).
  expect(placed(R"("offset":[0,1],"rotation":1.5707963267948966,"scale":[0.5,0.5])"),
         {Eigen::Vector2f(0, 0), Eigen::Vector2f(0, 0.5F), Eigen::Vector2f(0.5F, 0)});
  // The scale comes first: u is halved and then turned.
  expect(placed(R"("rotation":1.5707963267948966,"scale":[0.5,1])"),
         {Eigen::Vector2f(0, 1), Eigen::Vector2f(0, 1.5F), Eigen::Vector2f(1, 1)});
  expect(placed(R"("texCoord":1)", "TEXCOORD_1"),
         {Eigen::Vector2f(0, 1), Eigen::Vector2f(1, 1), Eigen::Vector2f(0, 0)});
}

TEST(Gltf, RefusesTextureTransformsThatAreNone) {
  const std::string way = "/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform";
  EXPECT_REFUSED(placed(R"("scale":[1])"), way + "/scale: 1 elements; expected 2 numbers");
  EXPECT_REFUSED(placed(R"("offset":[0,"x"])"), way + "/offset/1: a value of kind string");
  EXPECT_REFUSED(placed(R"("rotation":null,"texCoord":-1)"), way + "/texCoord: -1");
  EXPECT_REFUSED(placed(R"("rotation":[1])"), way + "/rotation: a value of kind array");
  EXPECT_REFUSED(placed(R"("offset":[1e999,0])"), "a number that is out of range");
  EXPECT_REFUSED(placed(R"("offset":[1e39,0])"), "vertex 0 has texture coordinates that are not finite");
}

TriangleMesh coloured() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
          {{0, 2, 1}, {0, 1, 3}},
          {{1, 0, 0}, {0, 0.5F, 0}, {0, 0, 0.04F}, {1, 1, 1}}};
}

Scene textured() {
  Scene s;
  s.mesh = {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {{0, 2, 1}, {0, 1, 3}}, {}};
  s.uv = {{Eigen::Vector2f(0, 0), Eigen::Vector2f(0.25F, 1), Eigen::Vector2f(1, 0)},
          {Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero(), Eigen::Vector2f::Zero()}};
  s.materials = {{.name = "plain", .colour = {0.2F, 0.4F, 0.6F}}, {.name = "tiles", .colour = {1, 1, 1}, .texture = 0}};
  s.material = {1, 0};
  s.textures = {{2, 1, {{10, 20, 30}, {200, 100, 50}}}};
  s.classes = {"unknown", "floor", "wall"};
  s.label = {1, 2};
  return s;
}

TEST(WriteGlb, MeshesComeBack) {
  const TriangleMesh mesh = coloured();
  const test::TemporaryFolder folder;
  write_glb(folder.path() / "a.glb", mesh);
  const Scene s = read_gltf(folder.path() / "a.glb").scene;
  EXPECT_EQ(s.mesh.vertices, mesh.vertices);
  EXPECT_EQ(s.mesh.triangles, mesh.triangles);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_TRUE((s.mesh.colours[i] - mesh.colours[i]).cwiseAbs().maxCoeff() < 3e-4F) << i;
  EXPECT_EQ(encode_glb(mesh), encode_glb(mesh));
  EXPECT_REFUSED(encode_glb(TriangleMesh{}), "no triangle");
}

TEST(WriteGlb, ScenesComeBackWithTheirTextures) {
  const test::TemporaryFolder folder;
  write_glb(folder.path() / "a.glb", textured());
  const Scene s = read_scene(folder.path() / "a.glb");
  ASSERT_EQ(s.textures.size(), 1u);
  EXPECT_EQ(s.textures[0].rgb, textured().textures[0].rgb);
  EXPECT_EQ(s.mesh.triangles.size(), 2u);
  const std::size_t tiles = s.material[0] == 2 ? 0 : 1;  // after glTF's default
  EXPECT_EQ(s.materials[s.material[tiles]].name, "tiles");
  EXPECT_EQ(s.uv[tiles][1], Eigen::Vector2f(0.25F, 1));
  EXPECT_EQ(s.mesh.corners(tiles), textured().mesh.corners(0));
  EXPECT_TRUE(s.materials[s.material[1 - tiles]].colour.isApprox(Eigen::Vector3f(0.2F, 0.4F, 0.6F), 1e-5F));
}

TEST(WriteGlb, NamesTheByteWhereATruncatedFileEnds) {
  const std::string whole = encode_glb(coloured());
  for (std::size_t size = 4; size < whole.size(); ++size)
    EXPECT_REFUSED(GltfReader(std::string_view(whole).substr(0, size), "a.glb", {}).read(""),
                   concat("a.glb: ends at byte ", size));
}

TEST(WriteObj, MeshesAndScenesComeBack) {
  const test::TemporaryFolder folder;
  write_obj(folder.path() / "m.obj", coloured());
  const Scene mesh = read_obj(folder.path() / "m.obj").scene;
  EXPECT_EQ(mesh.mesh.vertices, coloured().vertices);
  EXPECT_EQ(mesh.mesh.triangles, coloured().triangles);
  EXPECT_EQ(mesh.mesh.colours, coloured().colours);

  write_obj(folder.path() / "s.obj", textured());
  const LoadedScene s = read_obj(folder.path() / "s.obj");
  EXPECT_TRUE(s.scene.notes.empty());
  EXPECT_EQ(s.parts, (std::vector<std::string>{"floor", "wall"}));
  EXPECT_EQ(s.scene.mesh.triangles, textured().mesh.triangles);
  EXPECT_EQ(s.scene.uv, textured().uv);
  EXPECT_EQ(s.scene.textures.at(0).rgb, textured().textures[0].rgb);
  EXPECT_EQ(s.scene.materials[s.scene.material[1]].colour, textured().materials[0].colour);
}

}  // namespace
}  // namespace vantage
