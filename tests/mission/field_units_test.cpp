// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vantage/maps/field/latent.hpp>
#include <vantage/maps/field/methods.hpp>
#include <vantage/sampler/lawnmower.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>

#include "../../examples/field/units.hpp"

// A map of a field in any unit is the map of that field scaled to [0, 1], in that unit.
namespace {

using namespace vantage;

template <class M>
class FieldUnits : public testing::Test {};

template <class PresetT, class MapT>
struct Method {
  using Preset = PresetT;
  using Map = MapT;
};
using Methods =
    testing::Types<Method<preset::thesis, Ours<preset::thesis>>, Method<preset::reference, Ours<preset::reference>>,
                   Method<preset::thesis, Ours<preset::thesis, Latent<>>>,
                   Method<preset::thesis, FrIdp<preset::thesis>>, Method<preset::reference, ArIdp<preset::reference>>,
                   Method<preset::thesis, ArGprIk<preset::thesis>>>;
TYPED_TEST_SUITE(FieldUnits, Methods);

TYPED_TEST(FieldUnits, DoToTheFieldWhatTheyDoToTheScaledOne) {
  using Map = typename TypeParam::Map;
  constexpr double low = 94, unit = 101.5;
  const ScalarField scaled = random_field(Rng(2), {.columns = 80, .rows = 80});
  const ScalarField field(scaled.area(), low + unit * scaled.values(), {"elevation", "m"});
  auto config = configured<Map, typename TypeParam::Preset>();
  config.tree.depth = 4;
  Map map(config), map_in_unit(field::in_unit_of(field, config));
  FieldWorld world(scaled, DeviationByHeight{}, Rng(3));
  Rng rng;
  const Lawnmower path({.area = scaled.area()});
  for (std::size_t k = 0; k < 8; ++k) {
    FieldImage z = world.observe(path.views()[k]).value();
    map.integrate(z, rng);
    z.values = low + unit * z.values;
    map_in_unit.integrate(z, rng);
    ASSERT_EQ(map.size(), map_in_unit.size()) << "after " << k;
  }
  for (std::size_t i = 0; i < map.size(); ++i) {
    EXPECT_NEAR(low + unit * map.mean(i), map_in_unit.mean(i), 1e-6 * unit);
    EXPECT_NEAR(unit * unit * map.variance(i), map_in_unit.variance(i), 1e-6 * unit * unit);
  }
}

TEST(FieldUnits, AThresholdIsInTheFieldsUnit) {
  const ScalarField field(Box2(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)),
                          (Image<double>(1, 2) << -5, 15).finished());
  const auto config = configured<Ours<>>();
  EXPECT_DOUBLE_EQ(field::in_unit_of(field, config).resolution.interest.threshold, -5 + 0.7 * 20);
  EXPECT_DOUBLE_EQ(field::in_unit_of(field, config, 3.5).resolution.interest.threshold, 3.5);
}

TEST(FieldUnits, AConstantFieldIsNoDivisionByZero) {
  const ScalarField field(Box2(Eigen::Vector2d(0, 0), Eigen::Vector2d(1, 1)), Image<double>::Constant(2, 2, 3.0));
  EXPECT_NO_THROW(Ours<>{field::in_unit_of(field, configured<Ours<>>())});
}

}  // namespace
