// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/convex_hull.hpp>
#include <vantage/geometry/triangle_mesh.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/planning/rigid_motion.hpp>
#include <vantage/planning/robot_shape.hpp>

// The only file that knows FCL (0.7). Debian builds it for any x86-64, where Eigen aligns less than in a program made
// for this machine; so nothing of FCL is used whose layout that changes: geometry and transforms by reference, yes, its
// objects, continuous requests and traversal nodes, no.
namespace vantage {

/// Why a body is in collision, or that it is not.
enum class CollisionVerdict : std::uint8_t {
  free,
  contact,     ///< touches, overlaps, or cannot be told from that at the checker's resolution
  bad_pose,    ///< a pose that is not finite, no rigid transform, or farther than 1e6 m from the origin
  failed,      ///< FCL threw, or gave what cannot be
  unresolved,  ///< more queries needed than allowed
};

inline std::string_view to_string(CollisionVerdict verdict) {
  constexpr std::array<std::string_view, 5> names = {"free", "contact", "bad pose", "failed", "unresolved"};
  return names[static_cast<std::size_t>(verdict)];
}

/// What was found about a pose or a motion.
struct CollisionCheck {
  CollisionVerdict verdict = CollisionVerdict::free;
  double clearance_m = 0;  ///< to the scene; 0 unless free
  double at = 0;           ///< of a motion: where in [0, 1] it is in collision, or closest to the scene
  [[nodiscard]] bool free() const { return verdict == CollisionVerdict::free; }
};

/// What was found about a path.
struct PathCheck : CollisionCheck {
  std::size_t segment =
      0;  ///< the first in collision, or the one closest to the scene: from pose `segment` to the next
};

namespace detail {

using Bvh = fcl::BVHModel<fcl::OBBRSSd>;
static_assert(alignof(Bvh) <= 16 && alignof(fcl::BVNode<fcl::OBBRSSd>) <= 16 && alignof(fcl::Convexd) <= 16 &&
                  alignof(fcl::DistanceRequestd) <= 16 && alignof(fcl::DistanceResultd) <= 16 &&
                  alignof(fcl::CollisionRequestd) <= 16 && alignof(fcl::CollisionResultd) <= 16 &&
                  alignof(fcl::Contactd) <= 16,
              "the layout of these types must not depend on the machine that a program is built for");

/// Distances that rounding cannot tell from contact [m].
inline constexpr double touching_m = 1e-8;

/// A point that double precision still resolves to a nanometre.
inline bool within_reach(const Eigen::Vector3d& p) { return (p.array().abs() <= 1e6).all(); }

/// FCL's hierarchy over triangles. One without area (lower than a micrometre) would be dropped or divide by zero in it:
/// it becomes one that is a micrometre wide, so that what is there stays there.
template <class Vertices, class Triangles>
std::shared_ptr<const Bvh> make_bvh(const Vertices& vertices, const Triangles& triangles, double width_m = 1e-6) {
  std::vector<Eigen::Vector3d> points;
  std::vector<fcl::Triangle> corners;
  points.reserve(vertices.size());
  corners.reserve(triangles.size());
  for (const auto& v : vertices) points.push_back(v.template cast<double>());
  for (auto t : triangles) {
    // The longest edge first, so that the third corner is the one to move.
    const auto length = [&](std::size_t k) { return (points[t[(k + 1) % 3]] - points[t[k]]).norm(); };
    const std::size_t longest =
        length(0) >= length(1) ? (length(0) >= length(2) ? 0 : 2) : (length(1) >= length(2) ? 1 : 2);
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(longest), t.end());
    const Eigen::Vector3d a = points[t[0]], c = points[t[2]];
    Eigen::Vector3d b = points[t[1]];
    if ((b - a).cross(c - a).norm() < width_m * std::max((b - a).norm(), width_m)) {
      if ((b - a).norm() < width_m) {  // no longer than wide
        b = a + width_m * Eigen::Vector3d::UnitX();
        t[1] = static_cast<std::uint32_t>(points.size());
        points.push_back(b);
      }
      t[2] = static_cast<std::uint32_t>(points.size());
      points.push_back(c + width_m * (b - a).unitOrthogonal());
    }
    corners.emplace_back(t[0], t[1], t[2]);
  }
  const auto bvh = std::make_shared<Bvh>();
  if (bvh->beginModel(static_cast<int>(corners.size()), static_cast<int>(points.size())) != fcl::BVH_OK ||
      bvh->addSubModel(points, corners) != fcl::BVH_OK || bvh->endModel() != fcl::BVH_OK)
    throw Error("CollisionScene", "FCL cannot build its hierarchy", "memory for the triangles");
  return bvh;
}

inline void check_collision_mesh(const TriangleMesh& mesh, std::string_view where) {
  mesh.validate(where);
  if (mesh.empty()) throw Error(where, "the mesh has no triangle", "at least one");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      if (!within_reach(mesh.vertices[v].cast<double>()))
        throw Error(where, concat("vertex ", v, " is (", mesh.vertices[v].transpose(), ")"), "coordinates up to 1e6 m");
}

/// f(), which asks FCL; failed if that throws, as FCL's own logic errors and libccd's failures do.
template <class F>
CollisionCheck guarded(F&& f) {
  try {
    return f();
  } catch (const std::exception&) { return {CollisionVerdict::failed}; }
}

/// A shape as FCL has it.
struct RobotBody {
  std::shared_ptr<const Bvh> surface;         ///< what distances are measured to
  double around_m = 0;                        ///< how far the body reaches beyond that
  std::shared_ptr<const fcl::Convexd> solid;  ///< what may hold a thing without touching it; or none
  double reach_m = 0;                         ///< of its farthest point from the frame's origin

