// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/core/units.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/geometry/voxel_line.hpp>
#include <vantage/planning/passable.hpp>
#include <vantage/planning/reachable_voxels.hpp>
#include <vantage/sampler/view_cone.hpp>

namespace vantage {

/// Views of where the known world ends, near and far: frontier-based exploration (section 2.2.2; FBE in section 6.2.2;
/// Yamauchi, "A frontier-based approach for autonomous exploration", 1997). A map has thousands of frontier voxels,
/// most of them in a few places, so they are first put into the cells of a coarse grid; those of a cell are one
/// cluster, and small ones are left out. Clusters take turns, the nearest first. Each time another of a cluster's
/// voxels is drawn, and for it a position: navigable, in the voxel's cone, and with nothing but free voxels in between.
/// A cluster that no position sees gets no view. A voxel that several measurements looked at from such a position, and
/// that is a frontier still, will not be resolved by one more and gets none either.
///
/// Proposes nothing only when every voxel of every cluster was tried in vain, from 64 positions each: the exploration
/// is over. So it does for a robot outside of the grid. Costs some microseconds a candidate, a sort of the frontier,
/// and what ReachableVoxels costs.
class Frontier {
 public:
  using MapNeeds = Needs<need::Navigable, need::Regions<frontier>>;
  struct Config {
    int candidates = 100;         ///< at most, 1 to 1048576
    ViewCone cone = {};           ///< from where a frontier voxel is looked at
    double cell_m = 1;            ///< edge of the cells that part the frontier into clusters, > 0
    double smallest_m2 = 0.1;     ///< clusters of less area are left out (a voxel counts as one of its faces), >= 0
    int most_looks = 3;           ///< measurements that may look at a voxel in vain, >= 1
    double looked_rad = deg(15);  ///< a measurement looked at what is no farther from its optical axis, in (0, pi]
    std::optional<double> own_ball_m = {};  ///< as AStar's
  };
  Frontier() : Frontier(Config{}) {}
  /// Throws Error naming every bad member.
  explicit Frontier(const Config& config) : config_(config) {
    Check check("Frontier::Config");
    check(config.candidates >= 1 && config.candidates <= 1 << 20, "candidates", config.candidates, "1 to 1048576");
    config.cone.check(check);
    check.positive("cell_m", config.cell_m);
    check.not_negative("smallest_m2", config.smallest_m2);
    check.not_negative("own_ball_m", config.own_ball_m.value_or(0));
    check(config.most_looks >= 1, "most_looks", config.most_looks, ">= 1");
    check(config.looked_rad > 0 && config.looked_rad <= deg(180), "looked_rad", config.looked_rad, "in (0, pi]");
    check.done();
  }

  template <NavigableMap M>
  requires RegionMap<M, frontier> Candidates sample(const M& map, const Situation& q, const Score&, Rng& rng)
  const {
    constexpr int turn = 4;  // voxels of a cluster
    const auto most = static_cast<std::size_t>(config_.candidates);
    const std::vector<Region> regions = map.regions(frontier{});
    Candidates c;
    if (regions.empty() || !map.grid().box().contains(q.here.position())) return c;
    const Eigen::Vector3i start = map.grid().voxel_at(q.here.position());
    const ReachableVoxels reachable(Passable(map, start, config_.own_ball_m), start);
    const Within<M> within{map, reachable};
    std::vector<Eigen::Vector3i> drawn;
    const auto find_view = [&](Cluster& cluster, std::size_t positions) {
      for (int i = 0; i < turn && !cluster.left.empty(); ++i) {
        std::swap(cluster.left[rng.index(cluster.left.size())], cluster.left.back());
        const Region& target = regions[cluster.left.back()];
        cluster.left.pop_back();
        draw_in_cone(within, target, config_.cone, positions, rng, drawn);
        const auto seeing = std::find_if(drawn.begin(), drawn.end(),
                                         [&](const Eigen::Vector3i& from) { return sees(map, from, target.centre); });
        if (seeing == drawn.end() || looked_at(map, target, q.visited)) continue;
        c.views.push_back(look_at(map.grid().centre(*seeing), target.centre));
        return true;
      }
      return false;
    };
    // A turn in vain is a cluster's last: there is enough else to go to. If there is not, all are searched to the end.
    for (const bool thorough : {false, true}) {
      if (!c.views.empty()) break;
      std::vector<Cluster> open = clusters(regions, map.grid(), q.here.position());
      while (!open.empty() && c.views.size() < most) {
        std::vector<Cluster> next;
        for (Cluster& cluster : open) {
          if (c.views.size() == most) break;
          const bool found = find_view(cluster, thorough ? 64 : 4);
          if (!cluster.left.empty() && (found || (thorough && c.views.empty()))) next.push_back(std::move(cluster));
        }
        open = std::move(next);
      }
    }
    return c;
  }

