// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Ways to explore homes that nobody knows: how long until 90 and 95 % of the surface was seen?
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <vantage/mission/plot.hpp>

#include "homes.hpp"
#include "statistics.hpp"
#include "study_options.hpp"
#include "table.hpp"
#include "units.hpp"

namespace study {

using namespace vantage;

constexpr double step_of_grid_s = 2;

struct ExploreOptions : Options {
  std::vector<std::filesystem::path> scenes;
  std::uint64_t runs = 3;
  double budget = 900;
  std::string clock = "real";
  [[nodiscard]] std::uint64_t run_count() const { return quick ? 1 : runs; }
  [[nodiscard]] double budget_s() const { return quick ? std::min(budget, 120.0) : budget; }
  [[nodiscard]] std::size_t scene_count() const { return quick ? 1 : scenes.size(); }
};

std::vector<Unit> plan_units(const ExploreOptions& o) {
  std::vector<Unit> units;
  const int threads = o.threads == 0 ? tbb::info::default_concurrency() : o.threads;
  for (std::size_t s = 0; s < o.scene_count(); ++s)
    for (const std::string& method : o.methods)
      for (std::uint64_t run = 0; run < o.run_count(); ++run) {
        const std::string name = scene::title_of(o.scenes[s]);
        units.push_back({concat("explore_", name, "_", method, "_", run),
                         {{"study", "explore"},
                          {"scene", name},
                          {"method", method},
                          {"run", run},
                          {"clock", o.clock},
                          {"budget_s", o.budget_s()},
                          {"seed", o.seed},
                          {"threads", threads}}});
      }
  return units;
}

Json explore(const ExploreOptions& o, const Unit& unit) {
  const Json& p = unit.parameters;
  scene::Options s;
  s.scene = home_named(p["scene"], o.scenes);
  s.seed = o.seed + p["run"].get<std::uint64_t>();
  s.method = p["method"];
  s.map = "voxels";
  s.clock = p["clock"] == "real" ? ClockKind::real : ClockKind::modelled;
  s.budget_s = p["budget_s"];
  const MissionRecord record = fly(o, unit, s).record;
  Json result;
  for (const StepRecord& step : record.steps) {
    const auto note = [&](const char* name, double value) { result[name].push_back(number(value)); };
    note("elapsed_s", step.elapsed_s);
    note("travelled_m", step.travelled_m);
    note("coverage", step.metric("coverage"));
    note("planning_s", step.planning_s);
    note("mapping_s", step.mapping_s);
    note("planned", step.planned ? 1 : 0);
  }
  result["collisions"] = record.steps.back().metric("collisions");
  return result;
}

/// The results of one method in one scene (or in all of them), a value a run.
struct Runs {
  std::string scene, method;
  std::map<std::string, std::vector<double>> figures;
  std::vector<std::vector<double>> coverage;  ///< on the time grid

  [[nodiscard]] Summary summary(const std::string& name) const { return Summary::of(figures.at(name)); }
};

const std::vector<std::string> figure_names = {"time_to_90_s", "time_to_95_s", "way_to_95_m",  "coverage_end",
                                               "mission_s",    "way_m",        "measurements", "planning_ms",
                                               "mapping_ms",   "collisions"};

void add(Runs& runs, const Json& result, const std::vector<double>& grid) {
  const auto list = [&](const char* name) {
    std::vector<double> values;
    for (const Json& x : result[name]) values.push_back(number(x));
    return values;
  };
  const std::vector<double> elapsed = list("elapsed_s"), way = list("travelled_m"), coverage = list("coverage"),
                            planned = list("planned"), planning = list("planning_s"), mapping = list("mapping_s");
  const auto when = [&](double share, const std::vector<double>& of) {
    const auto at = std::ranges::find_if(coverage, [&](double c) { return c >= share; });
    return at == coverage.end() ? nan : of[static_cast<std::size_t>(at - coverage.begin())];
  };
  double plans = 0, planning_s = 0, mapping_s = 0;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    plans += planned[i];
    planning_s += planning[i];
    mapping_s += mapping[i];
  }
  const std::map<std::string, double> figures = {{"time_to_90_s", when(0.90, elapsed)},
                                                 {"time_to_95_s", when(0.95, elapsed)},
                                                 {"way_to_95_m", when(0.95, way)},
                                                 {"coverage_end", coverage.back()},
                                                 {"mission_s", elapsed.back()},
                                                 {"way_m", way.back()},
                                                 {"measurements", static_cast<double>(elapsed.size())},
                                                 {"planning_ms", plans > 0 ? 1000 * planning_s / plans : nan},
                                                 {"mapping_ms", 1000 * mapping_s / static_cast<double>(elapsed.size())},
                                                 {"collisions", number(result["collisions"])}};
  for (const auto& [name, value] : figures) runs.figures[name].push_back(value);
  runs.coverage.push_back(held(elapsed, coverage, grid));
}

