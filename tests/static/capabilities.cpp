// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <concepts>
#include <cstdint>
#include <optional>
#include <vector>

#include <vantage/concepts/archetypes.hpp>
#include <vantage/concepts/explain.hpp>
#include <vantage/loop/carry.hpp>
#include <vantage/maps/field/diagonal.hpp>
#include <vantage/maps/field/integral_gp.hpp>
#include <vantage/maps/surfel/surfel_presets.hpp>
#include <vantage/maps/voxel/voxel_presets.hpp>
#include <vantage/maps/voxel/with_sides.hpp>

// The capability table: what each map offers, and what it does not. A map that gains or loses a capability by accident
// does not compile here.
namespace vantage {
namespace {

using need::Coverage, need::Depth, need::Field, need::Fisher, need::Forecast, need::Navigable, need::Occupancy,
    need::Sides, need::Uncertainty, need::Voxels;
using Frontier = need::Regions<frontier>;
using Entropy = need::Channels<channel::Entropy>;
using Gain = need::Channels<channel::InformationGain>;
using Semantics = need::Channels<channel::Semantics>;
using LowConfidence = need::Regions<low_confidence>;

template <class M, class... Ns>
constexpr int offered = (0 + ... + offers<M, Ns>);
/// Offers all of Ns, and nothing else of what there is to offer.
template <class M, class... Ns>
constexpr bool offers_just = Map<M>&& offered<M, Ns...> == sizeof...(Ns) &&
                             offered<M, Uncertainty, Depth, Forecast, Field, Coverage, Occupancy, Voxels, Navigable,
                                     Frontier, LowConfidence, Fisher, Entropy, Gain, Semantics, Sides> == sizeof...(Ns);

// Archetypes: each adds one capability to a plain map.
static_assert(offers_just<archetype::Map>);
static_assert(offers_just<archetype::Uncertain<>, Uncertainty>);
static_assert(offers_just<archetype::Ranging<>, Uncertainty, Depth>);
static_assert(offers_just<archetype::Informative<>, Uncertainty, Entropy, Gain>);
static_assert(offers_just<archetype::Forecasting<>, Forecast>);
static_assert(offers_just<archetype::Forecasting<archetype::Uncertain<>>, Forecast, Uncertainty>);
static_assert(offers_just<archetype::Covering<>, Coverage>);
static_assert(offers_just<archetype::Occupied<>, Occupancy>);
static_assert(offers_just<archetype::Voxelled<>, Occupancy, Voxels>);
static_assert(offers_just<archetype::Navigable<>, Occupancy, Voxels, Navigable>);
static_assert(offers_just<archetype::Frontiers<>, Occupancy, Frontier>);
static_assert(offers_just<archetype::Unsure<>, Occupancy, Frontier, LowConfidence>);
static_assert(Renders<archetype::Confident<>, channel::Depth, channel::Confidence> &&
              !Renders<archetype::Ranging<>, channel::Depth, channel::Confidence>);
static_assert(offers_just<archetype::Field<>, Field>);
static_assert(offers_just<archetype::Fisher<>, Fisher>);
static_assert(offers_just<archetype::Sided<>, Sides>);
static_assert(offers_just<archetype::FullMap, Uncertainty, Depth, Forecast, Field, Coverage, Occupancy, Voxels,
                          Navigable, Frontier, LowConfidence, Fisher, Entropy, Gain, Sides>);
static_assert(RefinableMap<archetype::Refinable<>> && !RefinableMap<archetype::Map>);
static_assert(Persistent<archetype::Persistent<>> && !Persistent<archetype::Map>);

// A Carry offers what its planned map offers; it saves itself if all of its maps do.
static_assert(offers_just<Carry<archetype::Map, archetype::FullMap>>);
static_assert(offers_just<Carry<archetype::Uncertain<>, archetype::Map>, Uncertainty>);
static_assert(Persistent<Carry<archetype::FullMap, archetype::Persistent<>>>);
static_assert(!Persistent<Carry<archetype::FullMap, archetype::Map>>);
static_assert(!Persistent<Carry<archetype::Map, archetype::FullMap>>);

// Integral GP: Uncertain, Field, Forecast (and coverage), whatever its policies.
template <class M>
constexpr bool field_map = offers_just<M, Uncertainty, Field, Forecast, Coverage>&& Persistent<M>;
static_assert(field_map<IntegralGp<>>);
static_assert(field_map<IntegralGp<SquaredExponential, CellCentre, Full<>, Fixed<>>>);
static_assert(field_map<IntegralGp<SquaredExponential, CellAverage, Diagonal, Merging<>>>);
static_assert(field_map<IntegralGp<SquaredExponential, CellAverage, Diagonal, Fixed<>>>);
static_assert(Posed<IntegralGp<>::Measurement> && Posed<archetype::Map::Measurement>);

// Voxels: Depth, Uncertainty, Entropy and InformationGain in any combination; occupancy to the last voxel.
template <class M, class... More>
constexpr bool voxel_map =
    offers_just<M, Uncertainty, Depth, Coverage, Occupancy, Voxels, Navigable, Frontier, Entropy, Gain, More...>&&
        Persistent<M>&& ForetellsRefusal<M>;
static_assert(voxel_map<VoxelMap<>> && voxel_map<PresetVoxelMap<preset::reference>> &&
              std::same_as<PresetVoxelMap<>, VoxelMap<>>);
static_assert(Renders<VoxelMap<>, channel::Depth, channel::InformationGain> && !Renders<VoxelMap<>, channel::Colour> &&
              !Renders<VoxelMap<>, channel::Depth, channel::Colour>);
static_assert(Posed<VoxelMap<>::Measurement>);
static_assert(voxel_map<WithSides<>, Sides> && voxel_map<WithSides<SemanticVoxelMap<5>>, Sides, Semantics>);

// Semantic voxels: classes as well, and only where they are kept.
static_assert(voxel_map<SemanticVoxelMap<5>, Semantics> &&
              voxel_map<SemanticVoxelMap<5, preset::reference>, Semantics> &&
              voxel_map<VoxelMap<RayCast, ClassCounts<2>>, Semantics>);
static_assert(Renders<SemanticVoxelMap<5>, channel::Semantics, channel::Depth, channel::Entropy, channel::Uncertainty,
                      channel::InformationGain> &&
              !Renders<SemanticVoxelMap<5>, channel::Semantics, channel::Labels> &&
              !Renders<VoxelMap<>, channel::Semantics> && !Renders<VoxelMap<>, channel::Depth, channel::Semantics>);
template <class M>
concept KnowsClasses = requires(const M m, const Eigen::Vector3i& voxel) {
  { m.class_probability(voxel, 1) } -> std::same_as<double>;
  { m.label(voxel) } -> std::same_as<std::uint16_t>;
  m.class_counts(voxel);
};
static_assert(KnowsClasses<SemanticVoxelMap<5>> && !KnowsClasses<VoxelMap<>>);

// Surfels: colour, depth and confidence in any combination; what their voxels know; both kinds of regions.
template <class M>
constexpr bool surfel_map =
    offers_just<M, Uncertainty, Depth, Coverage, Occupancy, Voxels, Navigable, Frontier, LowConfidence, Fisher>&&
        Persistent<M>&& RefinableMap<M>&& ForetellsRefusal<M>;
static_assert(surfel_map<ActiveGsMap<>> && surfel_map<ActiveGsMap<preset::thesis>>);
static_assert(surfel_map<ActiveGsMap<preset::reference, ViewCountConfidence>>);
static_assert(Renders<ActiveGsMap<>, channel::Colour, channel::Depth, channel::Opacity, channel::Normal,
                      channel::Confidence, channel::Uncertainty> &&
              Renders<ActiveGsMap<>, channel::Depth, channel::Confidence> &&
              !Renders<ActiveGsMap<>, channel::Entropy> && !Renders<ActiveGsMap<>, channel::Depth, channel::Entropy>);

// What is no map: each lacks one thing.
struct WithoutMeasurement {
  void integrate(int, Rng&);
  Box3 bounds() const;
};
struct WithoutRng {
  using Measurement = int;
  void integrate(int);
  Box3 bounds() const;
};
struct WithoutBounds {
  using Measurement = int;
  void integrate(int, Rng&);
};
struct WithMutableBounds {
  using Measurement = int;
  void integrate(int, Rng&);
  Box3 bounds();
};
struct Immovable {
  using Measurement = int;
  Immovable(Immovable&&) = delete;
  void integrate(int, Rng&);
  Box3 bounds() const;
};
struct MoveOnly : archetype::Map {
  MoveOnly() = default;
  MoveOnly(MoveOnly&&) = default;
  MoveOnly& operator=(MoveOnly&&) = default;
};
static_assert(!Map<int> && !Map<WithoutMeasurement> && !Map<WithoutRng> && !Map<WithoutBounds> &&
              !Map<WithMutableBounds> && !Map<Immovable>);
static_assert(Map<MoveOnly>);  // copies are nobody's business but a Carry's

// Renders: a member that is not const, or draws something else, does not count.
struct RendersOnce : archetype::Map {
  void render(const View&, const Camera&, Rendering<channel::Uncertainty>&);
};
struct RendersColour : archetype::Map {
  void render(const View&, const Camera&, Rendering<channel::Colour>&) const;
};
static_assert(!UncertainMap<RendersOnce> && !UncertainMap<RendersColour>);
static_assert(Renders<RendersColour, channel::Colour> && !Renders<RendersColour, channel::Depth>);
static_assert(offers<RendersColour, need::Channels<channel::Colour>> &&
              !offers<RendersColour, need::Channels<channel::Colour, channel::Depth>>);

// Needs of policies made of others are the needs of all.
struct NeedsTwo {
  using MapNeeds = Needs<Uncertainty, Field>;
};
struct NeedsOne {
  using MapNeeds = Needs<Coverage>;
};
static_assert(std::same_as<NeedsOf<NeedsTwo, int, NeedsOne>, Needs<Uncertainty, Field, Coverage>>);
static_assert(std::same_as<NeedsOf<int>, Needs<>> && std::same_as<NeedsOf<>, Needs<>>);
static_assert(needs_met<archetype::FullMap, NeedsTwo> && !needs_met<archetype::Uncertain<>, NeedsTwo> &&
              needs_met<archetype::Map, int>);

}  // namespace
}  // namespace vantage