 private:
  /// Navigable voxels within reach.
  template <class M>
  struct Within {
    const M& map;
    const ReachableVoxels& reachable;
    [[nodiscard]] const VoxelGrid& grid() const { return map.grid(); }
    [[nodiscard]] bool navigable(const Eigen::Vector3i& voxel) const {
      return reachable(voxel) && map.navigable(voxel);
    }
    [[nodiscard]] VoxelBits navigable_in(const Eigen::Vector3i& block) const {
      return reachable.in(block)&map.navigable_in(block);
    }
  };
  struct Cluster {
    double distance_m;              ///< from the robot to the nearest region
    std::vector<std::size_t> left;  ///< regions not tried yet
  };
  /// The frontier by cells, nearest first, without crumbs.
  [[nodiscard]] std::vector<Cluster> clusters(const std::vector<Region>& regions, const VoxelGrid& grid,
                                              const Eigen::Vector3d& here) const {
    using Key = std::pair<std::uint64_t, std::size_t>;
    std::vector<Key> by_cell(regions.size());
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const Eigen::Array3d cell = ((regions[i].centre - grid.origin()).array() / config_.cell_m).floor();
      const Eigen::Array<std::uint64_t, 3, 1> k = cell.max(0).min((1 << 21) - 1).cast<std::uint64_t>();
      by_cell[i] = {k.x() | k.y() << 21 | k.z() << 42, i};
    }
    std::sort(by_cell.begin(), by_cell.end());
    const double face_m2 = std::pow(grid.voxel_m().prod(), 2.0 / 3);
    std::vector<Cluster> found;
    for (auto first = by_cell.begin(); first != by_cell.end();) {
      const auto last = std::find_if(first, by_cell.end(), [&](const Key& k) { return k.first != first->first; });
      if (static_cast<double>(last - first) * face_m2 >= config_.smallest_m2) {
        Cluster& cluster = found.emplace_back(Cluster{std::numeric_limits<double>::infinity(), {}});
        for (auto k = first; k != last; ++k) {
          cluster.distance_m = std::min(cluster.distance_m, (regions[k->second].centre - here).norm());
          cluster.left.push_back(k->second);
        }
      }
      first = last;
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Cluster& a, const Cluster& b) { return a.distance_m < b.distance_m; });
    return found;
  }
  /// Whether all voxels from here to the one that holds `target` are free; that one may be anything.
  template <class M>
  static bool sees(const M& map, const Eigen::Vector3i& from, const Eigen::Vector3d& target) {
    const Eigen::Vector3i to = map.grid().voxel_at(target);
    return map.grid().contains(to) && all_between(from, to, [&](const Eigen::Vector3i& voxel) {
             return voxel == to || map.state(voxel) == Space::free;
           });
  }
  template <class M>
  [[nodiscard]] bool looked_at(const M& map, const Region& target, Views visited) const {
    int looks = 0;
    const double cosine = std::cos(config_.looked_rad);
    for (const View& v : visited) {
      const Eigen::Vector3d eye = v.position(), d = target.centre - eye;
      looks += v.forward().dot(d) >= cosine * d.norm() && config_.cone.contains(target, eye) &&
               map.grid().box().contains(eye) && sees(map, map.grid().voxel_at(eye), target.centre);
      if (looks >= config_.most_looks) return true;
    }
    return false;
  }
  Config config_;
};

}  // namespace vantage
