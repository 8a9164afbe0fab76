// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include <vantage/concepts/channels.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/concepts/sides.hpp>
#include <vantage/concepts/world.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>

// A minimal model of each concept: copy the one you need and write your own in its place. They are no mock-ups: they
// keep every promise of their concept, and the contract tests run over them as over the real ones. The map counts how
// often it was looked at from either side (x < 0, x >= 0); its doubt about a side falls with each look.
namespace vantage::archetype {

/// What the archetypes' world measures and their maps learn from: only the view that it was taken from.
struct Look {
  View view;
};

/// A Map, and no more: it says what it learns from, learns, and says where it is. It changes nothing when it refuses.
class Map {
 public:
  using Measurement = Look;
  void integrate(const Look& z, Rng&) {
    check_view(z.view, "archetype::Map::integrate");
    ++looks_[side(z.view.position())];
  }
  [[nodiscard]] Box3 bounds() const { return {Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, 1, 1)}; }

 protected:
  static std::size_t side(const Eigen::Vector3d& p) { return p.x() < 0 ? 0 : 1; }
  [[nodiscard]] std::uint64_t looks(std::size_t side) const { return looks_[side]; }
  [[nodiscard]] double doubt(std::size_t side) const { return 1 / (1 + static_cast<double>(looks_[side])); }
  std::array<std::uint64_t, 2> looks_{};
};

// Each of the following adds one capability to a map, so that any combination can be built: Forecasting<Uncertain<>>.

/// Persistent: saves and loads itself. `load` reads everything before it changes anything.
template <class Base = Map>
class Persistent : public Base {
 public:
  void save(Sink& sink) const {
    for (const std::uint64_t n : this->looks_) sink.put(n);
  }
  void load(Source& source) {
    const auto left = source.get<std::uint64_t>(), right = source.get<std::uint64_t>();
    this->looks_ = {left, right};
  }
};

/// UncertainMap: an image of the camera's size, finite and >= 0 everywhere.
template <class Base = Map>
class Uncertain : public Base {
 public:
  void render(const View& view, const Camera& camera, Rendering<channel::Uncertainty>& out) const {
    out.uncertainty.setConstant(camera.height, camera.width,
                                static_cast<float>(this->doubt(this->side(view.position()))));
  }
};

/// DepthMap beside UncertainMap: how far the plane z = 0 is along the camera's axis, NaN where nothing is hit.
template <class Base = Uncertain<>>
class Ranging : public Base {
 public:
  using Base::render;
  void render(const View& view, const Camera& camera, Rendering<channel::Depth>& out) const {
    const double depth = -view.position().z() / view.forward().z();
    const bool hit = view.forward().z() != 0 && depth > 0;
    out.depth.setConstant(camera.height, camera.width,
                          hit ? static_cast<float>(depth) : std::numeric_limits<float>::quiet_NaN());
  }
};

/// Draws entropy and expected information gain beside what else it draws: a coin for each look that is missing.
template <class Base = Uncertain<>>
class Informative : public Base {
 public:
  using Base::render;
  void render(const View& view, const Camera& camera, Rendering<channel::Entropy>& out) const {
    const double doubt = this->doubt(this->side(view.position()));
    out.entropy.setConstant(camera.height, camera.width, static_cast<float>(std::numbers::ln2 * doubt));
  }
  void render(const View& view, const Camera& camera, Rendering<channel::InformationGain>& out) const {
    const auto n = static_cast<double>(this->looks(this->side(view.position())));
    const double gain = std::numbers::ln2 * (1 / (1 + n) - 1 / (2 + n));
    out.information_gain.setConstant(camera.height, camera.width, static_cast<float>(gain));
  }
};

/// Draws depth together with confidence, which is what is not doubted.
template <class Base = Ranging<>>
class Confident : public Base {
 public:
  using Base::render;
  void render(const View& view, const Camera& camera, Rendering<channel::Depth, channel::Confidence>& out) const {
    Rendering<channel::Depth> ranging;
    render(view, camera, ranging);
    out.depth = ranging.depth;
    const double doubt = this->doubt(this->side(view.position()));
    out.confidence.setConstant(camera.height, camera.width, static_cast<float>(1 - doubt));
  }
};

/// ForecastMap: what one more look would take from the doubt about its side, were the given looks taken before.
template <class Base = Map>
class Forecasting : public Base {
 public:
  void forecast(Views given, Views views, std::span<double> reduction) const {
    for (std::size_t i = 0; i < views.size(); ++i) {
      const std::size_t s = this->side(views[i].position());
      double n = static_cast<double>(this->looks(s));
      for (const View& g : given) n += this->side(g.position()) == s;
      reduction[i] = 1 / (1 + n) - 1 / (2 + n);
    }
  }
};

