// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Fig. 3.6 of the thesis: the same planner on four maps; which one finds the hotspots first?
#include <tbb/info.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <vantage/mission/plot.hpp>

#include "field_methods.hpp"
#include "field_options.hpp"
#include "planning_claims.hpp"
#include "planning_mission.hpp"
#include "published_clock.hpp"
#include "statistics.hpp"
#include "table.hpp"
#include "units.hpp"

namespace study {

constexpr double step_of_grid_s = 5;

struct PlanningOptions : FieldStudyOptions {
  std::vector<std::string> clocks = {"measured", "published"};
  std::optional<double> budget;
  [[nodiscard]] double budget_s() const { return budget.value_or(quick ? 100 : 300); }
  [[nodiscard]] std::uint64_t field_count() const { return fields.value_or(quick ? 2 : 10); }
};

std::vector<Unit> plan_units(const PlanningOptions& o) {
  std::vector<Unit> units;
  const int threads = o.threads == 0 ? tbb::info::default_concurrency() : o.threads;
  for (const std::string& clock : o.clocks)
    for (const std::string& reading : o.readings)
      for (const std::string& method : o.methods) {
        if (clock == "published" && method == "ours_latent") continue;  // nobody published it
        for (std::uint64_t field = 0; field < o.field_count(); ++field)
          units.push_back({concat("planning_", clock, "_", reading, "_", method, "_", o.budget_s(), "s_", field),
                           {{"study", "field_planning"},
                            {"clock", clock},
                            {"noise", reading},
                            {"method", method},
                            {"budget_s", o.budget_s()},
                            {"field", field},
                            {"seed", o.seed},
                            {"threads", threads}}});
      }
  return units;
}

std::vector<double> numbers(const Json& list) {
  std::vector<double> values;
  for (const Json& x : list) values.push_back(number(x));
  return values;
}

double sum(const std::vector<double>& values) {
  double s = 0;
  for (const double v : values) s += v;
  return s;
}

/// All missions of one method in one setting.
struct Missions {
  std::string clock, reading, method;
  std::vector<std::uint64_t> field;
  std::vector<std::vector<double>> rmse_hotspots, iou;  ///< per field, on the time grid
  std::map<std::string, std::vector<double>> figures;   ///< per field: see figure_names
};

const std::vector<std::string> figure_names = {
    "rmse_hotspots_end", "rmse_hotspots_average", "iou_end",   "iou_average", "measurements", "planning_s", "mapping_s",
    "flight_s",          "longest_planning_s",    "cells_end", "wasted_share"};

std::vector<Missions> collect(const PlanningOptions& o, const Units& store, const std::vector<double>& grid) {
  std::vector<Missions> all;
  for (const Unit& u : plan_units(o)) {
    const auto result = store.result(u);
    if (!result) continue;
    const Json& p = u.parameters;
    if (all.empty() || all.back().clock != p["clock"] || all.back().reading != p["noise"] ||
        all.back().method != p["method"])
      all.push_back({p["clock"], p["noise"], p["method"], {}, {}, {}, {}});
    Missions& m = all.back();
    const std::vector<double> time = numbers((*result)["elapsed_s"]);
    m.field.push_back(p["field"]);
    m.rmse_hotspots.push_back(held(time, numbers((*result)["rmse_hotspots"]), grid));
    m.iou.push_back(held(time, numbers((*result)["iou"]), grid));
    const std::vector<double> planning = numbers((*result)["planning_s"]), height = numbers((*result)["height_m"]),
                              hot = numbers((*result)["sees_hotspot"]);
    double low = 0, wasted = 0;
    for (std::size_t i = 0; i < height.size(); ++i)
      if (height[i] < 3) {
        low += 1;
        wasted += hot[i] == 0;
      }
    const std::map<std::string, double> figures = {
        {"rmse_hotspots_end", m.rmse_hotspots.back().back()},
        {"rmse_hotspots_average", Summary::of(m.rmse_hotspots.back()).mean},
        {"iou_end", m.iou.back().back()},
        {"iou_average", Summary::of(m.iou.back()).mean},
        {"measurements", static_cast<double>(planning.size())},
        {"planning_s", sum(planning)},
        {"mapping_s", sum(numbers((*result)["mapping_s"]))},
        {"flight_s", sum(numbers((*result)["flight_s"]))},
        {"longest_planning_s", planning.empty() ? nan : *std::max_element(planning.begin(), planning.end())},
        {"cells_end", number((*result)["cells"].back())},
        {"wasted_share", low > 0 ? wasted / low : nan}};
    for (const auto& [name, value] : figures) m.figures[name].push_back(value);
  }
  return all;
}

Json make_rows(const std::vector<Missions>& all) {
  Json rows = Json::array();
  for (const Missions& m : all) {
    Json row = {{"method", m.method}, {"label", method_info(m.method).label},
                {"clock", m.clock},   {"noise", m.reading},
                {"size", map_size},   {"fields", m.field.size()}};
    for (const std::string& name : figure_names) {
      const Summary s = Summary::of(m.figures.at(name));
      row[name] = number(s.mean);
      row[name + "_deviation"] = number(s.deviation);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Mean and deviation over the fields at one time of the grid.
Summary at_time(const std::vector<std::vector<double>>& per_field, std::size_t i) {
  std::vector<double> values;
  for (const std::vector<double>& v : per_field) values.push_back(v[i]);
  return Summary::of(values);
}

std::vector<Claim> make_claims(const PlanningOptions& o, const std::vector<Missions>& all,
                               const std::vector<double>& grid) {
  std::vector<Claim> claims;
  for (const std::string& clock : o.clocks)
    for (const std::string& reading : o.readings) {
      const auto missions = [&](std::string_view method) -> const Missions* {
        for (const Missions& m : all)
          if (m.clock == clock && m.reading == reading && m.method == method) return &m;
        return nullptr;
      };
      const PerField figure = [&](std::string_view method, std::string_view name) {
        const Missions* m = missions(method);
        return m ? m->figures.at(std::string(name)) : std::vector<double>{};
      };
      const OverTime curve = [&](std::string_view method, std::string_view metric) {
        std::vector<double> values;
        if (const Missions* m = missions(method))
          for (std::size_t i = 0; i < grid.size(); ++i)
            values.push_back(at_time(metric == "iou" ? m->iou : m->rmse_hotspots, i).mean);
        return values;
      };
      for (Claim& c : test_planning_claims(figure, curve, grid)) {
        c.scope = clock + " clock, noise: " + reading;
        claims.push_back(std::move(c));
      }
    }
  return claims;
}

Json curves_table(const std::vector<Missions>& all, const std::vector<double>& grid) {
  Json rows = Json::array();
  for (const Missions& m : all)
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const Summary rmse = at_time(m.rmse_hotspots, i), iou = at_time(m.iou, i);
      rows.push_back({{"clock", m.clock},
                      {"noise", m.reading},
                      {"method", m.method},
                      {"time_s", grid[i]},
                      {"fields", m.field.size()},
                      {"rmse_hotspots", number(rmse.mean)},
                      {"rmse_hotspots_deviation", number(rmse.deviation)},
                      {"iou", number(iou.mean)},
                      {"iou_deviation", number(iou.deviation)}});
    }
  return rows;
}

std::vector<std::string> write_plots(const PlanningOptions& o, const std::vector<Missions>& all,
                                     const std::vector<double>& grid) {
  std::vector<std::string> files;
  make_folder(o.out / "figures");
  for (const std::string& clock : o.clocks)
    for (const std::string& reading : o.readings)
      for (const bool iou : {false, true}) {
        Plot plot{.title = std::string(iou ? "IoU of hotspots" : "RMSE in hotspots") + ", " + clock +
                           " clock, noise: " + reading,
                  .x_label = "mission time [s]",
                  .y_label = "",
                  .curves = {},
                  .y_least_top = iou ? 1.0 : 0.0,
                  .width_px = 720,
                  .height_px = 380};
        for (const Missions& m : all) {
          if (m.clock != clock || m.reading != reading) continue;
          Curve curve{.name = std::string(method_info(m.method).label), .x = grid, .y = {}};
          for (std::size_t i = 0; i < grid.size(); ++i) {
            const Summary s = at_time(iou ? m.iou : m.rmse_hotspots, i);
            curve.y.push_back(s.mean);
            curve.low.push_back(std::max(0.0, s.mean - s.deviation));  // none of these is ever negative
            curve.high.push_back(s.mean + s.deviation);
          }
          plot.curves.push_back(std::move(curve));
        }
        if (plot.curves.empty()) continue;
        files.push_back("figures/" + std::string(iou ? "iou_" : "rmse_hotspots_") + clock + "_" + reading + ".svg");
        write_file(o.out / files.back(), svg_document(plot));
      }
  return files;
}

std::string results_table(const Json& rows, const std::string& clock, const std::string& reading) {
  const std::string header[] = {"Method",         "RMSE (hotspots) at the end", "averaged over time",
                                "IoU at the end", "averaged over time",         "Measurements",
                                "Planning [s]",   "Longest plan [s]",           "Mapping [s]",
                                "Flight [s]",     "Cells at the end",           "Low views of nothing hot [%]",
                                "Fields"};
  Markdown table(header);
  for (const Json& row : rows) {
    if (row["clock"] != clock || row["noise"] != reading) continue;
    const auto cell = [&](const std::string& name, int digits, double scale = 1) {
      return with_deviation(scale * number(row[name]), scale * number(row[name + "_deviation"]), digits);
    };
    const std::string cells[] = {row["label"],          cell("rmse_hotspots_end", 4),  cell("rmse_hotspots_average", 4),
                                 cell("iou_end", 3),    cell("iou_average", 3),        cell("measurements", 1),
                                 cell("planning_s", 2), cell("longest_planning_s", 3), cell("mapping_s", 2),
                                 cell("flight_s", 1),   cell("cells_end", 0),          cell("wasted_share", 1, 100),
                                 row["fields"].dump()};
    table.row(cells);
  }
  return table.text();
}

void write_tables(const PlanningOptions& o, const Units& store) {
  const std::vector<double> grid = time_grid(o.budget_s(), step_of_grid_s);
  const std::vector<Missions> all = collect(o, store, grid);
  if (all.empty()) throw Error("--merge", "there are no results in " + o.units().string(), "units that have run");
  const Json rows = make_rows(all);
  const std::vector<Claim> claims = make_claims(o, all, grid);
  const Json summary = {{"study", "field_planning"},
                        {"version", VANTAGE_VERSION},
                        {"seed", o.seed},
                        {"budget_s", o.budget_s()},
                        {"threads", o.threads == 0 ? tbb::info::default_concurrency() : o.threads},
                        {"rows", rows},
                        {"claims", json(claims)}};
  write_file(o.out / "summary.json", summary.dump(1) + "\n");
  write_file(o.out / "table.csv", csv(rows));
  write_file(o.out / "curves.csv", csv(curves_table(all, grid)));
  const std::vector<std::string> plots = write_plots(o, all, grid);

  std::string text =
      concat("# Field mapping with view planning (Fig. 3.6)\n\nGaussian random fields as for Table 3.1, maps of ",
             map_size, " x ", map_size,
             " cells, prior mean 0.7; 300 views at 2 m and 5 m, variance reduction in regions of interest per flight "
             "time at 1 m/s; ",
             short_number(o.budget_s()),
             " s of mission time = planning + mapping + flight. Mean ± deviation over the fields. The thesis prints "
             "its curves but no numbers.\n");
  for (const std::string& clock : o.clocks) {
    text +=
        "\n## " + clock + " clock\n\n" +
        (clock == "measured" ? concat("Planning and mapping take what they take here, on ", summary["threads"].dump(),
                                      " thread(s) (load average when a mission began: at most ",
                                      decimals(store.busiest(plan_units(o)), 1), ").\n")
                             : about_published_costs() + "\n");
    for (const std::string& reading : o.readings)
      text += "\n### Noise: " + reading + "\n\n" + about(reading) + ".\n\n" + results_table(rows, clock, reading);
    for (const std::string& file : plots)
      if (file.find("_" + clock + "_") != file.npos) text += "\n![](" + file + ")\n";
  }
  const std::string header[] = {"Claim of section 3.2.3", "Setting", "", "Numbers"};
  Markdown table(header);
  for (const Claim& c : claims) {
    const std::string cells[] = {c.text, c.scope, verdict(c.met), c.numbers};
    table.row(cells);
  }
  text += "\n## Claims\n\nDifferences are taken field by field; ± is their standard error.\n\n" + table.text();
  write_file(o.out / "table.md", text);
  std::cout << (o.out / "table.md").string() << '\n';
}

void run(const PlanningOptions& o) {
  run_study(
      o, plan_units(o), std::cerr,
      [&](const Unit& u) {
        const auto& p = u.parameters;
        return with_reading(p["noise"].get<std::string>(), [&]<class Preset>() {
          return with_planned_method<Preset>(p["method"].get<std::string>(), [&]<class MapT>() {
            return run_mission<MapT, Preset>(p["method"], p["clock"], p["seed"], p["field"], p["budget_s"]);
          });
        });
      },
      [&](const Units& store) { write_tables(o, store); });
}

}  // namespace study

int main(int argc, char** argv) {
  CLI::App app(
      "Fig. 3.6: which map lets the planner find the hotspots first? Writes summary.json, table.md, table.csv, "
      "curves.csv and figures.",
      "field_planning");
  study::PlanningOptions options;
  options.out = "out/studies/field_planning";
  for (const std::string_view name : study::planned_methods) options.methods.emplace_back(name);
  options.readings = {"reference", "thesis_quiet"};
  study::add_field_study_options(app, options);
  app.add_option("--clocks", options.clocks,
                 "measured: computing as it is here. published: as the published code takes")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{"measured", "published"}))
      ->default_str("measured,published")
      ->type_name("NAME,...");
  app.add_option("--budget", options.budget, "Mission time (default: 300)")
      ->check(CLI::Range(10.0, 36000.0))
      ->type_name("SECONDS");
  return vantage::run_program(app, argc, argv, std::cout, std::cerr,
                              [&] { vantage::with_threads(options.threads, [&] { study::run(options); }); });
}
