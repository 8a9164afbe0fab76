// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/eval/nearest_points.hpp>
#include <vantage/geometry/mesh_sampling.hpp>
#include <vantage/geometry/triangle_mesh.hpp>

namespace vantage {

/// How good a reconstructed surface is (sections 5.2.1 and 6.2.1). Shares in [0, 1]; NaN where there is nothing to take
/// a mean of.
struct MeshMetrics {
  double accuracy_m = 0;      ///< mean distance from the estimate's points to the true surface
  double completeness_m = 0;  ///< mean distance from the true points to the estimated surface
  double precision = 0;       ///< share of the estimate's points within the threshold of the true surface
  /// Share of the true points within the threshold of the estimate: completeness ratio, recall.
  double completeness = 0;
  double f1 = 0;  ///< harmonic mean of precision and completeness; 0 if one of them is
};

/// How it is measured.
struct MeshComparison {
  double threshold_m = 0.02;        ///< > 0; 0.02 in chapter 6, 0.01 in chapter 5
  std::size_t samples = 1'000'000;  ///< of the estimate, > 0
  /// What a point's distance is taken to. `points`: the nearest sample, as the published figures are; even a perfect
  /// surface then is 0.5 / sqrt(samples per m^2) away in the mean (1 cm for 500 k points on 200 m^2). `surface`: the
  /// triangles of the four nearest samples (and, of the estimate, centroids), which have no such floor; never more than
  /// to the nearest sample, never less than to the mesh.
  enum class To { points, surface } to = To::surface;
};

namespace mesh_metrics_detail {

/// The point of a triangle nearest to p: its projection, if that lies inside, else the nearest point of an edge.
inline Eigen::Vector3d nearest_on_triangle(const std::array<Eigen::Vector3d, 3>& corner, const Eigen::Vector3d& p) {
  const Eigen::Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  bool inside = normal.squaredNorm() > 0;
  Eigen::Vector3d nearest = corner[0];
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = corner[i], edge = corner[(i + 1) % 3] - a;
    inside = inside && normal.dot(edge.cross(p - a)) >= 0;
    const double length2 = edge.squaredNorm();
    const double t = length2 > 0 ? std::clamp(edge.dot(p - a) / length2, 0.0, 1.0) : 0.0;
    const Eigen::Vector3d on_edge = a + t * edge;
    if (const double d2 = (p - on_edge).squaredNorm(); d2 < least) {
      least = d2;
      nearest = on_edge;
    }
  }
  return inside ? Eigen::Vector3d(p - normal * (normal.dot(p - corner[0]) / normal.squaredNorm())) : nearest;
}

struct Distances {
  double sum_m = 0;
  std::size_t within = 0, points = 0;
  Distances& operator+=(const Distances& d) {
    sum_m += d.sum_m;
    within += d.within;
    points += d.points;
    return *this;
  }
  [[nodiscard]] double mean_m() const { return sum_m / static_cast<double>(points); }
  [[nodiscard]] double share() const { return static_cast<double>(within) / static_cast<double>(points); }
};

/// `mesh` gives the triangles of `to`, or is null: then the points themselves are meant.
inline Distances distances(const std::vector<Eigen::Vector3f>& from, const SurfaceSamples& to, const TriangleMesh* mesh,
                           double threshold_m) {
  const NearestPoints nearest(to.points);
  return parallel_sum(from.size(), 1024, Distances{}, [&](std::size_t begin, std::size_t end) {
    Distances d;
    std::array<NearestPoints::Found, 4> found;
    for (std::size_t i = begin; i < end; ++i) {
      double distance_m = 0;
      if (mesh == nullptr) {
        distance_m = static_cast<double>(nearest(from[i]).distance_m);
      } else {
        const Eigen::Vector3d p = from[i].cast<double>();
        const auto near = nearest.nearest(from[i], found);
        distance_m = static_cast<double>(near[0].distance_m);
        for (std::size_t k = 0; k < near.size(); ++k) {
          const std::uint32_t triangle = to.triangles[near[k].index];
          if (k > 0 && triangle == to.triangles[near[k - 1].index]) continue;
          distance_m = std::min(distance_m, (p - nearest_on_triangle(mesh->corners(triangle), p)).norm());
        }
      }
      d.sum_m += distance_m;
      d.within += distance_m < threshold_m;
    }
    d.points = end - begin;
    return d;
  });
}

/// The samples and each triangle's centroid: no triangle without a point.
inline SurfaceSamples with_centroids(SurfaceSamples samples, const TriangleMesh& mesh) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    samples.points.push_back(((a + b + c) / 3).cast<float>());
    samples.triangles.push_back(t);
  }
  return samples;
}

inline void check_samples(const TriangleMesh& mesh, const SurfaceSamples& samples) {
  if (samples.size() == 0) throw Error("mesh_metrics", "no true points", "at least one");
  if (samples.triangles.size() != samples.size())
    throw Error("mesh_metrics", concat(samples.size(), " true points on ", samples.triangles.size(), " triangles"),
                "one triangle a point");
  for (const std::uint32_t t : samples.triangles)
    if (t >= mesh.triangles.size())
      throw Error("mesh_metrics", concat("a true point lies on triangle ", t), concat("below ", mesh.triangles.size()));
}

}  // namespace mesh_metrics_detail

/// Compares a reconstruction with the truth at `true_samples` (from sample_surface; only those of visible_surface, so
/// that what nobody can see does not count). The estimate is sampled by area. An empty estimate, or one
/// without area, has completeness, F1 and precision 0, and no mean distance. The same bits with any number of threads.
/// Throws Error for meshes that are not valid or samples that are none of the true mesh. Dominated by one tree over
/// each side's points, and a query for each of the other's.
inline MeshMetrics mesh_metrics(const TriangleMesh& estimate, const TriangleMesh& truth,
                                const SurfaceSamples& true_samples, const MeshComparison& how, const Rng& rng) {
  using namespace mesh_metrics_detail;
  Check check("MeshComparison");
  check.positive("threshold_m", how.threshold_m);
  check(how.samples > 0, "samples", how.samples, "> 0");
  check.done();
  truth.validate("mesh_metrics");
  estimate.validate("mesh_metrics");
  check_samples(truth, true_samples);
  const auto has_area = [&] {
    for (std::size_t i = 0; i < estimate.triangles.size(); ++i)
      if (estimate.area_normal(i).squaredNorm() > 0) return true;
    return false;
  };
  if (!has_area()) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    return {.accuracy_m = none, .completeness_m = none};
  }
  const SurfaceSamples samples = sample_surface(estimate, how.samples, rng);
  const bool to_surface = how.to == MeshComparison::To::surface;
  Distances to_truth, to_estimate;
  parallel_for(2, [&](std::size_t direction) {  // the trees are built by one thread each
    if (direction == 0)
      to_truth = distances(samples.points, true_samples, to_surface ? &truth : nullptr, how.threshold_m);
    else if (to_surface)
      to_estimate = distances(true_samples.points, with_centroids(samples, estimate), &estimate, how.threshold_m);
    else
      to_estimate = distances(true_samples.points, samples, nullptr, how.threshold_m);
  });
  const double p = to_truth.share(), c = to_estimate.share();
  return {.accuracy_m = to_truth.mean_m(),
          .completeness_m = to_estimate.mean_m(),
          .precision = p,
          .completeness = c,
          .f1 = p + c > 0 ? 2 * p * c / (p + c) : 0};
}

}  // namespace vantage
