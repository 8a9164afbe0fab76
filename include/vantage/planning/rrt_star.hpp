// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/planning/poses.hpp>
#include <vantage/planning/rigid_motion.hpp>

namespace vantage {

/// A way of the body from pose to pose, start and goal included.
struct PosePath {
  std::vector<Eigen::Isometry3d> poses;
  double cost_m = 0;  ///< the sum of the distances, turns included
};

/// A sampling planner for robots that are no spheres: RRT* (Karaman and Frazzoli, "Sampling-based algorithms for
/// optimal motion planning", IJRR 2011, algorithm 6). A tree grows from the start towards random poses; each new node
/// takes the best parent within a radius, and becomes the parent of those there that it offers a shorter way. The
/// radius shrinks as gamma (log n / n)^(1/d), with the gamma of their theorem 38 for the volume of the space and its d
/// dimensions, so that the cost tends to the least one. Poses that cannot be on a shorter way than the best one found
/// are left out. Deterministic for a given `rng`.
///
/// Cost: `samples` draws, each one search through all nodes and a few calls of the collision check, which as a rule is
/// most of the time. const members run concurrently.
template <PoseSpace Space = UprightPoses>
class RrtStar {
 public:
  struct Config {
    Space space;
    int samples = 2000;       ///< draws, 1 to 1048576: the budget
    double step_m = 1;        ///< length of an edge at most, > 0
    double goal_bias = 0.05;  ///< share of the draws that are the goal itself, until it is reached; in [0, 1)
  };
  /// Throws Error naming every bad member.
  explicit RrtStar(const Config& config) : config_(config) {
    config.space.check();
    Check check("RrtStar::Config");
    check(config.samples >= 1 && config.samples <= 1 << 20, "samples", config.samples, "1 to 1048576");
    check.positive("step_m", config.step_m);
    check(config.goal_bias >= 0 && config.goal_bias < 1, "goal_bias", config.goal_bias, "in [0, 1)");
    check.done();
  }

  /// The best way found; none if none was found, or if the start or the goal is in collision. Throws Error for a start
  /// or a goal that is no rigid, finite pose.
  template <CollisionFree C>
  std::optional<PosePath> plan(const Eigen::Isometry3d& start, const Eigen::Isometry3d& goal, const C& body,
                               Rng rng) const {
    check_view({start}, "RrtStar::plan (start)");
    check_view({goal}, "RrtStar::plan (goal)");
    if (!body.is_free(start) || !body.is_free(goal)) return std::nullopt;
    Tree tree{.metres_per_rad = config_.space.metres_per_rad};
    tree.add(start, none, 0);
    Goal best;
    connect(tree, 0, goal, body, best);
    for (int i = 0; i < config_.samples; ++i) {
      const bool towards_goal = best.nodes.empty() && rng.uniform() < config_.goal_bias;
      const Eigen::Isometry3d drawn = towards_goal ? goal : config_.space.draw(rng);
      const std::size_t nearest = tree.nearest(drawn);
      const double away_m = tree.distance_m(nearest, drawn);
      if (away_m < 1e-9) continue;
      const Eigen::Isometry3d pose =
          away_m <= config_.step_m ? drawn : RigidMotion(tree.poses[nearest], drawn).at(config_.step_m / away_m);
      if (tree.distance_m(0, pose) + tree.distance(pose, goal) >= best.cost_m(tree)) continue;
      if (!body.is_free(pose)) continue;
      if (const auto node = insert(tree, pose, nearest, body)) connect(tree, *node, goal, body, best);
    }
    const auto last = best.node(tree);
    if (!last) return std::nullopt;
    PosePath path{.poses = {}, .cost_m = best.cost_m(tree)};
    if (tree.distance_m(*last, goal) > 0) path.poses.push_back(goal);
    for (std::size_t node = *last; node != none; node = tree.parent[node]) path.poses.push_back(tree.poses[node]);
    std::reverse(path.poses.begin(), path.poses.end());
    return path;
  }

