// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <vantage/sampler/all_around.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include <vantage/sampler/fallback.hpp>
#include <vantage/sampler/pool.hpp>

#include "message_of.hpp"
#include "sampler_maps.hpp"

namespace vantage {
namespace {

const View here = look_at({1.47, 1.52, 1.04}, {3, 1.5, 1});

TEST(AllAround, SeesEverythingFromEachPlace) {
  const test::DrawnFrontiers map = test::two_rooms();
  const std::vector<View> views = test::sample(AllAround({.places = 4}), map, {.here = here}, 1).views;
  ASSERT_EQ(views.size() % 4, 0U);
  const std::size_t each = views.size() / 4;
  for (std::size_t place = 0; place < 4; ++place) {
    const std::span of_place = std::span(views).subspan(place * each, each);
    for (const View& v : of_place) EXPECT_TRUE(same_place(v, of_place.front()));
    EXPECT_EQ(same_place(of_place.front(), here), place == 3);
    if (place != 3) { EXPECT_TRUE(map.navigable(map.grid().voxel_at(of_place.front().position()))); }
    // Every direction but straight up and down is in some image.
    Rng rng(2);
    for (int i = 0; i < 200; ++i) {
      const double z = rng.uniform(-0.9, 0.9), turn = rng.uniform(0, 6.3), r = std::sqrt(1 - z * z);
      const Eigen::Vector3d d(r * std::cos(turn), r * std::sin(turn), z);
      EXPECT_TRUE(std::ranges::any_of(of_place, [&](const View& v) {
        const Eigen::Vector3d c = v.T_W_C.linear().transpose() * d;
        return c.z() > 0 && std::abs(c.x()) <= c.z() * std::tan(deg(30.01)) &&
               std::abs(c.y()) <= c.z() * std::tan(deg(30.01));
      })) << d.transpose();
    }
  }
}

TEST(AllAround, GoesAnywhereUnlessTold) {
  const test::DrawnFrontiers map = test::two_rooms();
  const auto farthest = [&](double radius_m) {
    double most = 0;
    for (const View& v : test::sample(AllAround({.places = 200, .radius_m = radius_m}), map, {.here = here}, 3).views)
      most = std::max(most, distance_m(v, here));
    return most;
  };
  EXPECT_GT(farthest(AllAround::Config{}.radius_m), 2);
  EXPECT_LE(farthest(0.5), 0.5 + 1e-9);
}

TEST(AllAround, LooksAroundWhereItStandsIfItCanGoNowhere) {
  const test::DrawnFrontiers map(VoxelGrid::dividing({Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2, 2, 2)}, 0.2), 0.2);
  const auto views = test::sample(AllAround{}, map, {.here = here}, 1).views;
  ASSERT_FALSE(views.empty());
  for (const View& v : views) EXPECT_TRUE(same_place(v, here));
}

TEST(AllAround, RefusesBadConfigs) {
  const auto message = [](const AllAround::Config& c) { return test::message_of([&] { AllAround{c}; }); };
  EXPECT_NE(message({.places = 0}).find("places"), std::string::npos);
  EXPECT_NE(message({.radius_m = 0}).find("radius_m"), std::string::npos);
  EXPECT_NE(message({.field_of_view_rad = 7}).find("field_of_view_rad"), std::string::npos);
}

struct Nothing {
  Candidates sample(const auto&, const Situation&, const Score&, Rng&) const { return {}; }
};
// Utility is the height, as test::sample says.
const Pool low({nadir(1, 1, 1)}), high({nadir(1, 1, 2), nadir(2, 1, 3)});

TEST(Fallback, AsksTheSecondWhenTheFirstHasNothing) {
  const test::DrawnFrontiers map = test::two_rooms();
  const Nothing nothing;
  EXPECT_EQ(test::sample(Fallback(nothing, high), map, {.here = here}, 1).views.size(), 2U);
  EXPECT_EQ(test::sample(Fallback(low, high), map, {.here = here}, 1).views.size(), 1U);
  EXPECT_TRUE(test::sample(Fallback(nothing, nothing), map, {.here = here}, 1).views.empty());
}

TEST(Fallback, AndWhenTheFirstHasTooLittle) {
  const test::DrawnFrontiers map = test::two_rooms();
  EXPECT_EQ(test::sample(Fallback(low, high, {.least = 1.5}), map, {.here = here}, 1).views.size(), 2U);
  const Candidates enough = test::sample(Fallback(high, low, {.least = 2.5}), map, {.here = here}, 1);
  EXPECT_EQ(enough.views.size(), 2U);
  EXPECT_EQ(enough.utilities, (std::vector<double>{2, 3}));  // scored once: the loop need not
  EXPECT_NE(test::message_of([] { Fallback(low, high, {.least = std::nan("")}); }).find("least"), std::string::npos);
}

}  // namespace
}  // namespace vantage
