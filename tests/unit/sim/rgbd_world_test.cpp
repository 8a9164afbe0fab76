// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sim/rgbd_world.hpp>

#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include <vantage/concepts/world.hpp>
#include <vantage/sim/room.hpp>

namespace vantage {
namespace {

struct AnyMap {
  using Measurement = Frame;
  void integrate(const Frame&, Rng&) {}
  [[nodiscard]] Box3 bounds() const { return {}; }
};
static_assert(WorldFor<RgbdWorld, AnyMap> && Posed<Frame> && Persistent<RgbdWorld>);

RgbdConfig small() { return {.camera = Camera::from_fov(64, 48, deg(60)), .colour_noise = 0.01}; }
Scene room(std::uint64_t seed) { return procedural_room({.pieces = 4, .edge_m = 0.5}, Rng(seed)).scene; }

bool same(const Image<float>& a, const Image<float>& b) {
  return a.size() == b.size() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(float)) == 0;
}

TEST(RgbdWorld, ObservesValidFramesOfItsScene) {
  const Scene scene = room(1);
  RgbdWorld world(scene, Rng(2), small());
  const auto frame = world.observe(*scene.start);
  ASSERT_TRUE(frame);
  frame->validate("test");
  EXPECT_TRUE(frame->view.T_W_C.isApprox(scene.start->T_W_C));
  EXPECT_GT((frame->depth > 0).count(), 1000);
  EXPECT_TRUE((frame->labels > 0).all());  // closed
  EXPECT_EQ(world.measurements(), 1U);
}

TEST(RgbdWorld, ResumesWhereItWasSaved) {
  RgbdWorld world(room(1), Rng(2), small());
  const View view = *room(1).start;
  const Frame first = *world.observe(view);
  Sink sink;
  world.save(sink);
  RgbdWorld other(room(1), Rng(99), small());
  EXPECT_FALSE(same(other.observe(view)->depth, first.depth));
  Source source(sink.bytes());
  other.load(source);
  source.done();
  EXPECT_EQ(other.measurements(), 1U);
  EXPECT_TRUE(same(other.observe(view)->depth, first.depth));
  EXPECT_TRUE(same(other.observe(view)->colour.g, first.colour.g));

  RgbdWorld elsewhere(room(2), Rng(3), small());
  const Frame before = *elsewhere.observe(view);
  Source again(sink.bytes());
  EXPECT_THROW(elsewhere.load(again), Error);
  Source truncated(sink.bytes().first(20));
  EXPECT_THROW(other.load(truncated), Error);
  EXPECT_TRUE(same(elsewhere.observe(view)->depth, before.depth));
  EXPECT_TRUE(same(other.observe(view)->depth, first.depth));
}

TEST(RgbdWorld, CopiesAreIndependentAndAlike) {
  RgbdWorld world(room(1), Rng(2), small());
  RgbdWorld copy = world;
  const View view = *room(1).start;
  EXPECT_TRUE(same(world.observe(view)->depth, copy.observe(view)->depth));
  copy.observe(view);
  EXPECT_EQ(world.measurements(), 1U);
  EXPECT_EQ(copy.measurements(), 2U);
}

TEST(RgbdWorld, RefusesEmptyScenesAndBadViews) {
  EXPECT_THROW(RgbdWorld(Scene{}, Rng(1)), Error);
  Scene broken = room(1);
  broken.mesh.vertices[7].z() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(RgbdWorld(broken, Rng(1)), Error);
  RgbdWorld world(room(1), Rng(1), small());
  View view = *room(1).start;
  view.T_W_C.translation().x() = std::numeric_limits<double>::infinity();
  EXPECT_THROW(world.observe(view), Error);
  view = *room(1).start;
  view.T_W_C.linear().row(0).setZero();
  EXPECT_THROW(world.observe(view), Error);
  EXPECT_EQ(world.measurements(), 0U);
}

}  // namespace
}  // namespace vantage
