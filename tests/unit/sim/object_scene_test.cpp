// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vantage/sim/object_scene.hpp>

namespace vantage {
namespace {

// A brick of w x d x h somewhere off the origin, of a class.
Scene brick(float w, float d, float h, const std::string& name) {
  Scene s;
  for (const float z : {0.F, h})
    for (const float y : {0.F, d})
      for (const float x : {0.F, w}) s.mesh.vertices.emplace_back(3 + x, 2 + y, 5 + z);
  s.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  s.label.assign(12, s.class_of(name));
  return s;
}

TEST(ObjectScene, StandsOnTheGroundScaledAndApart) {
  const std::vector<Scene> objects = {brick(2, 1, 1, "table"), brick(1, 1, 4, "lamp"), brick(1, 1, 1, "table")};
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u, 5u}) {
    const ObjectScene made = compose_objects(objects, Rng(seed), {.area_m = 4, .size_m = 0.8, .margin_m = 0.05});
    made.scene.validate("test");
    ASSERT_EQ(made.footprints.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT(gap_m(made.footprints[i], made.footprints[j]), 0.05);
    EXPECT_EQ(made.scene.classes, (std::vector<std::string>{"unknown", "ground", "table", "lamp"}));
    // Two triangles of ground, then twelve of each object.
    const double height_m[] = {0.4, 0.8, 0.8};
    for (std::size_t i = 0; i < 3; ++i) {
      Box3 box;
      for (std::size_t t = 2 + 12 * i; t < 14 + 12 * i; ++t) {
        EXPECT_EQ(made.scene.label[t], i == 1 ? 3 : 2);
        for (const Eigen::Vector3d& c : made.scene.mesh.corners(t)) {
          box.extend(c);
          const Eigen::Vector2d in = made.footprints[i].axes().transpose() * (c.head<2>() - made.footprints[i].centre);
          EXPECT_TRUE((in.cwiseAbs().array() <= made.footprints[i].half.array() + 1e-6).all());
        }
      }
      EXPECT_NEAR(box.min().z(), 0, 1e-6);
      EXPECT_NEAR(box.max().z(), height_m[i], 1e-6);
      EXPECT_LE(box.max().head<2>().cwiseAbs().maxCoeff(), 2 + 1e-6);
      EXPECT_TRUE(made.bounds.contains(Box3(box.min().array() + 1e-6, box.max().array() - 1e-6)));
    }
    EXPECT_NEAR(made.bounds.max().z(), 0.8, 1e-9);
  }
}

TEST(ObjectScene, TheSameSeedIsTheSameScene) {
  const std::vector<Scene> objects = {brick(2, 1, 1, "a"), brick(1, 1, 2, "b")};
  const ObjectScene a = compose_objects(objects, Rng(7)), b = compose_objects(objects, Rng(7)),
                    c = compose_objects(objects, Rng(8));
  EXPECT_EQ(a.scene.mesh.vertices, b.scene.mesh.vertices);
  EXPECT_NE(a.scene.mesh.vertices, c.scene.mesh.vertices);
}

TEST(ObjectScene, KeepsMaterialsAndTexturesOfEach) {
  Scene painted = brick(1, 1, 1, "x");
  painted.materials = {{.name = "red", .colour = {1, 0, 0}}, {.name = "wood", .colour = {1, 1, 1}, .texture = 0}};
  painted.textures.push_back({1, 1, {{10, 20, 30}}});
  painted.material.assign(12, 1);
  painted.uv.assign(12, {Eigen::Vector2f(0, 0), Eigen::Vector2f(1, 0), Eigen::Vector2f(0, 1)});
  const ObjectScene made = compose_objects(std::vector<Scene>{brick(1, 1, 1, "y"), painted}, Rng(1));
  const Material& m = made.scene.materials[made.scene.material.back()];
  EXPECT_EQ(m.name, "wood");
  ASSERT_TRUE(m.texture);
  EXPECT_EQ(made.scene.textures[*m.texture].rgb[0], (std::array<std::uint8_t, 3>{10, 20, 30}));
  EXPECT_EQ(made.scene.uv.back(), painted.uv.back());
  EXPECT_EQ(made.scene.materials[made.scene.material[2]].name, "default");
}

TEST(ObjectScene, RefusesWhatDoesNotFit) {
  const std::vector<Scene> many(30, brick(1, 1, 1, "a"));
  EXPECT_THROW((void)compose_objects(many, Rng(1), {.area_m = 3, .attempts = 50}), Error);
  EXPECT_THROW((void)compose_objects({}, Rng(1)), Error);
  EXPECT_THROW((void)compose_objects(std::vector<Scene>{Scene{}}, Rng(1)), Error);
  EXPECT_THROW((void)compose_objects(many, Rng(1), {.area_m = -1}), Error);
  Scene point = brick(1, 1, 1, "a");
  for (Eigen::Vector3f& v : point.mesh.vertices) v.setZero();
  EXPECT_THROW((void)compose_objects(std::vector<Scene>{point}, Rng(1)), Error);
}

}  // namespace
}  // namespace vantage