  explicit RobotBody(const RobotShape& shape) {
    std::visit([&](const auto& s) { make(s); }, shape);
  }

 private:
  static constexpr std::string_view where = "CollisionChecker";

  void make(const shape::Sphere& sphere) {
    Check check(where);
    check(sphere.radius_m >= 0 && sphere.radius_m <= 1e6, "radius_m", sphere.radius_m, "0 to 1e6");
    check.done();
    // A speck, and what is around it: of FCL's own sphere that is in contact, the distance is never written.
    surface = make_bvh(std::vector<Eigen::Vector3d>(1, Eigen::Vector3d::Zero()),
                       std::vector<std::array<std::uint32_t, 3>>(1), 1e-9);
    reach_m = around_m = sphere.radius_m;
  }
  void make(const shape::Box& box) {
    const Eigen::Vector3d& half = box.half_extents_m;
    if (!(half.array() >= 0).all() || !within_reach(half))
      throw Error(where, concat("a box of half extents (", half.transpose(), ")"), "each 0 to 1e6 m");
    shape::Convex corners;
    // A side without extent gets some, as a triangle without area does.
    for (int k = 0; k < 8; ++k)
      corners.points.push_back(
          half.cwiseMax(0.5e-6).cwiseProduct(Eigen::Vector3d(k & 1 ? 1 : -1, k & 2 ? 1 : -1, k & 4 ? 1 : -1)));
    static constexpr std::array<std::array<std::uint32_t, 3>, 12> faces = {{{0, 2, 1},
                                                                            {1, 2, 3},
                                                                            {4, 5, 6},
                                                                            {5, 7, 6},
                                                                            {0, 1, 4},
                                                                            {1, 5, 4},
                                                                            {2, 6, 3},
                                                                            {3, 6, 7},
                                                                            {0, 4, 2},
                                                                            {2, 4, 6},
                                                                            {1, 3, 5},
                                                                            {3, 7, 5}}};
    make(ConvexHull{corners.points, {faces.begin(), faces.end()}});
  }
  void make(const shape::Convex& convex) {
    for (const Eigen::Vector3d& p : convex.points)
      if (!within_reach(p)) throw Error(where, concat("a corner at (", p.transpose(), ")"), "up to 1e6 m");
    make(convex_hull(convex.points));
  }
  void make(const shape::Mesh& mesh) {
    check_collision_mesh(mesh.mesh, where);
    make_surface(mesh.mesh.vertices, mesh.mesh.triangles);
  }
  void make(const ConvexHull& hull) {
    make_surface(hull.vertices, hull.triangles);
    const auto faces = std::make_shared<std::vector<int>>();
    for (const auto& [a, b, c] : hull.triangles)
      faces->insert(faces->end(), {3, static_cast<int>(a), static_cast<int>(b), static_cast<int>(c)});
    const auto convex =
        std::make_shared<fcl::Convexd>(std::make_shared<const std::vector<Eigen::Vector3d>>(hull.vertices),
                                       static_cast<int>(hull.triangles.size()), faces);
    convex->computeLocalAABB();
    solid = convex;
  }
  template <class Vertices, class Triangles>
  void make_surface(const Vertices& vertices, const Triangles& triangles) {
    surface = make_bvh(vertices, triangles);
    for (const auto& t : triangles)
      for (const std::uint32_t v : t) reach_m = std::max(reach_m, vertices[v].template cast<double>().norm() + 2e-6);
  }
};

}  // namespace detail

