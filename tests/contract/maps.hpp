// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/loop/carry.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/maps/field/latent.hpp>
#include <vantage/maps/field/matern.hpp>
#include <vantage/maps/field/methods.hpp>
#include <vantage/maps/surfel/surfel_presets.hpp>
#include <vantage/maps/voxel/voxel_presets.hpp>
#include <vantage/maps/voxel/with_sides.hpp>

#include "../voxel_scenes.hpp"
#include "lists.hpp"

// Every map, and how to try it. A new map is one line in a list and a MapFixture; the contract suites, the matrix and
// the static product follow.
namespace vantage {
namespace test {
struct Saving;  ///< a need of the tests' own: the suite of the map contract compares bytes
}
template <class M>
inline constexpr bool offers<M, test::Saving> = Persistent<M>;
}  // namespace vantage

namespace vantage::test {

using CarryMap = Carry<archetype::FullMap, archetype::Persistent<>>;
using OursMap = Ours<>;
using LatentMap = Ours<preset::thesis, Latent<>>;
using PublishedVoxels = PresetVoxelMap<preset::reference>;
using MaternMap = IntegralGp<Matern32>;
using RayPlaneMap = ActiveGsMap<preset::reference, IncrementalConfidence, TileRasteriser<16, RayPlaneDepth>>;

using Maps =
    List<archetype::Map, archetype::Uncertain<>, archetype::Forecasting<>, archetype::FullMap, CarryMap, OursMap,
         Ours<preset::reference>, LatentMap, MaternMap, FrGpf<>, FrIdp<>, ArIdp<>, ArGprIk<>, ArBcm<>, VoxelMap<>,
         PublishedVoxels, SemanticVoxelMap<5>, WithSides<>, ActiveGsMap<>, ActiveGsMap<preset::thesis>, RayPlaneMap>;
using PersistentMaps = typename Offering<Maps, Saving>::type;
/// How to try a map: `make()`, and `large()` if a small one does not keep several threads busy; `measurement(k)`, good
/// ones; `refused()`, bad ones with their names; `views()`, from which it may be asked; `World`; and whether
/// measurements are possible straight down only.
template <class M>
struct MapFixture;

inline const double nan = std::numeric_limits<double>::quiet_NaN();
inline const double infinity = std::numeric_limits<double>::infinity();

template <std::derived_from<archetype::Map> M>
struct MapFixture<M> {
  using World = archetype::World;
  static constexpr bool looks_down_only = false;
  static M make() { return M{}; }
  static archetype::Look measurement(std::size_t k) {
    return {nadir(k % 3 == 0 ? -1 : 1, 0.1 * static_cast<double>(k), 1)};
  }
  static std::vector<std::pair<std::string, archetype::Look>> refused() {
    View scaled = nadir(0, 0, 1);
    scaled.T_W_C.linear() *= 2;
    return {{"NaN", {nadir(nan, 0, 1)}}, {"infinite", {nadir(0, infinity, 1)}}, {"scaled", {scaled}}};
  }
  static std::vector<View> views() {
    return {nadir(-0.5, 0, 0.9), nadir(0.5, 0, 1), look_at({2, 2, 2}, {0, 0, 0}), look_at({0, 0, -1}, {0, 0, 1}),
            nadir(5, 5, 0.5)};
  }
};

template <class Planned, class... Riders>
struct MapFixture<Carry<Planned, Riders...>> : MapFixture<Planned> {
  static Carry<Planned, Riders...> make() {
    return Carry<Planned, Riders...>(MapFixture<Planned>::make(), MapFixture<Riders>::make()...);
  }
};

/// A UAV with a gimbal above a wavy field: wherever it is, it looks straight down.
struct WavyWorld {
  NadirSensor sensor = {.half_angle_rad = deg(45), .pixels = 20};
  std::optional<FieldImage> observe(const View& view) {
    const Eigen::Vector3d p =
        view.position().cwiseMax(Eigen::Vector3d(0, 0, 0.5)).cwiseMin(Eigen::Vector3d(20, 20, 100));
    FieldImage z{nadir(p.x(), p.y(), p.z()), {}, {}};
    z.footprint = sensor.footprint(z.view);
    z.values.resize(sensor.pixels, sensor.pixels);
    for (Eigen::Index r = 0; r < z.values.rows(); ++r)
      for (Eigen::Index c = 0; c < z.values.cols(); ++c) {
        const Eigen::Vector2d at = z.footprint.min() + z.footprint.sizes().cwiseProduct(Eigen::Vector2d(
                                                           (static_cast<double>(c) + 0.5) / sensor.pixels,
                                                           (static_cast<double>(r) + 0.5) / sensor.pixels));
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
    return *world.observe(nadir(2.5 + 5 * static_cast<double>(k % 4), 2.5 + 5 * static_cast<double>(k / 4 % 4),
                                2.5 + 0.25 * static_cast<double>(k % 3)));
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
  static M make(int depth = 4) { return M(typename M::Config{.tree = {.depth = depth}, .prior_mean = 0.75}); }
  static M large() { return make(5); }
};

/// Frames of a small room, from wherever they are asked for.
struct RoomWorld {
  std::uint64_t seed = 0;
  std::optional<Frame> observe(const View& view) {
    Frame f = random_frame(Rng(seed++), 40);
    Frame seen = observe_room(view, f.camera);
    f.depth = std::move(seen.depth);
    f.colour = std::move(seen.colour);
    f.view = view;
    return f;
  }
};

/// Maps of frames of the small room.
struct RoomFixture {
  using World = RoomWorld;
  static constexpr bool looks_down_only = false;
  static Frame measurement(std::size_t k) { return random_frame(Rng(11).fork(k), 40); }
  static std::vector<std::pair<std::string, Frame>> refused() {
    const Frame good = measurement(1);
    std::vector<std::pair<std::string, Frame>> bad(6, {"", good});
    bad[0].first = "no depth", bad[0].second.depth.resize(0, 0);
    bad[1].first = "depth of another size", bad[1].second.depth.setOnes(3, 4);
    bad[2].first = "depth 0", bad[2].second.depth(3, 4) = 0;
    bad[3].first = "infinite depth", bad[3].second.depth(3, 4) = std::numeric_limits<float>::infinity();
    bad[4].first = "NaN pose", bad[4].second.view.T_W_C.translation().x() = nan;
    bad[5].first = "no focal length", bad[5].second.camera.fx = 0;
    return bad;
  }
  static std::vector<View> views() {
    std::vector<View> all;
    for (std::size_t k = 0; k < 5; ++k) all.push_back(measurement(k).view);
    return all;
  }
  /// All around from a corner, so that there are places to go to, and the far side of the ball is still to be seen.
  static std::vector<View> first_views() {
    const Eigen::Vector3d eye(-0.7, -0.3, 0.8);
    std::vector<View> all;
    for (const double pitch_rad : {0.0, -0.9, 0.9})
      for (int k = 0; k < 8; ++k)
        all.push_back(
            look_at(eye, eye + Eigen::Vector3d(std::cos(k * deg(45)), std::sin(k * deg(45)), std::tan(pitch_rad))));
    return all;
  }
};

template <class Update, class Semantics, class Clearance>
struct MapFixture<VoxelMap<Update, Semantics, Clearance>> : RoomFixture {
  using M = VoxelMap<Update, Semantics, Clearance>;
  static M make(double voxel_m = 0.1) {
    typename M::Config c;
    c.bounds = small_room;
    c.voxel_m = voxel_m;
    c.clearance_m = 0.15;
    return M(c);
  }
  static M large() { return make(0.03); }
};

template <class Voxels>
struct MapFixture<WithSides<Voxels>> : MapFixture<Voxels> {
  static WithSides<Voxels> make() { return WithSides<Voxels>(MapFixture<Voxels>::make().config()); }
  static WithSides<Voxels> large() { return WithSides<Voxels>(MapFixture<Voxels>::large().config()); }
};

template <class Rasteriser, class Confidence, class Variation, class Voxels>
struct MapFixture<SurfelMap<Rasteriser, Confidence, Variation, Voxels>> : RoomFixture {
  using M = SurfelMap<Rasteriser, Confidence, Variation, Voxels>;
  static M make() {
    typename M::Config c;
    c.voxels = MapFixture<Voxels>::make().config();
    c.iterations = 2;
    return M(c);
  }
  static std::vector<std::pair<std::string, Frame>> refused() {
    auto bad = RoomFixture::refused();
    bad.emplace_back("no colour", measurement(1)).second.colour = {};
    bad.emplace_back("colour above 1", measurement(1)).second.colour.g(3, 4) = 1.5F;
    bad.emplace_back("NaN colour", measurement(1)).second.colour.r(3, 4) = std::numeric_limits<float>::quiet_NaN();
    return bad;
  }
};

}  // namespace vantage::test