/// CoverageMap: the share of sides seen.
template <class Base = Map>
class Covering : public Base {
 public:
  [[nodiscard]] double coverage() const { return 0.5 * ((this->looks(0) > 0) + (this->looks(1) > 0)); }
};

/// OccupancyMap: a side is free once it was seen.
template <class Base = Map>
class Occupied : public Base {
 public:
  [[nodiscard]] Space at(const Eigen::Vector3d& p) const {
    return this->bounds().contains(p) && this->looks(this->side(p)) > 0 ? Space::free : Space::unknown;
  }
};

/// VoxelOccupancy: 8 x 8 x 4 voxels, one block; those of a side that was seen are free.
template <class Base = Occupied<>>
class Voxelled : public Base {
 public:
  [[nodiscard]] const VoxelGrid& grid() const { return grid_; }
  [[nodiscard]] Space state(const Eigen::Vector3i& voxel) const { return this->at(grid_.centre(voxel)); }
  [[nodiscard]] std::span<const Eigen::Vector3i> known_blocks() const {
    static const Eigen::Vector3i block = Eigen::Vector3i::Zero();
    return {&block, this->looks(0) + this->looks(1) > 0 ? std::size_t{1} : std::size_t{0}};
  }
  [[nodiscard]] VoxelBits free_in(const Eigen::Vector3i& block) const {
    VoxelBits bits;
    VoxelBits::inside(grid_, block).for_each([&](std::size_t local) {
      if (state(voxel_of(block, local)) == Space::free) bits.set(local);
    });
    return bits;
  }
  [[nodiscard]] VoxelBits occupied_in(const Eigen::Vector3i&) const { return {}; }
  [[nodiscard]] VoxelBits unexplored_in(const Eigen::Vector3i& block) const {
    return VoxelBits::inside(grid_, block) & ~free_in(block);
  }

 private:
  VoxelGrid grid_ = VoxelGrid::dividing(Map().bounds(), 0.25);
};

/// NavigableMap: its robot fits into a voxel.
template <class Base = Voxelled<>>
class Navigable : public Base {
 public:
  [[nodiscard]] double clearance_m() const { return 0.1; }
  [[nodiscard]] bool navigable(const Eigen::Vector3i& voxel) const {
    return this->grid().contains(voxel) && this->state(voxel) == Space::free;
  }
  [[nodiscard]] VoxelBits navigable_in(const Eigen::Vector3i& block) const { return this->free_in(block); }
};

/// RegionMap: while only one side was seen, the place where it ends, to be looked at from within.
template <class Base = Occupied<>>
class Frontiers : public Base {
 public:
  [[nodiscard]] std::vector<Region> regions(frontier) const {
    std::vector<Region> found;
    for (const double x : {-0.125, 0.125})
      if (this->looks(this->side({x, 0, 0})) > 0 && this->looks(this->side({-x, 0, 0})) == 0)
        found.push_back({{x, 0.125, 0.125}, {x < 0 ? -1.0 : 1.0, 0, 0}});
    return found;
  }
};

/// SideMap: one side is seen from where x < 0, the other from elsewhere.
template <class Base = Map>
class Sided : public Base {
 public:
  [[nodiscard]] std::vector<std::uint64_t> unseen_sides(const View& view, const Camera&, double) const {
    const std::size_t side = this->side(view.position());
    return this->looks(side) == 0 ? std::vector<std::uint64_t>{side} : std::vector<std::uint64_t>{};
  }
};

/// RegionMap: the middle of a side that was seen once, to be looked at from above.
template <class Base = Frontiers<>>
class Unsure : public Base {
 public:
  using Base::regions;
  [[nodiscard]] std::vector<Region> regions(low_confidence) const {
    std::vector<Region> found;
    for (const double x : {-0.5, 0.5})
      if (this->looks(this->side({x, 0, 0})) == 1) found.push_back({{x, 0.1, 0.1}, {0, 0, 1}});
    return found;
  }
};

/// FieldMap: two cells whose variance is the doubt.
template <class Base = Map>
class Field : public Base {
 public:
  [[nodiscard]] std::size_t size() const { return 2; }
  [[nodiscard]] Box2 cell(std::size_t i) const {
    return i == 0 ? Box2(Eigen::Vector2d(-1, -1), Eigen::Vector2d(0, 1))
                  : Box2(Eigen::Vector2d(0, -1), Eigen::Vector2d(1, 1));
  }
  [[nodiscard]] double mean(std::size_t) const { return 0; }
  [[nodiscard]] double variance(std::size_t i) const { return this->doubt(i); }
  [[nodiscard]] std::size_t cell_at(const Eigen::Vector2d& p) const {
    if (!(p.cwiseAbs().maxCoeff() <= 1))
      throw Error("archetype::Field::cell_at", "a point outside", "[-1, 1] x [-1, 1]");
    return this->side({p.x(), p.y(), 0});
  }
};