/// A scene's triangles as obstacles: FCL's hierarchy of oriented boxes and swept spheres. Does not change, so that
/// copies share it, among threads as well. About 800 bytes a triangle.
class CollisionScene {
 public:
  /// Throws Error for a mesh without triangles, with a vertex that is not finite or farther than 1e6 m from the origin,
  /// and with an index out of range. A triangle without area counts as one that is a micrometre wide. O(n log n).
  explicit CollisionScene(const TriangleMesh& mesh) {
    detail::check_collision_mesh(mesh, "CollisionScene");
    bvh_ = detail::make_bvh(mesh.vertices, mesh.triangles);
  }

 private:
  friend class CollisionChecker;
  std::shared_ptr<const detail::Bvh> bvh_;
};

struct CollisionConfig {
  /// How close a motion may come to the scene and be called free for certain; half of it may be called contact [m].
  double resolution_m = 1e-3;
  /// Of a motion's clearance, relative; where that is below the resolution, only its sign is sure.
  double clearance_error = 0.1;
  /// Distances measured for a motion at most. A motion that needs more is unresolved.
  int most_queries = 100'000;

  void validate() const {
    Check check("CollisionConfig");
    check.positive("resolution_m", resolution_m);
    check(clearance_error > 0 && clearance_error < 1, "clearance_error", clearance_error, "in (0, 1)");
    check(most_queries >= 2, "most_queries", most_queries, "at least 2");
    check.done();
  }
};

/// Whether a robot's body meets a scene: at a pose, on the way from one pose to another, on a path. Whatever goes wrong
/// is in collision, and the verdict says why: no check throws, and none calls free what it could not prove free.
///
/// Distances between surfaces come from FCL in closed form (no iteration; PQP's triangles, Larsen et al. 1999;
/// spheres): to 1e-8 of the triangles' size, to 0.1 mm for triangles below 0.02 mm^2. That nothing of the scene is
/// inside of a box or convex body takes one more query (FCL's GJK on libccd). The scene is a surface: a body entirely
/// inside of a closed one is free, but no motion leads there. Const members run concurrently: geometry alone is shared,
/// nothing is cached.
class CollisionChecker {
 public:
  using Config = CollisionConfig;

  /// Throws Error for a shape that is not finite or larger than 1e6 m, for points in a plane, and for a mesh that a
  /// CollisionScene would refuse.
  CollisionChecker(CollisionScene scene, const RobotShape& shape, const Config& config = {})
      : scene_(std::move(scene)), body_(shape), config_(config) {
    config_.validate();
  }

  /// The body at a pose (robot to world); exact.
  [[nodiscard]] CollisionCheck check(const Eigen::Isometry3d& T_W_R) const {
    if (!is_pose(T_W_R)) return {CollisionVerdict::bad_pose};
    const CollisionCheck solid = inside(T_W_R);
    return solid.free() ? distance(T_W_R) : solid;
  }
  [[nodiscard]] CollisionCheck check(const View& view) const { return check(view.T_W_C); }

