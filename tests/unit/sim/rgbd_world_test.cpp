// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include <vantage/concepts/world.hpp>
#include <vantage/sim/rgbd_world.hpp>
#include <vantage/sim/room.hpp>

namespace vantage {
namespace {

struct FrameMap {
  using Measurement = Frame;
  void integrate(const Frame&, Rng&) {}
  [[nodiscard]] Box3 bounds() const { return {}; }
};
static_assert(WorldFor<RgbdWorld, FrameMap>);
static_assert(Posed<Frame>);

const Scene& room() {
  static const Scene scene = procedural_room({}, Rng(1)).scene;
  return scene;
}
const RgbdConfig small = {.camera = Camera::from_fov(64, 48, deg(70)), .colour_noise = 0.01};

bool same(const Frame& a, const Frame& b) {
  const auto bits = [](const Image<float>& x) {
    return fnv1a(std::as_bytes(std::span(x.data(), static_cast<std::size_t>(x.size()))));
  };
  return bits(a.depth) == bits(b.depth) && bits(a.colour.g) == bits(b.colour.g) && (a.labels == b.labels).all();
}

TEST(RgbdWorld, SeesWhereItIsAskedToAndSaysSo) {
  RgbdWorld world(room(), Rng(2), small);
  const std::optional<Frame> f = world.observe(*room().start);
  ASSERT_TRUE(f);
  f->validate("test");
  EXPECT_TRUE(f->view.T_W_C.isApprox(room().start->T_W_C, 0));
  EXPECT_EQ(f->depth.rows(), 48);
  EXPECT_GT((f->depth > 0).count(), 2000);
  EXPECT_GT(f->labels.maxCoeff(), 1);
  EXPECT_EQ(world.measurements(), 1u);
}

TEST(RgbdWorld, NoiseBelongsToTheViewNotToTheOrder) {
  RgbdWorld a(room(), Rng(2), small), b(room(), Rng(2), small), other(room(), Rng(3), small);
  View turned = *room().start;
  turned.T_W_C.rotate(Eigen::AngleAxisd(1, Eigen::Vector3d::UnitY()));
  (void)a.observe(turned);
  EXPECT_TRUE(same(*a.observe(*room().start), *b.observe(*room().start)));
  EXPECT_FALSE(same(*b.observe(*room().start), *other.observe(*room().start)));
}

TEST(RgbdWorld, ResumesOverTheSameSceneOnly) {
  RgbdWorld a(room(), Rng(2), small), b(room(), Rng(2), small), other(room(), Rng(3), small);
  (void)a.observe(*room().start);
  Sink sink;
  a.save(sink);
  Source source(sink.bytes(), "saved");
  b.load(source);
  EXPECT_EQ(b.measurements(), 1u);
  Source again(sink.bytes(), "saved");
  EXPECT_THROW(other.load(again), Error);
  EXPECT_EQ(other.measurements(), 0u);
}

TEST(RgbdWorld, RefusesABadViewOrScene) {
  RgbdWorld world(room(), Rng(2), small);
  View bad = *room().start;
  bad.T_W_C.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)world.observe(bad), Error);
  EXPECT_EQ(world.measurements(), 0u);
  EXPECT_THROW(RgbdWorld(Scene{}, Rng(1)), Error);
  Scene holed = room();
  holed.mesh.vertices[7].y() = std::numeric_limits<float>::quiet_NaN();
  try {
    RgbdWorld{holed, Rng(1)};
    FAIL();
  } catch (const Error& e) { EXPECT_NE(std::string(e.what()).find("vertex 7"), std::string::npos) << e.what(); }
}

}  // namespace
}  // namespace vantage
