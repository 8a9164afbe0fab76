// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <vantage/core/rng.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {
namespace {

const double nan = std::numeric_limits<double>::quiet_NaN();

TEST(View, NadirLooksStraightDown) {
  const View v = nadir(1, 2, 3);
  EXPECT_EQ(v.position(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(v.forward(), Eigen::Vector3d(0, 0, -1));
  EXPECT_EQ(v.T_W_C * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(2, 2, 3));  // camera x = world x
  EXPECT_EQ(v.T_W_C * Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(1, 1, 3));  // camera y = -world y
  EXPECT_NO_THROW(check_view(v, "test"));
}

TEST(View, LookAtLooksAtItUpright) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const auto point = [&] { return Eigen::Vector3d(rng.uniform(-5, 5), rng.uniform(-5, 5), rng.uniform(-5, 5)); };
    const Eigen::Vector3d eye = point(), target = point();
    const View v = look_at(eye, target);
    EXPECT_NO_THROW(check_view(v, "test"));
    EXPECT_EQ(v.position(), eye);
    EXPECT_TRUE(v.forward().isApprox((target - eye).normalized(), 1e-12));
    EXPECT_NEAR(v.T_W_C.linear()(2, 0), 0, 1e-12);  // the image's rows are level
    EXPECT_LE(v.T_W_C.linear()(2, 1), 1e-12);       // and its down points down
  }
}

TEST(View, LookAtStraightDownHasWorldYUp) {
  const View v = look_at({0, 0, 5}, {0, 0, 0});
  EXPECT_TRUE(v.T_W_C.linear().isApprox(nadir(0, 0, 5).T_W_C.linear(), 1e-12));
  EXPECT_NO_THROW(check_view(look_at({0, 0, -5}, {0, 0, 0}), "test"));
}

TEST(View, LookAtRefusesTheImpossible) {
  EXPECT_THROW(look_at({1, 2, 3}, {1, 2, 3}), Error);
  EXPECT_THROW(look_at({nan, 2, 3}, {1, 2, 3}), Error);
}

TEST(View, WorldToCameraUndoesCameraToWorld) {
  Rng rng(5);
  for (int i = 0; i < 20; ++i) {
    const View v = look_at({rng.normal(), rng.normal(), rng.normal()}, {rng.normal(), rng.normal(), 5 + rng.normal()});
    EXPECT_LE(((v.T_C_W() * v.T_W_C).matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-14);
  }
}

TEST(View, DistanceIgnoresOrientation) {
  EXPECT_DOUBLE_EQ(distance_m(nadir(0, 0, 0), look_at({3, 4, 0}, {9, 9, 9})), 5);
  EXPECT_TRUE(same_place(nadir(1, 2, 3), look_at({1, 2, 3}, {0, 0, 0})));
  EXPECT_TRUE(same_place(nadir(1, 2, 3), nadir(1, 2, 3 + 5e-10)));
  EXPECT_FALSE(same_place(nadir(1, 2, 3), nadir(1, 2, 3 + 1e-8)));
}

TEST(View, CheckRefusesWhatIsNoPose) {
  View v = nadir(0, 0, 1);
  EXPECT_NO_THROW(check_view(v, "test"));
  v.T_W_C.translation().x() = nan;
  EXPECT_THROW(check_view(v, "test"), Error);
  v = nadir(0, 0, 1);
  v.T_W_C.linear() *= 1.001;
  EXPECT_THROW(check_view(v, "test"), Error);
  v = nadir(0, 0, 1);
  v.T_W_C.linear().col(0) *= -1;  // a reflection
  EXPECT_THROW(check_view(v, "test"), Error);
  v = nadir(0, 0, 1);
  v.T_W_C.linear().setZero();
  EXPECT_THROW(check_view(v, "test"), Error);
  v = nadir(0, 0, 1);
  v.T_W_C.linear().col(0) << std::cos(1e-3), std::sin(1e-3), 0;  // a shear that keeps all lengths
  EXPECT_THROW(check_view(v, "test"), Error);
}

TEST(View, SavesAndLoadsItself) {
  const std::vector<View> views = {nadir(1, 2, 3), look_at({1, 2, 3}, {0, 0, 0})};
  Sink sink;
  save_views(sink, views);
  Source source(sink.bytes());
  const std::vector<View> loaded = load_views(source);
  source.done();
  ASSERT_EQ(loaded.size(), 2U);
  EXPECT_EQ(loaded[1].T_W_C.matrix(), views[1].T_W_C.matrix());

  Sink bad;
  View flat;
  flat.T_W_C.linear().setZero();
  save_views(bad, std::vector{flat});
  for (const auto& bytes : {bad.bytes(), sink.bytes().first(100)}) {
    Source refused(bytes);
    EXPECT_THROW((void)load_views(refused), Error);
  }
}

}  // namespace
}  // namespace vantage