/// A method's runs in each scene, then, as scene "all", in all of them.
std::vector<Runs> collect(const ExploreOptions& o, const Units& store, const std::vector<double>& grid) {
  std::vector<Runs> each, all;
  for (const std::string& method : o.methods)
    all.push_back({.scene = "all", .method = method, .figures = {}, .coverage = {}});
  for (const Unit& u : plan_units(o)) {
    const auto result = store.result(u);
    if (!result) continue;
    const std::string scene = u.parameters["scene"], method = u.parameters["method"];
    if (each.empty() || each.back().scene != scene || each.back().method != method)
      each.push_back({.scene = scene, .method = method, .figures = {}, .coverage = {}});
    add(each.back(), *result, grid);
    add(*std::ranges::find(all, method, &Runs::method), *result, grid);
  }
  std::erase_if(all, [](const Runs& r) { return r.coverage.empty(); });
  each.insert(each.end(), all.begin(), all.end());
  return each;
}

Json make_rows(const std::vector<Runs>& all) {
  Json rows = Json::array();
  for (const Runs& r : all) {
    Json row = {{"method", r.method}, {"scene", r.scene}, {"runs", r.coverage.size()}};
    for (const std::string& name : figure_names) {
      const Summary s = r.summary(name);
      row[name] = number(s.mean);
      row[name + "_deviation"] = number(s.deviation);
      if (name.starts_with("time_to")) row[name + "_runs"] = s.count;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string results_table(const Json& rows, const std::string& scene) {
  const std::string header[] = {
      "Method",  "90 % seen [s]", "95 % seen [s]", "way to 95 % [m]", "seen in the end [%]", "mission [s]",
      "way [m]", "views",         "a plan [ms]",   "a mapping [ms]",  "collisions",          "runs"};
  Markdown table(header);
  for (const Json& row : rows) {
    if (row["scene"] != scene) continue;
    const auto cell = [&](const std::string& name, int digits, double scale = 1) {
      return with_deviation(scale * number(row[name]), scale * number(row[name + "_deviation"]), digits);
    };
    const auto reached = [&](const std::string& name) {
      const std::string text = cell(name, 0);
      return row[name + "_runs"] == row["runs"]
                 ? text
                 : text + concat(" (", row[name + "_runs"].dump(), " of ", row["runs"].dump(), ")");
    };
    const std::string cells[] = {row["method"],          reached("time_to_90_s"),      reached("time_to_95_s"),
                                 cell("way_to_95_m", 0), cell("coverage_end", 1, 100), cell("mission_s", 0),
                                 cell("way_m", 0),       cell("measurements", 0),      cell("planning_ms", 1),
                                 cell("mapping_ms", 2),  cell("collisions", 1),        row["runs"].dump()};
    table.row(cells);
  }
  return table.text();
}

std::string write_plot(const ExploreOptions& o, const std::vector<Runs>& all, const std::string& scene,
                       const std::vector<double>& grid) {
  Plot plot{.title = "Surface seen, " + (scene == "all" ? std::string("all scenes") : scene),
            .x_label = "mission time [s]",
            .y_label = "",
            .curves = {},
            .y_least_top = 1.0,
            .width_px = 720,
            .height_px = 380};
  for (const Runs& r : all) {
    if (r.scene != scene) continue;
    Curve curve{.name = r.method, .x = {}, .y = {}};
    for (std::size_t i = 0; i < grid.size(); ++i) {
      std::vector<double> values;
      for (const std::vector<double>& c : r.coverage) values.push_back(std::isnan(c[i]) ? 0 : c[i]);
      const Summary s = Summary::of(values);
      curve.x.push_back(grid[i]);
      curve.y.push_back(s.mean);
      curve.low.push_back(s.mean - s.deviation);
      curve.high.push_back(std::min(1.0, s.mean + s.deviation));
    }
    plot.curves.push_back(std::move(curve));
  }
  make_folder(o.out / "figures");
  const std::string file = "figures/coverage_" + scene + ".svg";
  write_file(o.out / file, svg_document(plot));
  return file;
}

void write_tables(const ExploreOptions& o, const Units& store) {
  const std::vector<double> grid = time_grid(o.budget_s(), step_of_grid_s);
  const std::vector<Runs> all = collect(o, store, grid);
  if (all.empty()) throw Error("--merge", "there are no results in " + o.units().string(), "units that have run");
  const Json rows = make_rows(all);
  const int threads = o.threads == 0 ? tbb::info::default_concurrency() : o.threads;
  const Json summary = {{"study", "explore"},       {"version", VANTAGE_VERSION}, {"clock", o.clock}, {"seed", o.seed},
                        {"budget_s", o.budget_s()}, {"threads", threads},         {"rows", rows}};
  write_file(o.out / "summary.json", summary.dump(1) + "\n");
  write_file(o.out / "table.csv", csv(rows));
  std::string text = concat(
      "# Exploration\n\nA robot that knows nothing of a home maps it in voxels and flies at 1 m/s where they are "
      "free; ",
      short_number(o.budget_s()), " s of mission time at most = planning + mapping (",
      o.clock == "real"
          ? concat("as they take here, on ", threads, " threads; load average when a mission began: at most ",
                   decimals(store.busiest(plan_units(o)), 1))
          : std::string("0.1 s each: the modelled clock"),
      ") + flight. Seen, by exact lines of sight: of the surface that can be seen from where the robot's body can be. "
      "Mean ± deviation over the "
      "runs that got so far; a collision is a path too near to a triangle.\n");
  std::vector<std::string> scenes;
  for (const Runs& r : all)
    if (std::ranges::find(scenes, r.scene) == scenes.end()) scenes.push_back(r.scene);
  std::ranges::rotate(scenes, scenes.end() - 1);  // all of them first
  for (const std::string& scene : scenes)
    text += "\n## " + (scene == "all" ? std::string("All scenes") : scene) + "\n\n" + results_table(rows, scene) +
            "\n![](" + write_plot(o, all, scene, grid) + ")\n";
  write_file(o.out / "table.md", text);
  std::cout << (o.out / "table.md").string() << '\n';
}

void run(ExploreOptions o) {
  if (o.scenes.empty()) o.scenes = fetched_scenes();
  if (o.scenes.empty())
    throw Error("--scenes", "no home is at hand",
                "folders with a scene.json: examples/data/fetch_scenes --all gets some");
  run_study(
      o, plan_units(o), std::cerr, [&](const Unit& u) { return explore(o, u); },
      [&](const Units& store) { write_tables(o, store); });
}

}  // namespace study

int main(int argc, char** argv) {
  CLI::App app(
      "Exploration: frontiers, a tree of views, information gain and chance in homes. Writes summary.json, table.md, "
      "table.csv and figures.",
      "explore");
  study::ExploreOptions options;
  options.out = "out/studies/explore";
  options.methods = {"fbe", "nbvp", "information_gain", "random"};
  study::add_study_options(app, options);
  app.add_option("--scenes", options.scenes, "Homes (default: all that examples/data/fetch_scenes got)")
      ->delimiter(',')
      ->type_name("DIR,...");
  app.add_option("--runs", options.runs, "Missions of a method in a scene, each with a seed of its own")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--clock", options.clock, "Of planning and mapping: what they take here, or 0.1 s each")
      ->check(CLI::IsMember({"real", "modelled"}))
      ->capture_default_str()
      ->type_name("NAME");
  app.add_option("--budget", options.budget, "Mission time")
      ->check(CLI::Range(10.0, 36000.0))
      ->capture_default_str()
      ->type_name("SECONDS");
  return vantage::run_program(app, argc, argv, std::cout, std::cerr,
                              [&] { vantage::with_threads(options.threads, [&] { study::run(options); }); });
}
