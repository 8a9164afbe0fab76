// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/explain.hpp>
#include <vantage/concepts/map.hpp>
#include <vantage/concepts/policy.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/planning/line_of_sight.hpp>
#include <vantage/planning/passable.hpp>

namespace vantage {

struct ViewTreeConfig {
  int nodes = 30;                         ///< of a tree, 1 to 65536
  int max_nodes = 200;                    ///< if nothing is worth anything it grows on, up to so many; nodes to 65536
  double step_m = 1;                      ///< length of an edge at most, > 0
  double discount_per_m = 0.5;            ///< lambda, >= 0
  std::optional<double> own_ball_m = {};  ///< as AStar's
};

/// A tree of views that grows from where the robot is: the receding horizon of Bircher et al. ("Receding horizon
/// next-best-view planner for 3D exploration", ICRA 2016; section 2.2.3). A rapidly-exploring random tree of level
/// views: a random position in the map's box is drawn, the nearest node makes one step towards it, no longer than
/// `step_m`, and the node that ends there looks into a random direction. An edge that touches a voxel where the robot's
/// body does not fit is not taken. A node's gain is what the views on its branch promise together, each scored as if
/// those before it had been measured, and discounted by the way l to it along the branch:
///
///     gain(v_k) = gain(v_(k-1)) + psi(v_k | v_1 .. v_(k-1)) exp(-lambda l(v_k)),    gain(here) = 0
///
/// Proposes all nodes, their gains as utilities, and parents (-1: the robot's own view is the one before). The best
/// branch is remembered; if the robot then is at its first view, the rest of it, as far as it is still open, begins the
/// next tree. FirstOfBranch decides accordingly. With utilities >= 0 the best gain is 0 only if `max_nodes` nodes found
/// nothing: a stop rule on the best utility ends the mission then. Nothing is proposed if the robot is outside of the
/// grid, or no edge is open. Nodes are scored concurrently. Not shared between threads.
class ViewTree {
 public:
  using MapNeeds = Needs<need::Navigable>;
  using Config = ViewTreeConfig;
  ViewTree() : ViewTree(Config{}) {}
  explicit ViewTree(const Config& config) : config_(config) {
    Check check("ViewTree::Config");
    check(config.nodes >= 1 && config.nodes <= 1 << 16, "nodes", config.nodes, "1 to 65536");
    check(config.max_nodes >= config.nodes && config.max_nodes <= 1 << 16, "max_nodes", config.max_nodes,
          "nodes to 65536");
    check.positive("step_m", config.step_m);
    check.not_negative("discount_per_m", config.discount_per_m);
    check.not_negative("own_ball_m", config.own_ball_m.value_or(0));
    check.done();
  }

  template <NavigableMap M>
  Candidates sample(const M& map, const Situation& q, const Score& score, Rng& rng) {
    const std::vector<View> seed = std::exchange(branch_, {});
    const VoxelGrid& grid = map.grid();
    if (!grid.box().contains(q.here.position())) return {};
    const Eigen::Vector3i own = grid.voxel_at(q.here.position());
    const Passable<M> open(map, own, config_.own_ball_m);
    // The ball around the robot lets it leave, not creep on to where it does not fit.
    const auto fits = [&](const Eigen::Vector3i& voxel) { return voxel == own || map.navigable(voxel); };
    Tree tree{.root = q.here};
    if (!seed.empty() && same_place(seed.front(), q.here))
      for (std::size_t k = 1; k < seed.size() && k <= static_cast<std::size_t>(config_.nodes); ++k) {
        const int parent = static_cast<int>(k) - 2;
        if (!line_of_sight(open, tree.view(parent).position(), seed[k].position())) break;
        tree.add(seed[k], parent);
      }
    const auto most = static_cast<std::size_t>(config_.max_nodes);
    for (auto n = static_cast<std::size_t>(config_.nodes);; n = std::min(2 * n, most)) {
      const bool grown = grow(tree, n, grid, open, fits, rng);
      evaluate(tree, score);
      const auto best = std::max_element(tree.gain.begin(), tree.gain.end());  // the first of equals
      if (best == tree.gain.end()) return {};
      if (grown && n < most && !(*best > 0)) continue;
      branch_ = tree.branch(static_cast<int>(best - tree.gain.begin()));
      break;
    }
    return {.views = std::move(tree.views), .utilities = std::move(tree.gain), .parent = std::move(tree.parent)};
  }

