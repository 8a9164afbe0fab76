// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/sampler/local.hpp>
#include <vantage/sampler/view_cone.hpp>

namespace vantage {

struct RoiAndLocalConfig {
  int candidates = 100;   ///< in all, 1 to 1048576
  int from_regions = 30;  ///< at most, 0 to candidates
  int per_region = 5;     ///< at most, >= 1
  ViewCone cone = {};     ///< from where a region is looked at
  double radius_m = 0.5;  ///< of the local views, > 0
};

/// Views of the regions of interest around the robot, and random ones (section 6.1.5, Fig. 6.3). Of the regions of the
/// given kinds the nearest comes first, by straight distance as published; of each, a few navigable positions in its
/// cone, drawn at random, look at its centre. When there are enough of them, or no region is left, Local draws the
/// rest. Regions of several kinds at one place count once, as the kind named first. Walls between a position and a
/// region are not looked for: the utility sees them. Never empty.
template <class... Kinds>
class RoiAndLocal {
 public:
  static_assert(sizeof...(Kinds) > 0, "vantage: RoiAndLocal looks at no kind of region: name some, or take Local");
  using MapNeeds = Needs<need::Navigable, need::Regions<Kinds>...>;
  using Config = RoiAndLocalConfig;
  RoiAndLocal() : RoiAndLocal(Config{}) {}
  /// Throws Error naming every bad member.
  explicit RoiAndLocal(const Config& config)
      : config_((check(config), config)), local_({.radius_m = config.radius_m, .candidates = config.candidates}) {}

  template <NavigableMap M>
  requires(RegionMap<M, Kinds>&&...) Candidates sample(const M& map, const Situation& q, const Score&, Rng& rng)
  const {
    Candidates c;
    std::vector<Region> regions;
    const auto add = [&](std::vector<Region> more) { regions.insert(regions.end(), more.begin(), more.end()); };
    (add(map.regions(Kinds{})), ...);
    const auto most = static_cast<std::size_t>(config_.from_regions);
    std::vector<Eigen::Vector3i> drawn;
    const Region* before = nullptr;
    // A heap: only the nearest of many regions are ever put in order.
    std::vector<Near> heap = by_distance(regions, q.here.position());
    while (c.views.size() < most && !heap.empty()) {
      std::pop_heap(heap.begin(), heap.end(), later);
      const Region& region = regions[heap.back().index];
      heap.pop_back();
      if (const Region* last = std::exchange(before, &region); last && last->centre == region.centre) continue;
      draw_in_cone(map, region, config_.cone,
                   std::min(static_cast<std::size_t>(config_.per_region), most - c.views.size()), rng, drawn);
      for (const Eigen::Vector3i& voxel : drawn) c.views.push_back(look_at(map.grid().centre(voxel), region.centre));
    }
    local_.draw(map, q, static_cast<std::size_t>(config_.candidates) - c.views.size(), rng, c.views);
    return c;
  }

 private:
  struct Near {
    double distance_m;
    Eigen::Vector3d centre;
    std::size_t index;
    /// Regions at one place follow each other, in the order of their kinds.
    [[nodiscard]] auto key() const { return std::tuple(distance_m, centre.x(), centre.y(), centre.z(), index); }
  };
  static bool later(const Near& a, const Near& b) { return a.key() > b.key(); }
  static std::vector<Near> by_distance(const std::vector<Region>& regions, const Eigen::Vector3d& from) {
    std::vector<Near> heap;
    heap.reserve(regions.size());
    for (std::size_t i = 0; i < regions.size(); ++i)
      heap.push_back({(regions[i].centre - from).norm(), regions[i].centre, i});
    std::make_heap(heap.begin(), heap.end(), later);
    return heap;
  }
  static void check(const Config& c) {
    Check check("RoiAndLocal::Config");
    check(c.candidates >= 1 && c.candidates <= 1 << 20, "candidates", c.candidates, "1 to 1048576");
    check(c.from_regions >= 0 && c.from_regions <= c.candidates, "from_regions", c.from_regions, "0 to candidates");
    check(c.per_region >= 1, "per_region", c.per_region, ">= 1");
    c.cone.check(check);
    check.positive("radius_m", c.radius_m);
    check.done();
  }
  Config config_;
  Local local_;
};
RoiAndLocal()->RoiAndLocal<frontier, low_confidence>;
RoiAndLocal(RoiAndLocalConfig)->RoiAndLocal<frontier, low_confidence>;

}  // namespace vantage
