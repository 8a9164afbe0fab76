// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/object_scene.hpp>

#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/sim/rgbd_camera.hpp>

namespace vantage {
namespace {

Scene block(const Eigen::Vector3d& size, const Eigen::Vector3f& colour, const std::string& name) {
  SceneBuilder b;
  b.label = b.class_of(name);
  b.box({10, 10, 10}, Eigen::Vector3d(10, 10, 10) + size, b.plain("paint", colour));
  return std::move(b).take();
}
Scene textured_ball() {
  SceneBuilder b;
  b.label = b.class_of("camera");
  b.ellipsoid({0, 0, -3}, {2, 1, 1}, b.textured("wood", procedural::wood({0.8F, 0.5F, 0.3F}, Rng(1)), 1));
  Scene s = std::move(b).take();
  s.mesh.colours.assign(s.mesh.vertices.size(), Eigen::Vector3f(1, 0.5F, 0.5F));
  return s;
}

TEST(ObjectScene, PlacesObjectsApartOnTheGround) {
  const Scene a = block({4, 2, 1}, {1, 0, 0}, "car"), b = block({1, 1, 3}, {0, 1, 0}, "chair"), c = textured_ball();
  Scene unknown = b;
  unknown.label.clear();
  const std::vector<Scene> objects = {a, b, c, a, unknown};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const ObjectScene scene = compose_objects(objects, Rng(seed));
    scene.scene.validate("test");
    ASSERT_EQ(scene.footprints.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      const Box2 box = scene.footprints[i].bounds();
      EXPECT_LE(box.max().maxCoeff(), 1.3);
      EXPECT_GE(box.min().minCoeff(), -1.3);
      for (std::size_t j = 0; j < i; ++j) EXPECT_GT(gap_m(scene.footprints[i], scene.footprints[j]), 0.05);
    }
    EXPECT_EQ(scene.scene.classes, (std::vector<std::string>{"unknown", "ground", "car", "chair", "camera"}));
    // Every triangle of an object stands on the ground inside of its footprint, and has its class.
    std::size_t t = 0;
    while (scene.scene.label[t] == 1) ++t;
    const std::uint16_t expected[] = {2, 3, 4, 2, 0};
    Box3 all;
    for (std::size_t i = 0; i < 5; ++i) {
      Box3 local;
      const Eigen::Isometry3d inverse = scene.footprints[i].pose().inverse();
      for (std::size_t k = 0; k < objects[i].mesh.triangles.size(); ++k, ++t) {
        EXPECT_EQ(scene.scene.label[t], expected[i]);
        for (const Eigen::Vector3d& corner : scene.scene.mesh.corners(t)) {
          local.extend(inverse * corner);
          all.extend(corner);
        }
      }
      EXPECT_NEAR(local.min().z(), 0, 1e-5);
      EXPECT_NEAR(local.max().x(), scene.footprints[i].half.x(), 1e-5);
      EXPECT_NEAR(local.min().y(), -scene.footprints[i].half.y(), 1e-5);
      const double longest = local.sizes().maxCoeff();
      EXPECT_GE(longest, 0.6 - 1e-5);
      EXPECT_LE(longest, 1.0 + 1e-5);
      const Eigen::Vector3d size = objects[i].mesh.bounds().sizes();
      EXPECT_TRUE((local.sizes() / longest).isApprox(size / size.maxCoeff(), 1e-4));  // scaled alike in all directions
    }
    EXPECT_EQ(t, scene.scene.mesh.triangles.size());
    EXPECT_TRUE(scene.bounds.contains(Box3(all.min().array() + 1e-5, all.max().array() - 1e-5)));
    EXPECT_NEAR(scene.bounds.max().z(), all.max().z(), 1e-5);
  }
}

TEST(ObjectScene, KeepsTexturesMaterialsAndVertexColours) {
  const std::vector<Scene> objects = {block({1, 1, 1}, {1, 0, 0}, "red"), textured_ball()};
  const ObjectScene made = compose_objects(objects, Rng(3));
  RgbdConfig config = RgbdConfig::semantic();
  config.renderer.lighting = Lighting::none();
  const RgbdCamera camera(made.scene, config);
  Eigen::Vector3f mean[4] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  float count[4] = {};
  const Frame frame = camera.capture(look_at({0.1, 0, 2.5}, {0, 0, 0}), Rng(1));
  for (Eigen::Index k = 0; k < frame.labels.size(); ++k) {
    const auto label = frame.labels.data()[k];
    ASSERT_LT(label, 4);
    mean[label] += Eigen::Vector3f(frame.colour.r.data()[k], frame.colour.g.data()[k], frame.colour.b.data()[k]);
    ++count[label];
  }
  for (int i = 1; i < 4; ++i) {
    EXPECT_GT(count[i], 300);
    mean[i] /= count[i];
  }
  EXPECT_TRUE(mean[2].isApprox(Eigen::Vector3f(1, 0, 0)));           // plain, and its colours kept white
  EXPECT_NEAR(mean[1].x(), mean[1].y(), 0.05);                       // grey ground
  EXPECT_NEAR(mean[3].y() / mean[3].x(), 0.5F * 0.5F / 0.8F, 0.05);  // wood times vertex colour
}

TEST(ObjectScene, SeedsRepeatAndDiffer) {
  const std::vector<Scene> objects(2, block({2, 1, 1}, {1, 0, 0}, "a"));
  const auto centre = [&](std::uint64_t seed) { return compose_objects(objects, Rng(seed)).footprints[1].centre; };
  EXPECT_EQ(centre(1), centre(1));
  EXPECT_NE(centre(1), centre(2));
}

TEST(ObjectScene, ClassesMaterialsAndNotesAreJoinedOnce) {
  Scene a = block({1, 1, 1}, {1, 0, 0}, "a"), b = textured_ball();
  a.notes = {"one"};
  b.notes = {"two", "one"};
  const ObjectScene made = compose_objects(std::vector<Scene>{a, b, b}, Rng(1));
  EXPECT_EQ(made.scene.notes, (std::vector<std::string>{"one", "two"}));
  EXPECT_EQ(made.scene.materials[made.scene.material.back()].name, "wood");
  const Material& wood = made.scene.materials[made.scene.material.back()];
  ASSERT_TRUE(wood.texture);
  EXPECT_EQ(made.scene.textures[*wood.texture].rgb, b.textures[0].rgb);
  EXPECT_EQ(made.scene.uv.back(), b.uv.back());
}

TEST(ObjectScene, OneObjectWithoutGround) {
  const std::vector<Scene> objects = {block({2, 1, 1}, {1, 0, 0}, "a")};
  const ObjectScene made = compose_objects(objects, Rng(1), {.ground_m = 0});
  made.scene.validate("test");
  EXPECT_EQ(made.scene.mesh.triangles.size(), 12U);
  const Frame frame = RgbdCamera(made.scene, RgbdConfig::semantic()).capture(*made.scene.start, Rng(1));
  EXPECT_GT((frame.labels == 0).count(), 1000);  // open: background
  EXPECT_GT((frame.labels == 1).count(), 1000);
}

std::string refusal(const std::vector<Scene>& objects, const ObjectSceneConfig& config = {}) {
  try {
    compose_objects(objects, Rng(1), config);
  } catch (const Error& e) { return e.what(); }
  return "accepted";
}

TEST(ObjectScene, RefusesWhatCannotBePlaced) {
  const auto names = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  const Scene a = block({2, 1, 1}, {1, 0, 0}, "a"), empty;
  Scene broken = a, flat = a;
  broken.mesh.vertices[3].x() = std::numeric_limits<float>::quiet_NaN();
  for (Eigen::Vector3f& v : flat.mesh.vertices) v.setZero();
  EXPECT_EQ(refusal({a}), "accepted");
  EXPECT_TRUE(names(refusal(std::vector<Scene>(40, a)), "of 40 objects fit"));
  EXPECT_TRUE(names(refusal({a}, {.area_m = 0.5}), "0 of 1 objects fit"));
  EXPECT_TRUE(names(refusal({}), "no object"));
  EXPECT_TRUE(names(refusal({a, empty}), "object 1: the scene has no triangle")) << refusal({a, empty});
  EXPECT_TRUE(names(refusal({broken}), "object 0: vertex 3")) << refusal({broken});
  EXPECT_TRUE(names(refusal({flat}), "no extent"));
  EXPECT_TRUE(names(refusal({a}, {.min_size_m = 2, .max_size_m = 1}), "max_size_m"));
  EXPECT_TRUE(names(refusal({a}, {.margin_m = -1}), "margin_m"));
  EXPECT_TRUE(names(refusal({a}, {.area_m = std::nan("")}), "area_m"));
}

}  // namespace
}  // namespace vantage
