// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <vantage/core/units.hpp>
#include <vantage/sim/replay_world.hpp>

namespace vantage {
namespace {

View turned(double x_m, double yaw_rad) {
  return look_at({x_m, 0, 1}, {x_m + std::cos(yaw_rad), std::sin(yaw_rad), 1});
}

const std::vector<View> views = {turned(0, 0), turned(1, 0), turned(2, 0), turned(2, 1.0)};

// The frame's depth tells which one it is.
Frame frame(std::size_t i) {
  Frame f{Camera::from_fov(2, 2, 1), views[i], {}, {}, {}};
  f.depth.setConstant(2, 2, static_cast<float>(i + 1));
  return f;
}
std::size_t which(const std::optional<Frame>& f) { return static_cast<std::size_t>(f->depth(0, 0)) - 1; }

static_assert(Persistent<ReplayWorld>);

TEST(ReplayWorld, GivesTheNearestFrameOnceAndTellsWhereItWasTaken) {
  ReplayWorld world(views, frame);
  EXPECT_EQ(world.left(), 4U);
  const auto first = world.observe(turned(0.9, 0));
  ASSERT_TRUE(first);
  EXPECT_EQ(which(first), 1U);
  EXPECT_TRUE(first->view.T_W_C.isApprox(views[1].T_W_C));
  EXPECT_EQ(which(world.observe(turned(0.9, 0))), 0U);  // 1 is gone: 0.9 m to 0, 1.1 m to 2
  EXPECT_EQ(world.left(), 2U);
  EXPECT_EQ(which(world.observe(turned(2, 0.6))), 3U);  // nearer in orientation
  EXPECT_EQ(which(world.observe(turned(2, 0.6))), 2U);
  EXPECT_FALSE(world.observe(turned(2, 0.6)));  // the recording has ended
  EXPECT_EQ(world.left(), 0U);
}

TEST(ReplayWorld, OfEqualsTheFirst) {
  ReplayWorld world(views, frame);
  EXPECT_EQ(which(world.observe(turned(0.5, 0))), 0U);
  ReplayWorld place_only(views, frame, {.metres_per_rad = 0});
  EXPECT_EQ(which(place_only.observe(turned(2, 1.0))), 2U);
}

TEST(ReplayWorld, ExactViewsAreAnsweredExactly) {
  ReplayWorld world(views, frame, {.most_apart_m = 1e-9});
  for (std::size_t i = views.size(); i-- > 0;) EXPECT_EQ(which(world.observe(world.views()[i])), i);
}

TEST(ReplayWorld, UsesAndReach) {
  ReplayWorld endless(views, frame, {.uses = 0});
  for (int k = 0; k < 10; ++k) EXPECT_EQ(which(endless.observe(views[2])), 2U);
  EXPECT_EQ(endless.left(), 4U);
  ReplayWorld twice(views, frame, {.uses = 2, .most_apart_m = 0.5});
  EXPECT_EQ(which(twice.observe(views[2])), 2U);
  EXPECT_EQ(which(twice.observe(views[2])), 2U);
  EXPECT_FALSE(twice.observe(views[2]));  // what is left is farther than 0.5 m
  EXPECT_EQ(twice.left(), 3U);
  EXPECT_FALSE(twice.observe(turned(-0.6, 0)));
  EXPECT_TRUE(twice.observe(turned(-0.4, 0)));
}

TEST(ReplayWorld, AFrameThatCannotBeReadIsNotUsedUp) {
  bool broken = true;
  ReplayWorld world(views, [&](std::size_t i) {
    if (broken) throw Error("frame", "damaged");
    return frame(i);
  });
  EXPECT_THROW((void)world.observe(views[3]), Error);
  EXPECT_EQ(world.left(), 4U);
  broken = false;
  EXPECT_EQ(which(world.observe(views[3])), 3U);
}

TEST(ReplayWorld, ResumesWhereItWasSaved) {
  ReplayWorld world(views, frame);
  (void)world.observe(views[1]);
  (void)world.observe(views[2]);
  Sink sink;
  world.save(sink);
  ReplayWorld again(views, frame);
  Source source(sink.bytes());
  again.load(source);
  source.done();
  EXPECT_EQ(again.left(), 2U);
  EXPECT_EQ(which(again.observe(views[1])), which(world.observe(views[1])));

  std::vector<View> others = views;
  others[0] = turned(0.001, 0);
  ReplayWorld other(others, frame);
  Source same(sink.bytes());
  EXPECT_THROW(other.load(same), Error);
  EXPECT_EQ(other.left(), 4U);
  ReplayWorld fewer(views, frame, {.uses = 0});  // it cannot have counted
  Source counted(sink.bytes());
  EXPECT_THROW(fewer.load(counted), Error);
  for (std::size_t cut = 0; cut < sink.bytes().size(); ++cut) {
    Source truncated(sink.bytes().first(cut));
    ReplayWorld fresh(views, frame);
    EXPECT_THROW(fresh.load(truncated), Error) << cut;
    EXPECT_EQ(fresh.left(), 4U);
  }
}

TEST(ReplayWorld, RefusesWhatIsNoWorld) {
  EXPECT_THROW(ReplayWorld({}, frame), Error);
  View bad = views[0];
  bad.T_W_C.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(ReplayWorld({bad}, frame), Error);
  EXPECT_THROW(ReplayWorld(views, frame, {.metres_per_rad = -1}), Error);
  EXPECT_THROW(ReplayWorld(views, frame, {.most_apart_m = std::numeric_limits<double>::quiet_NaN()}), Error);
  ReplayWorld world(views, frame);
  EXPECT_THROW((void)world.observe(bad), Error);
}

}  // namespace
}  // namespace vantage