  /// The body on a RigidMotion, all of it and not at samples: where the measured distances and the longest way of any
  /// of the body's points leave a part of the motion in doubt, it is halved. So free is proven, with the clearance as a
  /// lower bound that is less than Config::clearance_error below the true one; contact may also be a distance below
  /// half of the resolution. A few queries in the open, up to way / resolution along a surface.
  [[nodiscard]] CollisionCheck check(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const;
  [[nodiscard]] CollisionCheck check(const View& from, const View& to) const { return check(from.T_W_C, to.T_W_C); }

  // CollisionFree: for RrtStar.
  [[nodiscard]] bool is_free(const Eigen::Isometry3d& T_W_R) const { return check(T_W_R).free(); }
  [[nodiscard]] bool is_free(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const {
    return check(from, to).free();
  }

  /// All motions of a path, one after the other, concurrently. A path of one pose is this pose; of none, free with an
  /// infinite clearance.
  [[nodiscard]] PathCheck check(Views path) const;

 private:
  static bool is_pose(const Eigen::Isometry3d& T) { return is_rigid(T) && detail::within_reach(T.translation()); }
  /// Whether something of the scene is in the solid body.
  [[nodiscard]] CollisionCheck inside(const Eigen::Isometry3d& T_W_R) const {
    if (!body_.solid) return {};
    return detail::guarded([&]() -> CollisionCheck {
      const fcl::CollisionRequestd request;
      fcl::CollisionResultd result;
      fcl::collide(scene_.bvh_.get(), Eigen::Isometry3d::Identity(), body_.solid.get(), T_W_R, request, result);
      return {result.isCollision() ? CollisionVerdict::contact : CollisionVerdict::free};
    });
  }
  /// From the scene to the body's surface.
  [[nodiscard]] CollisionCheck distance(const Eigen::Isometry3d& T_W_R) const {
    return detail::guarded([&]() -> CollisionCheck {
      const fcl::DistanceRequestd request;
      fcl::DistanceResultd result;
      fcl::distance(scene_.bvh_.get(), Eigen::Isometry3d::Identity(), body_.surface.get(), T_W_R, request, result);
      const double d = result.min_distance - body_.around_m;
      if (d <= detail::touching_m) return {CollisionVerdict::contact};
      if (!(d < 1e9)) return {CollisionVerdict::failed};
      return {CollisionVerdict::free, d};
    });
  }

  CollisionScene scene_;
  detail::RobotBody body_;
  Config config_;
};

inline CollisionCheck CollisionChecker::check(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to) const {
  if (!is_pose(from) || !is_pose(to)) return {CollisionVerdict::bad_pose};
  // What is not inside of the body at the start gets there only through its surface.
  if (const CollisionCheck start = inside(from); !start.free()) return start;
  const RigidMotion motion(from, to);
  const double way_m = motion.way_m(body_.reach_m);
  int queries = 0;
  const auto measure = [&](double t) {
    ++queries;
    CollisionCheck c = distance(motion.at(t));
    c.at = t;
    return c;
  };

  struct Part {
    CollisionCheck begin, end;
  };
  const CollisionCheck begin = measure(0), end = measure(1);
  if (!begin.free()) return begin;
  std::vector<Part> parts = {{begin, end}};  // a stack, the earliest on top
  CollisionCheck closest = begin;
  double proven_m = std::numeric_limits<double>::infinity();
  while (!parts.empty()) {
    const auto [a, b] = parts.back();
    parts.pop_back();
    for (const CollisionCheck& c : {a, b}) {
      if (!c.free()) return c;
      if (c.clearance_m < closest.clearance_m) closest = c;
    }
    const double part_m = (b.at - a.at) * way_m;
    // No point of the body is faster than the bound: distances that say otherwise are wrong.
    if (std::abs(b.clearance_m - a.clearance_m) > part_m + config_.resolution_m)
      return {CollisionVerdict::failed, 0, a.at};
    const double bound_m = 0.5 * (a.clearance_m + b.clearance_m - part_m);
    if (bound_m > detail::touching_m &&
        (bound_m >= (1 - config_.clearance_error) * closest.clearance_m || part_m <= config_.resolution_m)) {
      proven_m = std::min(proven_m, bound_m);
      continue;
    }
    if (part_m <= config_.resolution_m) return {CollisionVerdict::contact, 0, a.at};
    if (queries >= config_.most_queries) return {CollisionVerdict::unresolved, 0, a.at};
    const CollisionCheck middle = measure(0.5 * (a.at + b.at));
    parts.push_back({middle, b});
    parts.push_back({a, middle});
  }
  return {CollisionVerdict::free, proven_m, closest.at};
}

inline PathCheck CollisionChecker::check(Views path) const {
  if (path.empty()) return {{CollisionVerdict::free, std::numeric_limits<double>::infinity()}};
  if (path.size() == 1) return {check(path[0])};
  std::vector<CollisionCheck> checks(path.size() - 1);
  parallel_for(checks.size(), [&](std::size_t i) { checks[i] = check(path[i], path[i + 1]); });
  std::size_t worst = 0;
  for (std::size_t i = 0; i < checks.size() && checks[worst].free(); ++i)
    if (!checks[i].free() || checks[i].clearance_m < checks[worst].clearance_m) worst = i;
  return {checks[worst], worst};
}

}  // namespace vantage