/// FisherMap: one parameter a side; a view informs about its own side.
template <class Base = Map>
class Fisher : public Base {
 public:
  [[nodiscard]] std::size_t parameters() const { return 2; }
  void fisher(const View& view, const Camera& camera, std::span<double> diagonal) const {
    diagonal[this->side(view.position())] += static_cast<double>(camera.width) * camera.height;
  }
};

/// RefinableMap: may train while the robot moves; here there is nothing to train.
template <class Base = Map>
class Refinable : public Base {
 public:
  void refine(int, Rng&) {}
};

/// A map with all of it, in the order in which the layers are put on.
using FullMap = Persistent<Refinable<Fisher<Field<Sided<Unsure<
    Frontiers<Navigable<Voxelled<Occupied<Covering<Forecasting<Informative<Confident<Ranging<Uncertain<>>>>>>>>>>>>>>>>;

/// ViewUtility: psi(M, v). Here: views from the right are better, the higher the better.
struct ViewUtility {
  template <vantage::Map M>
  double operator()(const M&, const View& v) const {
    return (v.position().x() < 0 ? 0.0 : 1.0) + std::abs(v.position().z());
  }
};

/// HistoryUtility: with what happened so far. Here: far from where the robot is.
struct HistoryUtility {
  template <vantage::Map M>
  double operator()(const M&, const Situation& q, const View& v) const {
    return distance_m(q.here, v);
  }
};

/// PreparedUtility: shares work among a step's candidates, and scores sequences. Here: far from the views' middle.
struct PreparedUtility {
  template <vantage::Map M>
  auto prepare(const M&, const Situation& q, Rng) const {
    Eigen::Vector3d sum = q.here.position();
    for (const View& v : q.visited) sum += v.position();
    return [sum, n = q.visited.size() + 1](Views given, Views views, std::span<double> out) {
      Eigen::Vector3d middle = sum;
      for (const View& v : given) middle += v.position();
      middle /= static_cast<double>(n + given.size());
      for (std::size_t i = 0; i < views.size(); ++i) out[i] = (views[i].position() - middle).norm();
    };
  }
};

/// SamplerFor every map. Here: a random place on either side, looking down.
struct Sampler {
  template <vantage::Map M>
  Candidates sample(const M&, const Situation&, const Score&, Rng& rng) const {
    Candidates c;
    for (const double x : {-1.0, 1.0})
      c.views.push_back(nadir(x * rng.uniform(0.1, 1), rng.uniform(-1, 1), rng.uniform(0.5, 1)));
    return c;
  }
};

/// SelectorFor every map. Here: the best candidate, the first one at a tie; none if there are none.
struct Selector {
  template <vantage::Map M>
  std::optional<Decision> select(const M&, const Situation& q, const Candidates& c, const Score&, Rng&) const {
    if (c.views.empty()) return std::nullopt;
    const auto best = std::max_element(c.utilities.begin(), c.utilities.end());  // the first of equals
    const auto index = static_cast<std::size_t>(best - c.utilities.begin());
    const double travel_m = distance_m(q.here, c.views[index]);
    return Decision{.index = index, .travel_s = travel_m, .travel_m = travel_m};
  }
};

/// RouterFor every map. Here: along x, then along y, then along z: |dx| + |dy| + |dz|.
struct Router {
  template <vantage::Map M>
  std::vector<double> lengths_m(const M&, const View& from, Views goals) const {
    std::vector<double> lengths;
    for (const View& goal : goals) lengths.push_back((goal.position() - from.position()).lpNorm<1>());
    return lengths;
  }
  template <vantage::Map M>
  std::vector<View> path(const M&, const View& from, const View& goal) const {
    View x = from, y = from;
    x.T_W_C.translation().x() = goal.position().x();
    y.T_W_C.translation().head<2>() = goal.position().head<2>();
    return {from, x, y, goal};
  }
};

/// WorldFor the maps above: arrives where it is sent, and looks. One that can be steered along a path also has
/// `void follow(const std::vector<View>&)`; one whose recording ends returns none.
struct World {
  std::optional<Look> observe(const View& view) { return Look{view}; }
};

/// ClockLike: here a second for each thing the robot computes, and travel as it is told.
struct Clock {
  double now_s = 0;
  [[nodiscard]] double elapsed_s() const { return now_s; }
  void begin() {}
  void mapped() { now_s += 1; }
  void planned() { now_s += 1; }
  void travelled(double s) { now_s += s; }
};

/// StopRuleFor every map. One that knows how much time is left also has `double remaining_s(const Situation&) const`.
struct StopRule {
  template <vantage::Map M>
  bool operator()(const M&, const Situation& q) const {
    return q.step >= 10;
  }
};

}  // namespace vantage::archetype
