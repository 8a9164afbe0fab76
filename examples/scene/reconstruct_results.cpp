// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "reconstruct_results.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "flight.hpp"
#include "page.hpp"

namespace scene {
namespace {

std::vector<KeyFigure> key_figures(const Options& o, const MissionRecord& record, const Reconstruction& result,
                                   const Referee& referee) {
  const StepRecord& last = record.steps.back();
  double planning_s = 0, mapping_s = 0;
  std::size_t plans = 0;
  for (const StepRecord& r : record.steps) {
    planning_s += r.planning_s, mapping_s += r.mapping_s;
    plans += r.planned ? 1 : 0;
  }
  const auto mean_ms = [](double sum_s, std::size_t n) {
    return short_number(std::round(1000 * sum_s / static_cast<double>(std::max<std::size_t>(n, 1))));
  };
  const std::string by = o.clock == ClockKind::real ? "a view, as this machine takes" : "a view, as published";
  return {{"PSNR", short_number(tenths(result.scores.back().psnr_db)), "dB",
           concat("over ", result.test_views, " views from free space")},
          {"Completeness", short_number(tenths(100 * result.scores.back().completeness)), "%",
           concat("within ", short_number(100 * o.threshold_m), " cm of the mesh")},
          {"Coverage", short_number(tenths(100 * last.metric("coverage"))), "%", "of the surface that can be seen"},
          {"Mission time", short_number(tenths(last.elapsed_s)), "s", "mapping, planning, flight"},
          {"Mapping", mean_ms(mapping_s, static_cast<std::size_t>(last.index)), "ms", by},
          {"Planning", mean_ms(planning_s, plans), "ms", by},
          {"Way", short_number(tenths(last.travelled_m)), "m", concat(plans, " views flown to")},
          {"Surfels", short_number(last.metric("surfels")), "", concat(tenths(last.metric("megabytes")), " MB in all")},
          {"Collisions", short_number(static_cast<double>(referee.collisions())), "", of_the_body(o, record)}};
}

Plot curve(const std::vector<Score>& scores, std::string title, std::string unit, double Score::*value) {
  Plot plot{.title = std::move(title), .x_label = "mission time [s]", .y_label = std::move(unit), .curves = {}};
  Curve& c = plot.curves.emplace_back();
  for (const Score& s : scores) {
    c.x.push_back(s.elapsed_s);
    c.y.push_back(s.*value);
  }
  return plot;
}

}  // namespace

void write_reconstruction(const Options& o, const Input& input, const Referee& referee, const Reconstruction& result,
                          const Album& album, const MissionRecord& record) {
  Page page{o, {.title = "Reconstructing " + input.name}};
  page.clear();
  Report& report = page.report;
  report.lead = concat("A robot that knew nothing of ", input.name, " reconstructed it with surfels, method ", o.method,
                       ": ", record.steps.back().index, " views. It flew only where its voxels were free. ",
                       how_it_ended(o, record), input.note);
  report.figures = key_figures(o, record, result, referee);
  for (std::size_t k = 0; k < result.comparisons.size(); ++k)
    page.add(concat("rendering_", k + 1, ".png"), concat("Test view ", k + 1),
             "Rendered from the surfels; the truth; their confidence (bright is sure); their normals.",
             result.comparisons[k]);
  add_flight(page, input, referee, record);
  page.add_mesh(result.mesh, album);
  page.add_views(album);
  report.plots.push_back(curve(result.scores, "Renderings against the truth", "PSNR [dB]", &Score::psnr_db));
  report.plots.back().from_zero = false;
  report.plots.push_back(curve(result.scores, concat("Surface within ", short_number(100 * o.threshold_m), " cm"),
                               "completeness", &Score::completeness));
  report.plots.back().y_least_top = 1;
  report.plots.push_back(
      metric_plot(record, "Of the surface that can be seen, and of the box", "share", {"coverage", "explored"}));
  report.plots.back().y_least_top = 1;
  report.plots.push_back(metric_plot(record, "Surfels", "number", {"surfels"}));
  page.write(record);
}

}  // namespace scene
