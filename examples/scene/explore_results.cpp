// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "explore_results.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <vantage/eval/mesh_metrics.hpp>
#include <vantage/io/file.hpp>
#include <vantage/mission/canvas.hpp>

#include "page.hpp"

namespace scene {
namespace {

constexpr Rgb ink = {20, 20, 20}, blue = {0, 114, 178}, red = {214, 69, 61};

/// The map from above after a step, with the way flown until then and the views taken.
Picture from_above(const Referee::Growth& growth, const Referee& referee, const MissionRecord& record, int longer_px) {
  Canvas canvas(referee.growth().back().plan.known(), longer_px);
  growth.plan.fill(canvas);
  const double scale = longer_px / 1000.0;
  std::size_t flown = 0;
  for (const StepRecord& r : record.steps) {
    if (r.index > growth.step || !r.planned) continue;
    const std::vector<View>& path = referee.paths()[flown++];
    for (std::size_t k = 1; k < path.size(); ++k)
      canvas.line(path[k - 1].position().head<2>(), path[k].position().head<2>(), 3 * scale, blue, 0.8);
  }
  for (const StepRecord& r : record.steps) {
    if (r.index > growth.step) continue;
    const Eigen::Vector2d spot = r.view.position().head<2>(), ahead = r.view.forward().head<2>();
    canvas.line(spot, spot + 20 * scale / canvas.px_per_m() * ahead, 2.4 * scale, ink, 0.9);
    canvas.dot(spot, (r.planned ? 4.5 : 8) * scale, r.planned ? blue : ink);
  }
  return canvas.picture();
}

/// Four moments of the mission side by side.
Picture growth_strip(const Referee& referee, const MissionRecord& record) {
  const std::vector<Referee::Growth>& growth = referee.growth();
  constexpr int gap = 12;
  std::vector<Picture> parts;
  for (std::size_t k = 1; k <= 4; ++k)
    parts.push_back(from_above(growth[(growth.size() - 1) * k / 4], referee, record, 480));
  Picture all(4 * parts[0].width() + 3 * gap, parts[0].height());
  for (int y = 0; y < all.height(); ++y)
    for (int x = 0; x < all.width(); ++x) all(y, x) = {255, 255, 255};
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (int y = 0; y < parts[k].height(); ++y)
      for (int x = 0; x < parts[k].width(); ++x)
        all(y, x + static_cast<int>(k) * (parts[k].width() + gap)) = parts[k](y, x);
  return all;
}

/// Surface that was seen (grey) and that was not (red), from above.
Picture seen_surface(const Input& input, const Referee& referee) {
  const SurfaceCoverage& truth = *referee.fused().truth();
  Canvas canvas(Box2(input.bounds.min().head<2>(), input.bounds.max().head<2>()), 1000);
  canvas.fill([](const Eigen::Vector2d&) { return Rgb{250, 250, 248}; });
  const double ceiling_m = input.bounds.max().z() - 0.3, floor_m = input.bounds.min().z() + 0.1;
  for (const bool seen : {true, false})
    for (std::size_t i = 0; i < truth.surface().size(); ++i) {
      const Eigen::Vector3d p = truth.surface().points[i].cast<double>();
      if ((truth.seen()[i] != 0) != seen || p.z() > ceiling_m || p.z() < floor_m) continue;
      canvas.dot(p.head<2>(), 1.1, seen ? Rgb{120, 128, 136} : red, seen ? 0.25 : 0.7);
    }
  return canvas.picture();
}

/// The way as the robot flew it: a row a waypoint.
std::string path_csv(const Referee& referee) {
  std::string csv = "leg,x_m,y_m,z_m,yaw_rad\n";
  for (std::size_t leg = 0; leg < referee.paths().size(); ++leg)
    for (const View& v : referee.paths()[leg]) {
      const Eigen::Vector3d p = v.position(), f = v.forward();
      csv += concat(leg + 1, ',', p.x(), ',', p.y(), ',', p.z(), ',', std::atan2(f.y(), f.x()), '\n');
    }
  return csv;
}

double least_clearance_m(const MissionRecord& record) {
  double least = std::numeric_limits<double>::infinity();
  for (const StepRecord& r : record.steps)
    if (const double c = r.metric("clearance_m"); c < least) least = c;
  return least;
}

std::vector<KeyFigure> key_figures(const Options& o, const MissionRecord& record, const MeshMetrics& mesh,
                                   const Referee& referee) {
  const StepRecord& last = record.steps.back();
  const auto percent = [](double share) { return short_number(tenths(100 * share)); };
  double planning_s = 0;
  std::size_t plans = 0;
  for (const StepRecord& r : record.steps)
    if (r.planned) planning_s += r.planning_s, ++plans;
  return {{"Coverage", percent(last.metric("coverage")), "%", "of the surface that can be seen"},
          {"Completeness", percent(mesh.completeness), "%",
           concat("within ", short_number(100 * o.threshold_m), " cm of the mesh")},
          {"Mission time", short_number(tenths(last.elapsed_s)), "s", "planning, mapping, flight"},
          {"Way", short_number(tenths(last.travelled_m)), "m", concat(plans, " views flown to")},
          {"Planning", short_number(tenths(1000 * planning_s / static_cast<double>(std::max<std::size_t>(plans, 1)))),
           "ms", "a view, on average"},
          {"Collisions", short_number(static_cast<double>(referee.collisions())), "",
           concat("a ball of ", short_number(100 * o.body_radius_m), " cm; the nearest surface was ",
                  short_number(std::round(100 * least_clearance_m(record))), " cm from it")},
          {"Map", short_number(tenths(last.metric("megabytes"))), "MB",
           concat("voxels of ", short_number(100 * o.map_voxel_m), " cm")}};
}

}  // namespace

void write_exploration(const Options& o, const Input& input, const Referee& referee, const Album& album,
                       const MissionRecord& record) {
  const TriangleMesh mesh = referee.fused().mesh();
  const MeshMetrics judged =
      mesh_metrics(mesh, input.scene->mesh, input.surface, {.threshold_m = o.threshold_m, .samples = 200'000}, Rng(1));
  Page page{o, {.title = "Exploring " + input.name}};
  Report& report = page.report;
  report.lead = concat("A robot that knew nothing of ", input.name, " explored it, method ", o.method, ": ",
                       record.steps.back().index, " views, fused into a mesh of ", mesh.triangles.size(),
                       " triangles. It flew only where its map of voxels was free. ", input.note);
  report.figures = key_figures(o, record, judged, referee);
  page.add("map.png", "The map from above",
           "White is free, dark occupied, grey unknown; the way in blue, a dot for each view and the way it looks, "
           "black where it started.",
           from_above(referee.growth().back(), referee, record, 1000));
  page.add("growth.png", "How the map grew", "After a quarter, half, three quarters and all of the views.",
           growth_strip(referee, record));
  page.add("coverage.png", "Surface seen", "Grey surface was seen, red was not, though it can be.",
           seen_surface(input, referee));
  page.add_mesh(mesh, album);
  page.add_views(album);
  report.plots.push_back(
      metric_plot(record, "Of the surface that can be seen, and of the box", "share", {"coverage", "explored"}));
  report.plots.back().y_least_top = 1;
  report.plots.push_back(metric_plot(record, "Nearest surface on the way to a view", "m", {"clearance_m"}));
  write_file(o.out / "path.csv", path_csv(referee));
  page.write(record);
}

}  // namespace scene
