// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "explore_results.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include <vantage/eval/mesh_metrics.hpp>

#include "flight.hpp"
#include "page.hpp"
#include "truth.hpp"

namespace scene {
namespace {

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
           "ms", o.clock == ClockKind::real ? "a view, as this machine takes" : "a view, by the modelled clock"},
          {"Collisions", short_number(static_cast<double>(referee.collisions())), "", of_the_body(o, record)},
          {"Map", short_number(tenths(last.metric("megabytes"))), "MB",
           concat("voxels of ", short_number(100 * o.map_voxel()), " cm")}};
}

}  // namespace

void write_exploration(const Options& o, const Input& input, const Referee& referee, const Album& album,
                       const MissionRecord& record) {
  const TriangleMesh mesh = referee.fused().mesh();
  const MeshMetrics judged = against_truth(mesh, input, o.threshold_m);
  Page page{o, {.title = "Exploring " + input.name}};
  page.clear();
  Report& report = page.report;
  report.lead =
      concat("A robot that knew nothing of ", input.name, " explored it, method ", o.method, ": ",
             record.steps.back().index, " views, fused into a mesh of ", mesh.triangles.size(),
             " triangles. It flew only where its map of voxels was free. ", how_it_ended(o, record), input.note);
  report.figures = key_figures(o, record, judged, referee);
  add_flight(page, input, referee, record);
  page.add_mesh(mesh, album);
  page.add_views(album);
  report.plots.push_back(
      metric_plot(record, "Of the surface that can be seen, and of the box", "share", {"coverage", "explored"}));
  report.plots.back().y_least_top = 1;
  report.plots.push_back(metric_plot(record, "Nearest surface on the way to a view", "m", {"clearance_m"}));
  page.write(record);
}

}  // namespace scene
