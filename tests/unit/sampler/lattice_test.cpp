// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/sampler/lattice.hpp>

namespace vantage {
namespace {

std::vector<View> sample(const Lattice& lattice, const View& here) {
  const auto scorer = [](Views, Views, std::span<double>) {};
  Rng rng;
  return lattice.sample(archetype::Map{}, Situation{.here = here}, Score(scorer), rng).views;
}

TEST(Lattice, ReferenceHas314Views) {
  const Lattice lattice(Lattice::reference());
  ASSERT_EQ(lattice.views().size(), 314u);
  EXPECT_TRUE(same_place(lattice.views()[0], nadir(2, 2, 2)));
  EXPECT_TRUE(same_place(lattice.views()[1], nadir(2, 3, 2)));
  EXPECT_TRUE(same_place(lattice.views()[17], nadir(3, 2, 2)));
  EXPECT_TRUE(same_place(lattice.views()[288], nadir(18, 18, 2)));
  EXPECT_TRUE(same_place(lattice.views()[289], nadir(5, 5, 5)));
  EXPECT_TRUE(same_place(lattice.views()[290], nadir(5, 7.5, 5)));
  EXPECT_TRUE(same_place(lattice.views()[313], nadir(15, 15, 5)));
}

TEST(Lattice, ThesisHas300Views) {
  const Lattice lattice(Lattice::thesis());
  EXPECT_EQ(lattice.views().size(), 300u);
  int low = 0, high = 0;
  for (const View& v : lattice.views()) {
    low += v.position().z() == 2, high += v.position().z() == 5;
    const Box2 footprint = NadirSensor{}.footprint(v);
    EXPECT_TRUE(Lattice::field_20m().contains(Box2(footprint.min().array() + 1e-9, footprint.max().array() - 1e-9)));
  }
  EXPECT_EQ(low, 270);
  EXPECT_EQ(high, 30);
}

TEST(Lattice, LeavesOutTheCurrentPosition) {
  const Lattice lattice(Lattice::reference());
  EXPECT_EQ(sample(lattice, View{}).size(), 314u);
  const std::vector<View> rest = sample(lattice, nadir(7, 9, 2 + 5e-10));
  EXPECT_EQ(rest.size(), 313u);
  for (const View& v : rest) EXPECT_GT(distance_m(v, nadir(7, 9, 2)), 0.5);
  EXPECT_EQ(sample(lattice, nadir(7, 9, 2.001)).size(), 314u);
  Lattice::Config config = Lattice::reference();
  config.leave_out_current = false;
  EXPECT_EQ(sample(Lattice(config), nadir(7, 9, 2)).size(), 314u);
}

TEST(Lattice, ASingleViewLiesInTheMiddle) {
  const Box2 area(Eigen::Vector2d(1, 2), Eigen::Vector2d(5, 10));
  const Lattice lattice({.layers = {{.height_m = 3, .bounds = area, .nx = 1, .ny = 2}}});
  ASSERT_EQ(lattice.views().size(), 2u);
  EXPECT_TRUE(same_place(lattice.views()[0], nadir(3, 2, 3)));
  EXPECT_TRUE(same_place(lattice.views()[1], nadir(3, 10, 3)));
}

TEST(Lattice, NamesEveryBadLayer) {
  const Box2 area = Lattice::field_20m();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  try {
    Lattice({.layers = {{.height_m = 2, .bounds = area, .nx = 3, .ny = 3},
                        {.height_m = -2, .bounds = area, .nx = 0, .ny = 5000},
                        {.height_m = nan, .bounds = Box2(), .nx = 1, .ny = 1}}});
    FAIL();
  } catch (const Error& e) {
    const std::string text = e.what();
    for (const char* name :
         {"layers[1].height_m", "layers[1].nx", "layers[1].ny", "layers[2].height_m", "layers[2].bounds"})
      EXPECT_NE(text.find(name), std::string::npos) << name;
    EXPECT_EQ(text.find("layers[0]"), std::string::npos);
  }
  EXPECT_THROW(Lattice({.layers = {}}), Error);
  EXPECT_THROW(Lattice({.layers = {Layer::inside(area, 11, 3, 3)}}), Error);  // sees more than the area from there
}

}  // namespace
}  // namespace vantage