 private:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  struct Tree {
    double metres_per_rad;
    std::vector<Eigen::Isometry3d> poses = {};
    std::vector<Eigen::Vector3d> places = {};  // of the poses once more: what a search looks at first
    std::vector<std::size_t> parent = {};
    std::vector<double> cost_m = {};  // from the start
    std::vector<std::vector<std::size_t>> children = {};

    [[nodiscard]] std::size_t size() const { return poses.size(); }
    [[nodiscard]] double distance(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) const {
      return pose_distance_m(a, b, metres_per_rad);
    }
    [[nodiscard]] double distance_m(std::size_t node, const Eigen::Isometry3d& pose) const {
      return distance(poses[node], pose);
    }
    std::size_t add(const Eigen::Isometry3d& pose, std::size_t before, double cost) {
      poses.push_back(pose);
      places.push_back(pose.translation());
      parent.push_back(before);
      cost_m.push_back(cost);
      children.emplace_back();
      if (before != none) children[before].push_back(size() - 1);
      return size() - 1;
    }
    [[nodiscard]] std::size_t nearest(const Eigen::Isometry3d& pose) const {
      std::size_t nearest = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < size(); ++i) {
        if ((places[i] - pose.translation()).squaredNorm() >= least * least) continue;
        if (const double d = distance_m(i, pose); d < least) least = d, nearest = i;
      }
      return nearest;
    }
    /// f(node, distance) for those within a radius.
    template <class F>
    void near(const Eigen::Isometry3d& pose, double radius_m, F&& f) const {
      for (std::size_t i = 0; i < size(); ++i) {
        if ((places[i] - pose.translation()).squaredNorm() > radius_m * radius_m) continue;
        if (const double d = distance_m(i, pose); d <= radius_m) f(i, d);
      }
    }
    void move(std::size_t node, std::size_t to, double cost) {
      std::erase(children[parent[node]], node);
      parent[node] = to;
      children[to].push_back(node);
      const double less = cost_m[node] - cost;
      std::vector<std::size_t> below = {node};
      while (!below.empty()) {
        const std::size_t i = below.back();
        below.pop_back();
        cost_m[i] -= less;
        below.insert(below.end(), children[i].begin(), children[i].end());
      }
    }
  };
  /// The nodes from which the goal is one open edge away.
  struct Goal {
    std::vector<std::pair<std::size_t, double>> nodes = {};
    [[nodiscard]] double cost_m(const Tree& tree) const {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& [node, rest_m] : nodes) least = std::min(least, tree.cost_m[node] + rest_m);
      return least;
    }
    [[nodiscard]] std::optional<std::size_t> node(const Tree& tree) const {
      for (const auto& [node, rest_m] : nodes)
        if (tree.cost_m[node] + rest_m == cost_m(tree)) return node;
      return std::nullopt;
    }
  };

  /// The new node, if it can be reached; its neighbours as its children where that is shorter.
  template <class C>
  std::optional<std::size_t> insert(Tree& tree, const Eigen::Isometry3d& pose, std::size_t nearest,
                                    const C& body) const {
    struct Near {
      std::size_t node;
      double away_m, cost_m;
    };
    std::vector<Near> around;
    const auto add = [&](std::size_t i, double d) { around.push_back({i, d, tree.cost_m[i] + d}); };
    const double radius = radius_m(tree.size());
    if (const double d = tree.distance_m(nearest, pose); d > radius) add(nearest, d);
    tree.near(pose, radius, add);
    std::sort(around.begin(), around.end(),
              [](const Near& a, const Near& b) { return std::pair(a.cost_m, a.node) < std::pair(b.cost_m, b.node); });
    const auto parent = std::find_if(around.begin(), around.end(),
                                     [&](const Near& n) { return body.is_free(tree.poses[n.node], pose); });
    if (parent == around.end()) return std::nullopt;
    const std::size_t node = tree.add(pose, parent->node, parent->cost_m);
    for (const Near& n : around)
      if (n.node != parent->node && tree.cost_m[node] + n.away_m < tree.cost_m[n.node] &&
          body.is_free(pose, tree.poses[n.node]))
        tree.move(n.node, node, tree.cost_m[node] + n.away_m);
    return node;
  }
  template <class C>
  void connect(const Tree& tree, std::size_t node, const Eigen::Isometry3d& goal, const C& body, Goal& best) const {
    const double rest_m = tree.distance_m(node, goal);
    if (rest_m <= config_.step_m && tree.cost_m[node] + rest_m < best.cost_m(tree) &&
        body.is_free(tree.poses[node], goal))
      best.nodes.emplace_back(node, rest_m);
  }
  [[nodiscard]] double radius_m(std::size_t n) const {
    const double d = config_.space.dimension();
    const double ball = std::pow(std::numbers::pi, d / 2) / std::tgamma(d / 2 + 1);
    const double gamma = 2 * std::pow((1 + 1 / d) * config_.space.volume() / ball, 1 / d);
    const double count = static_cast<double>(n + 1);
    return std::min(config_.step_m, gamma * std::pow(std::log(count) / count, 1 / d));
  }
  Config config_;
};

}  // namespace vantage
