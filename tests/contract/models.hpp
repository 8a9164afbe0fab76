// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/loop/carry.hpp>
#include <vantage/loop/clocks.hpp>
#include <vantage/loop/stop_rules.hpp>
#include <vantage/maps/field/diagonal.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/planning/straight_line.hpp>
#include <vantage/sampler/hemisphere.hpp>
#include <vantage/sampler/lattice.hpp>
#include <vantage/sampler/lawnmower.hpp>
#include <vantage/sampler/pool.hpp>
#include <vantage/sampler/spiral.hpp>
#include <vantage/selector/arg_max.hpp>
#include <vantage/selector/in_order.hpp>
#include <vantage/selector/minus_cost.hpp>
#include <vantage/selector/per_flight_time.hpp>
#include <vantage/selector/travel_tradeoff.hpp>
#include <vantage/utility/mean_uncertainty.hpp>
#include <vantage/utility/uninformed.hpp>
#include <vantage/utility/variance_reduction.hpp>
#include <vantage/utility/view_distance.hpp>

// Every model of every concept, and how to make one. A new policy is one line in a list, and a `make` if it has no
// default; a new map is one line and a MapFixture. The contract suites, the matrix and the static product follow.
namespace vantage::test {

template <class... Ts>
struct List {
  static constexpr std::size_t size = sizeof...(Ts);
};
template <std::size_t I, class L>
struct At;
template <std::size_t I, class T, class... Ts>
struct At<I, List<T, Ts...>> : At<I - 1, List<Ts...>> {};
template <class T, class... Ts>
struct At<0, List<T, Ts...>> {
  using type = T;
};
template <class... Ls>
struct Joined {
  using type = List<>;
};
template <class... A>
struct Joined<List<A...>> {
  using type = List<A...>;
};
template <class... A, class... B, class... Rest>
struct Joined<List<A...>, List<B...>, Rest...> : Joined<List<A..., B...>, Rest...> {};
template <class L, class Need>
struct Offering;  // the maps of a list that offer what is needed
template <class... Ts, class Need>
struct Offering<List<Ts...>, Need> : Joined<std::conditional_t<offers<Ts, Need>, List<Ts>, List<>>...> {};
template <template <class...> class To, class L>
struct Into;
template <template <class...> class To, class... Ts>
struct Into<To, List<Ts...>> {
  using type = To<Ts...>;
};

// ---- maps

using OursMap = IntegralGp<>;
using FixedPointMap = IntegralGp<SquaredExponential, CellCentre, Full<>, Fixed<>>;
using IndependentMap = IntegralGp<SquaredExponential, CellAverage, Diagonal, Fixed<>>;
using IndependentMergingMap = IntegralGp<SquaredExponential, CellAverage, Diagonal, Merging<>>;
using CarryMap = Carry<archetype::FullMap, archetype::Persistent<>>;

using Maps = List<archetype::Map, archetype::Uncertain<>, archetype::Forecasting<>, archetype::FullMap, CarryMap, OursMap,
                  FixedPointMap, IndependentMap, IndependentMergingMap>;
/// Those that save themselves: the suite of the map contract compares bytes.
using PersistentMaps = List<archetype::FullMap, CarryMap, OursMap, FixedPointMap, IndependentMap, IndependentMergingMap>;

/// How to try a map: `make()`; `measurement(k)`, good ones; `refused()`, bad ones with their names; `views()`, from which
/// it may be asked; `World`; and whether measurements are possible straight down only.
template <class M>
struct MapFixture;

inline const double nan = std::numeric_limits<double>::quiet_NaN();
inline const double infinity = std::numeric_limits<double>::infinity();

template <std::derived_from<archetype::Map> M>
struct MapFixture<M> {
  using World = archetype::World;
  static constexpr bool looks_down_only = false;
  static M make() { return M{}; }
  static archetype::Look measurement(std::size_t k) { return {nadir(k % 3 == 0 ? -1 : 1, 0.1 * static_cast<double>(k), 1)}; }
  static std::vector<std::pair<std::string, archetype::Look>> refused() {
    View scaled = nadir(0, 0, 1);
    scaled.T_W_C.linear() *= 2;
    return {{"NaN", {nadir(nan, 0, 1)}}, {"infinite", {nadir(0, infinity, 1)}}, {"scaled", {scaled}}};
  }
  static std::vector<View> views() {
    return {nadir(-0.5, 0, 1), nadir(0.5, 0, 1), look_at({2, 2, 2}, {0, 0, 0}), look_at({0, 0, -1}, {0, 0, 1}), nadir(5, 5, 0.5)};
  }
};

template <class Planned, class... Riders>
struct MapFixture<Carry<Planned, Riders...>> : MapFixture<Planned> {
  static Carry<Planned, Riders...> make() { return Carry<Planned, Riders...>(MapFixture<Planned>::make(), MapFixture<Riders>::make()...); }
};

/// A UAV with a gimbal above a wavy field: wherever it is, it looks straight down.
struct WavyWorld {
  NadirSensor sensor = {.half_angle_rad = deg(45), .pixels = 20};
  std::optional<FieldImage> observe(const View& view) {
    const Eigen::Vector3d p = view.position().cwiseMax(Eigen::Vector3d(0, 0, 0.5)).cwiseMin(Eigen::Vector3d(20, 20, 100));
    FieldImage z{nadir(p.x(), p.y(), p.z()), {}, {}};
    z.footprint = sensor.footprint(z.view);
    z.values.resize(sensor.pixels, sensor.pixels);
    for (Eigen::Index r = 0; r < z.values.rows(); ++r)
      for (Eigen::Index c = 0; c < z.values.cols(); ++c) {
        const Eigen::Vector2d at = z.footprint.min() + z.footprint.sizes().cwiseProduct(Eigen::Vector2d(
                                       (static_cast<double>(c) + 0.5) / sensor.pixels, (static_cast<double>(r) + 0.5) / sensor.pixels));
        z.values(r, c) = 0.5 + 0.4 * std::sin(0.5 * at.x()) * std::cos(0.3 * at.y());
      }
    return z;
  }
};

/// Field maps over 20 m x 20 m: what measures and asks about them is the same for all.
struct FieldFixture {
  using World = WavyWorld;
  static constexpr bool looks_down_only = true;
  static FieldImage measurement(std::size_t k) {
    WavyWorld world;
    return *world.observe(nadir(2.5 + 5 * static_cast<double>(k % 4), 2.5 + 5 * static_cast<double>(k / 4 % 4), 2.5 + 0.25 * static_cast<double>(k % 3)));
  }
  static std::vector<std::pair<std::string, FieldImage>> refused() {
    const FieldImage good = measurement(1);
    std::vector<std::pair<std::string, FieldImage>> bad(7, {"", good});
    bad[0].first = "infinite pixel", bad[0].second.values(3, 4) = infinity;
    bad[1].first = "no pixels", bad[1].second.values.resize(0, 0);
    bad[2].first = "footprint of no area", bad[2].second.footprint.max().x() = good.footprint.min().x();
    bad[3].first = "NaN footprint", bad[3].second.footprint.min().y() = nan;
    bad[4].first = "on the ground", bad[4].second.view.T_W_C.translation().z() = 0;
    bad[5].first = "NaN height", bad[5].second.view.T_W_C.translation().z() = nan;
    bad[6].first = "off the map", bad[6].second.footprint.translate(Eigen::Vector2d(100, 0));
    return bad;
  }
  static std::vector<View> views() {
    return {nadir(2.5, 2.5, 2.5), nadir(10, 10, 2), nadir(17.5, 3, 5), nadir(19.9, 19.9, 1), nadir(40, 40, 2)};
  }
};

template <SeparableKernel Kernel, class Cells, class Belief, class Resolution, class Sensor>
struct MapFixture<IntegralGp<Kernel, Cells, Belief, Resolution, Sensor>> : FieldFixture {
  using M = IntegralGp<Kernel, Cells, Belief, Resolution, Sensor>;
  static M make() { return M(typename M::Config{.tree = {.depth = 5}}); }
};

// ---- policies

using Utilities = List<VarianceReduction, MeanUncertainty, ViewDistance<Nearest>, ViewDistance<Mean>, ViewDistance<Sum>,
                       Uninformed, archetype::ViewUtility, archetype::HistoryUtility, archetype::PreparedUtility>;
using Samplers = List<Lattice, Lawnmower, Hemisphere, Spiral, Pool, archetype::Sampler>;
using Selectors = List<ArgMax, InOrder, PerFlightTime, MinusCost<>, TravelTradeoff<>, MinusCost<archetype::Router>,
                       archetype::Selector>;
using Routers = List<StraightLine, archetype::Router>;
using StopRules = List<MissionTime, Measurements, Travel, CoverageReached, UtilityBelow, AnyOf<MissionTime, CoverageReached>,
                       archetype::StopRule>;
using Clocks = List<MeasuredClock, ModelledClock, WallClock, archetype::Clock>;

template <class P>
P make() {
  const Box2 field = Lattice::field_20m();
  if constexpr (std::same_as<P, MeanUncertainty>) return MeanUncertainty(Camera::from_fov(8, 6, deg(60)));
  else if constexpr (std::same_as<P, Lattice>) return Lattice({.layers = {Layer::inside(field, 2, 5, 4), Layer::inside(field, 5, 2, 3)}});
  else if constexpr (std::same_as<P, Lawnmower>) return Lawnmower({.area = field});
  else if constexpr (std::same_as<P, Hemisphere>) return Hemisphere({.centre = {10, 10, 0}, .radius_m = 3, .candidates = 10});
  else if constexpr (std::same_as<P, Spiral>) return Spiral({.centre = {10, 10, 0}, .radius_m = 3});
  else if constexpr (std::same_as<P, Pool>) return Pool(FieldFixture::views());
  else if constexpr (std::same_as<P, MissionTime>) return MissionTime(300);
  else if constexpr (std::same_as<P, Measurements>) return Measurements(10);
  else if constexpr (std::same_as<P, Travel>) return Travel(100);
  else if constexpr (std::same_as<P, CoverageReached>) return CoverageReached(0.9);
  else if constexpr (std::same_as<P, UtilityBelow>) return UtilityBelow(0.5);
  else if constexpr (std::same_as<P, AnyOf<MissionTime, CoverageReached>>) return AnyOf{MissionTime(300), CoverageReached(0.9)};
  else return P{};
}

/// Whether all that a sampler proposes looks straight down, as the field maps' sensor must.
template <class Sampler>
inline constexpr bool looks_down = !std::same_as<Sampler, Hemisphere> && !std::same_as<Sampler, Spiral>;

}  // namespace vantage::test
