// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <tbb/task_arena.h>

#include <vantage/core/units.hpp>
#include <vantage/eval/image_metrics.hpp>
#include <vantage/eval/mesh_metrics.hpp>
#include <vantage/eval/surface_coverage.hpp>
#include <vantage/geometry/marching_cubes.hpp>
#include <vantage/geometry/tsdf.hpp>

#include "analytic_scene.hpp"
#include "mesh_topology.hpp"

// From frames to metrics, for ThreadSanitizer to watch; and that the results are those of one thread.
namespace {

using namespace vantage;

struct Result {
  TriangleMesh mesh;
  std::array<double, 7> metrics;
};

Result reconstruct(int threads) {
  tbb::task_arena arena(threads);
  return arena.execute([] {
    const Box3 bounds(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1));
    const test::Sphere ball{{0, 0, 0}, 0.6};
    const TriangleMesh truth = test::sphere_mesh(ball.centre, ball.radius_m, 30);
    const SurfaceSamples all = sample_surface(truth, 4000, Rng(1));
    const std::vector<Eigen::Vector3d> eyes{{2, 0, 0}, {0, 2, 0}, {-1, -1, 1}};
    const SurfaceSamples points =
        all.where(visible_surface(all, eyes, {.far_m = 3}, [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
          return test::Sphere{ball.centre, 0.58}(from, Eigen::Vector3d(to - from)) > 1;
        }));
    SurfaceCoverage coverage(points);
    Tsdf tsdf({.bounds = bounds});
    std::vector<Frame> frames;
    for (const Eigen::Vector3d& eye : eyes) {
      frames.push_back(test::observe(ball, look_at(eye, ball.centre), Camera::from_fov(64, 64, deg(50)), bounds));
      tsdf.integrate(frames.back());
      coverage.add(frames.back());
    }
    Result r{.mesh = marching_cubes(tsdf), .metrics = {}};
    const MeshMetrics m = mesh_metrics(r.mesh, truth, points, {.samples = 4000}, Rng(2));
    r.metrics = {m.accuracy_m,
                 m.completeness_m,
                 m.precision,
                 m.completeness,
                 coverage.coverage(),
                 ssim(frames[0].colour, frames[1].colour),
                 psnr(frames[0].colour, frames[2].colour)};
    return r;
  });
}

TEST(Parallel, SurfacesAndTheirMetrics) {
  const Result one = reconstruct(1);
  EXPECT_GT(one.metrics[3], 0.9);
  EXPECT_GT(one.metrics[4], 0.9);
  for (const int threads : {2, 8}) {
    const Result many = reconstruct(threads);
    EXPECT_EQ(many.mesh.vertices, one.mesh.vertices);
    EXPECT_EQ(many.mesh.colours, one.mesh.colours);
    EXPECT_EQ(many.mesh.triangles, one.mesh.triangles);
    EXPECT_EQ(many.metrics, one.metrics);
  }
}

}  // namespace
