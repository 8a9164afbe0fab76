// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "results.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <vantage/mission/canvas.hpp>
#include <vantage/mission/report.hpp>

#include "page.hpp"
#include "truth.hpp"

namespace scene {

std::vector<Metric> Judge::operator()(const FusedMap& map) const {
  MeshMetrics m;
  double coverage = std::numeric_limits<double>::quiet_NaN();
  m.accuracy_m = m.completeness_m = m.precision = m.completeness = m.f1 = coverage;
  if (map.truth()) {
    coverage = map.truth()->share();
    m = against_truth(map.mesh(), input, threshold_m);
  }
  return {{"coverage", coverage},       {"completeness", m.completeness},
          {"precision", m.precision},   {"f1", m.f1},
          {"accuracy_m", m.accuracy_m}, {"megabytes", static_cast<double>(map.volume().bytes()) / 1e6}};
}

namespace {

/// From above: surface that was seen (grey) and that was not (red), the way and the views' directions.
Picture plan(const Input& input, const FusedMap& map, const MissionRecord& record) {
  Box2 area(input.bounds.min().head<2>(), input.bounds.max().head<2>());
  for (const StepRecord& r : record.steps) area.extend(Eigen::Vector2d(r.view.position().head<2>()));
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(0.03 * area.sizes().maxCoeff());
  Canvas canvas(Box2(area.min() - margin, area.max() + margin), 1000);
  canvas.fill([](const Eigen::Vector2d&) { return Rgb{250, 250, 248}; });
  if (map.truth()) draw_seen(canvas, *map.truth(), input.bounds);
  const auto spot = [&](std::size_t k) -> Eigen::Vector2d { return record.steps[k].view.position().head<2>(); };
  for (std::size_t k = 1; k < record.steps.size(); ++k) canvas.line(spot(k - 1), spot(k), 1.6, {0, 114, 178}, 0.7);
  for (std::size_t k = 0; k < record.steps.size(); ++k) {
    const Eigen::Vector2d ahead = record.steps[k].view.forward().head<2>();
    canvas.line(spot(k), spot(k) + 18 / canvas.px_per_m() * ahead, 2.4, {20, 20, 20}, 0.9);
    canvas.dot(spot(k), k == 0 ? 7 : 4, k == 0 ? Rgb{20, 20, 20} : Rgb{0, 114, 178});
  }
  return canvas.picture();
}

std::vector<KeyFigure> key_figures(const Options& o, const MissionRecord& record) {
  const StepRecord& last = record.steps.back();
  const auto percent = [&](const char* metric) { return short_number(tenths(100 * last.metric(metric))); };
  std::vector<KeyFigure> f;
  if (!std::isnan(last.metric("coverage"))) {
    const std::string near = concat("within ", short_number(100 * o.threshold_m), " cm");
    f = {{"Coverage", percent("coverage"), "%", "of the surface that can be seen"},
         {"Completeness", percent("completeness"), "%", near + " of the mesh"},
         {"Precision", percent("precision"), "%", "of the mesh " + near},
         {"Accuracy", short_number(tenths(1000 * last.metric("accuracy_m"))), "mm", "mean distance of the mesh"}};
  }
  f.push_back({"Views", short_number(static_cast<double>(last.index)), "",
               short_number(tenths(last.travelled_m)) + " m between them"});
  f.push_back({"Mission time", short_number(tenths(last.elapsed_s)), "s", "planning, mapping, travel"});
  f.push_back({"Reconstruction", short_number(tenths(last.metric("megabytes"))), "MB",
               concat("voxels of ", short_number(100 * o.voxel_m), " cm")});
  return f;
}

}  // namespace

void write_results(const Options& o, const Input& input, const FusedMap& map, const Album& album,
                   const MissionRecord& record) {
  const TriangleMesh mesh = map.mesh();
  Page page{o, {.title = "A look around: " + input.name}};
  page.clear();
  Report& report = page.report;
  report.lead =
      concat("A camera", input.recording ? "'s recording" : "", " of ", input.name, ": ", record.steps.back().index,
             " views, method ", o.method, ", fused into a mesh of ", mesh.triangles.size(), " triangles. ", input.note,
             input.recording ? "" : " The way between two views is counted as a straight line.");
  report.figures = key_figures(o, record);
  page.add("plan.png", "From above",
           map.truth()
               ? "Grey surface was seen, red was not; a dot is a view, its tick the way it looks, black the start."
               : "A dot is a view, its tick the way it looks, black the first.",
           plan(input, map, record));
  page.add_mesh(mesh, album);
  page.add_views(album);
  if (map.truth()) {
    report.plots.push_back(
        metric_plot(record, "Of the surface that can be seen", "share", {"coverage", "completeness", "precision"}));
    report.plots.back().y_least_top = 1;
    report.plots.push_back(metric_plot(record, "Mean distance of the mesh", "m", {"accuracy_m"}));
  }
  page.write(record);
}

}  // namespace scene
