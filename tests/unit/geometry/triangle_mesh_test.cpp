// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/geometry/triangle_mesh.hpp>

#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "message_of.hpp"

namespace vantage {
namespace {

TriangleMesh coloured_triangle() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {{0, 0, 0}, {1, 1, 1}, {0.5F, 0.25F, 1}}};
}

std::string refusal(const TriangleMesh& mesh) {
  return test::message_of([&] { mesh.validate("a mesh"); });
}

TEST(TriangleMesh, ValidateNamesTheFirstThingThatDoesNotFit) {
  EXPECT_EQ(refusal(coloured_triangle()), "");
  EXPECT_EQ(refusal({}), "");
  TriangleMesh mesh = coloured_triangle();
  mesh.vertices[2].y() = std::numeric_limits<float>::infinity();
  EXPECT_EQ(refusal(mesh).find("a mesh: vertex 2 is ("), 0u);
  mesh = coloured_triangle();
  mesh.triangles[0][1] = 3;
  EXPECT_EQ(refusal(mesh), "a mesh: triangle 0 uses vertex 3; expected below 3");
  mesh = coloured_triangle();
  mesh.colours.pop_back();
  EXPECT_EQ(refusal(mesh), "a mesh: 2 colours; expected none, or one for each of 3 vertices");
}

TEST(TriangleMesh, ColoursAreNumbersFrom0To1) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {-1e-6F, 1.00001F, 255.0F, infinity, -infinity, std::numeric_limits<float>::quiet_NaN()})
    for (int channel = 0; channel < 3; ++channel) {
      TriangleMesh mesh = coloured_triangle();
      mesh.colours[1][channel] = bad;
      EXPECT_EQ(refusal(mesh).find("a mesh: vertex 1 has colour ("), 0u) << bad << ": " << refusal(mesh);
    }
}

}  // namespace
}  // namespace vantage
