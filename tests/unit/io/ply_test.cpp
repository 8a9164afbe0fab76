// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/io/ply.hpp>

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <vantage/io/write_ply.hpp>

#include "message_of.hpp"
#include "temporary_folder.hpp"

namespace vantage {
namespace {

TriangleMesh tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1.25F, 0}, {0, 0, 1e-7F}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
          {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2F, 0.4F, 0.6F}}};
}

// As the format's author describes a cube with a square and a pentagon: polygons, colours, comments, other elements.
constexpr std::string_view by_hand =
    "ply\nformat ascii 1.0\ncomment by hand\nobj_info none\nelement vertex 5\nproperty float x\nproperty float32 y\n"
    "property double z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement edge 1\nproperty int "
    "v1\n"
    "property int v2\nelement face 2\nproperty uchar material\nproperty list uchar int vertex_index\nend_header\n"
    "0 0 0 255 0 51\n1 0 0 0 0 0\n1 1 0 0 0 0\n0.5 1.5 0 0 0 0\n0 1 0 0 0 0\n3 4\n7 4 0 1 2 4\n8 5 0 1 2 3 4\n";

TEST(Ply, CutsPolygonsIntoTriangles) {
  const TriangleMesh mesh = decode_ply_mesh(by_hand, "a");
  ASSERT_EQ(mesh.vertices.size(), 5u);
  EXPECT_EQ(mesh.vertices[3], Eigen::Vector3f(0.5F, 1.5F, 0));
  EXPECT_TRUE(mesh.colours[0].isApprox(Eigen::Vector3f(1, 0, 0.2F)));
  using Triangle = std::array<std::uint32_t, 3>;
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 4}, {0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(Ply, ReadsBigEndian) {
  using namespace std::string_literals;
  const std::string file =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty short y\nproperty double z\n"
      "element face 1\nproperty list uchar ushort vertex_indices\nend_header\n"s +
      "\x3F\x80\0\0\xFF\xFE\xC0\0\0\0\0\0\0\0"s + std::string(14, '\0') + std::string(14, '\0') +
      "\x03\0\x02\0\x01\0\0"s;
  const TriangleMesh mesh = decode_ply_mesh(file, "a");
  EXPECT_EQ(mesh.vertices[0], Eigen::Vector3f(1, -2, -2));
  EXPECT_EQ(mesh.triangles[0], (std::array<std::uint32_t, 3>{2, 1, 0}));
}

TEST(Ply, MeshesComeBack) {
  const TriangleMesh mesh = tetrahedron();
  for (const PlyFormat format : {PlyFormat::Text, PlyFormat::Binary}) {
    const test::TemporaryFolder folder;
    write_ply(folder.path() / "a.ply", mesh, format);
    const TriangleMesh again = read_ply_mesh(folder.path() / "a.ply");
    EXPECT_EQ(again.vertices, mesh.vertices);
    EXPECT_EQ(again.triangles, mesh.triangles);
    ASSERT_EQ(again.colours.size(), 4u);
    EXPECT_TRUE(again.colours[3].isApprox(mesh.colours[3]));
    EXPECT_EQ(encode_ply(again, format), encode_ply(mesh, format));
  }
}

TEST(Ply, PointsComeBackWithTheirScalars) {
  PointCloud cloud{{{1, 2, 3}, {-4, 5e-9F, 6}}, {{0, 0, 1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, 1}}, {}};
  cloud.scalars = {{"confidence", {0.25F, 1e30F}}, {"f_dc_0", {-1, 2}}};
  for (const PlyFormat format : {PlyFormat::Text, PlyFormat::Binary}) {
    const test::TemporaryFolder folder;
    write_ply(folder.path() / "a.ply", cloud, format);
    const PointCloud again = read_ply_points(folder.path() / "a.ply");
    EXPECT_EQ(again.points, cloud.points);
    EXPECT_EQ(again.normals, cloud.normals);
    EXPECT_EQ(again.colours, cloud.colours);
    ASSERT_EQ(again.scalars.size(), 2u);
    EXPECT_EQ(again.scalars[0].name, "confidence");
    EXPECT_EQ(again.scalars[0].values, cloud.scalars[0].values);
    EXPECT_EQ(again.scalars[1].values, cloud.scalars[1].values);
  }
  cloud.scalars[0].name = "two words";
  EXPECT_REFUSED(encode_ply(cloud), "a scalar named 'two words'");
  cloud.normals.pop_back();
  EXPECT_REFUSED(encode_ply(cloud), "1 normals; expected one for each of 2 points");
}

TEST(Ply, NamesTheByteWhereATruncatedFileEnds) {
  const std::string text(by_hand.substr(0, by_hand.size() - 3));  // without the last number
  for (const std::string& whole : {encode_ply(tetrahedron()), text + " "}) {
    const std::size_t header = whole.find("end_header");
    for (std::size_t size = 4; size + 1 < whole.size(); ++size) {
      const std::string said = test::message_of([&] { return decode_ply_mesh(whole.substr(0, size), "a.ply"); });
      const bool in_a_number = whole.starts_with("ply\nformat ascii") && size > header;
      EXPECT_NE(said.find(in_a_number ? "a.ply: " : concat("a.ply: ends at byte ", size)), std::string::npos)
          << size << ": " << said;
    }
  }
}

TEST(Ply, RefusesWhatIsNoMesh) {
  const auto with = [](std::string_view old, std::string_view now) {
    std::string file(by_hand);
    file.replace(file.find(old), old.size(), now);
    return file;
  };
  EXPECT_REFUSED(decode_ply_mesh("solid", "a"), "ends at byte 5");
  EXPECT_REFUSED(decode_ply_mesh("solid\n", "a"), "no PLY file");
  EXPECT_REFUSED(decode_ply_mesh(with("1 1 0 0", "1 nan 0 0"), "a.ply"), "a.ply: vertex 2 is (");
  EXPECT_REFUSED(decode_ply_mesh(with("1 1 0 0", "1 1e999 0 0"), "a.ply"), "a.ply: vertex 2 is (");
  EXPECT_REFUSED(decode_ply_mesh(with("1 1 0 0", "1 one 0 0"), "a"), "'one 0 0");
  EXPECT_REFUSED(decode_ply_mesh(with("255 0", "256 0"), "a"), "vertex 0 has colour");
  EXPECT_REFUSED(decode_ply_mesh(with("0 1 2 3 4\n", "0 1 2 3 5\n"), "a"), "triangle 4 uses vertex 5");
  EXPECT_REFUSED(decode_ply_mesh(with("0 1 2 3 4\n", "0 1 2 3 -1\n"), "a"), "face 1 uses vertex -1 at byte");
  EXPECT_REFUSED(decode_ply_mesh(with("7 4 0", "7 2 0"), "a"), "face 0 has 2 corners");
  EXPECT_REFUSED(decode_ply_mesh(with("8 5 0", "8 9999999 0"), "a"), "a list of 9999999 values at byte");
  EXPECT_REFUSED(decode_ply_mesh(with("vertex 5", "vertex 4294967295"), "a"), "4294967295 of element 'vertex'");
  EXPECT_REFUSED(decode_ply_mesh(with("vertex 5", "vertex -5"), "a"), "'-5' elements");
  EXPECT_REFUSED(decode_ply_mesh(with("float x", "floot x"), "a"), "type 'floot'");
  EXPECT_REFUSED(decode_ply_mesh(with("float x", "float u"), "a"), "vertices without x, y and z");
  EXPECT_REFUSED(decode_ply_mesh(with("ascii 1.0", "binary 1.0"), "a"), "format 'binary'");
  EXPECT_REFUSED(decode_ply_mesh(with("format ascii 1.0", "comment"), "a"), "a header without a format");
  EXPECT_REFUSED(decode_ply_mesh(with("comment by hand", "remark by hand"), "a"), "'remark' in the header");
  EXPECT_REFUSED(decode_ply_mesh(by_hand, "a", {.triangles = 4}), "more than 4 triangles");
  EXPECT_REFUSED(decode_ply_mesh(encode_ply(PointCloud{{{1, 2, 3}}, {}, {}, {}}), "a"), "no face");
  EXPECT_REFUSED(decode_ply_points(with("1 1 0 0", "1 nan 0 0"), "a.ply"), "a.ply: point 2 is (");
  TriangleMesh mesh = tetrahedron();
  mesh.vertices[1].x() = NAN;
  EXPECT_REFUSED(encode_ply(mesh), "vertex 1 is (");
}

}  // namespace
}  // namespace vantage