  /// The best branch of the last tree: what it began with, if the robot follows.
  [[nodiscard]] const std::vector<View>& branch() const { return branch_; }

  void save(Sink& sink) const { save_views(sink, branch_); }
  void load(Source& source) { branch_ = load_views(source); }

 private:
  struct Tree {
    View root;
    std::vector<View> views = {};
    std::vector<int> parent = {};
    std::vector<double> way_m = {};  // from the root
    std::vector<double> worth = {};  // discounted, of the node alone; for the nodes evaluated so far
    std::vector<double> gain = {};

    [[nodiscard]] const View& view(int node) const { return node < 0 ? root : views[static_cast<std::size_t>(node)]; }
    void add(const View& v, int before) {
      const double so_far_m = before < 0 ? 0 : way_m[static_cast<std::size_t>(before)];
      way_m.push_back(so_far_m + distance_m(view(before), v));
      views.push_back(v);
      parent.push_back(before);
    }
    /// The views from the first after the root to a node.
    [[nodiscard]] std::vector<View> branch(int node) const {
      std::vector<View> branch;
      for (; node >= 0; node = parent[static_cast<std::size_t>(node)]) branch.push_back(view(node));
      std::reverse(branch.begin(), branch.end());
      return branch;
    }
    [[nodiscard]] int nearest(const Eigen::Vector3d& p) const {
      int nearest = -1;
      double least = (root.position() - p).squaredNorm();
      for (std::size_t i = 0; i < views.size(); ++i)
        if (const double d = (views[i].position() - p).squaredNorm(); d < least)
          least = d, nearest = static_cast<int>(i);
      return nearest;
    }
  };

  /// Up to n nodes; whether there are so many. A node costs as many draws as it takes to find an open edge, in the mean
  /// not more than a hundred.
  template <class P, class F>
  bool grow(Tree& tree, std::size_t n, const VoxelGrid& grid, const P& open, const F& fits, Rng& rng) const {
    const Box3 box = grid.box();
    for (std::size_t draws = 100 * n; tree.views.size() < n && draws > 0; --draws) {
      Eigen::Vector3d p;
      for (int axis = 0; axis < 3; ++axis) p[axis] = rng.uniform(box.min()[axis], box.max()[axis]);
      const double yaw_rad = rng.uniform(0, 2 * std::numbers::pi);
      const int before = tree.nearest(p);
      const Eigen::Vector3d from = tree.view(before).position(), way = p - from;
      const double way_m = way.norm();
      if (way_m < 1e-6) continue;
      const Eigen::Vector3d to = from + std::min(1.0, config_.step_m / way_m) * way;
      if (!fits(grid.voxel_at(to)) || !line_of_sight(open, from, to)) continue;
      tree.add(look_at(to, to + Eigen::Vector3d(std::cos(yaw_rad), std::sin(yaw_rad), 0)), before);
    }
    return tree.views.size() == n;
  }
  /// Scores the nodes that are new, then adds up the gains of all.
  void evaluate(Tree& tree, const Score& score) const {
    const std::size_t old = tree.worth.size(), n = tree.views.size();
    tree.worth.resize(n);
    parallel_for(n - old, [&](std::size_t k) {
      const std::size_t i = old + k;
      const std::vector<View> given = tree.branch(tree.parent[i]);
      double psi = 0;
      score(given, {&tree.views[i], 1}, {&psi, 1});
      tree.worth[i] = psi * std::exp(-config_.discount_per_m * tree.way_m[i]);
    });
    tree.gain = tree.worth;
    for (std::size_t i = 0; i < n; ++i)
      if (tree.parent[i] >= 0) tree.gain[i] += tree.gain[static_cast<std::size_t>(tree.parent[i])];
  }
  Config config_;
  std::vector<View> branch_;
};

}  // namespace vantage
