// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// The counterpart of Fig. 6.4: ways to reconstruct homes with surfels, by what the renderings and the surface are worth
// over mission time.
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <span>
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

constexpr double judged_every_s = 60;

struct SceneOptions : Options {
  std::vector<std::filesystem::path> scenes;
  std::uint64_t runs = 5;
  double budget = 300;
  int test_views = 100;
  std::vector<std::string> clocks = {"real", "modelled"};
  [[nodiscard]] std::uint64_t run_count() const { return quick ? 1 : runs; }
  [[nodiscard]] double budget_s() const { return quick ? std::min(budget, 60.0) : budget; }
  [[nodiscard]] std::size_t scene_count() const { return quick ? 1 : scenes.size(); }
};

std::vector<Unit> plan_units(const SceneOptions& o) {
  std::vector<Unit> units;
  const int threads = o.threads == 0 ? tbb::info::default_concurrency() : o.threads;
  for (std::uint64_t run = 0; run < o.run_count(); ++run)
    for (std::size_t s = 0; s < o.scene_count(); ++s)
      for (const std::string& clock : o.clocks)
        for (const std::string& method : o.methods) {
          const std::string name = scene::title_of(o.scenes[s]);
          units.push_back({concat("scene_", name, "_", method, "_", clock, "_", run),
                           {{"study", "scene"},
                            {"scene", name},
                            {"method", method},
                            {"clock", clock},
                            {"run", run},
                            {"budget_s", o.budget_s()},
                            {"test_views", o.test_views},
                            {"seed", o.seed},
                            {"threads", threads}}});
        }
  return units;
}

Json reconstruct(const SceneOptions& o, const Unit& unit) {
  const Json& p = unit.parameters;
  scene::Options s;
  s.scene = home_named(p["scene"], o.scenes);
  s.seed = o.seed + p["run"].get<std::uint64_t>();
  s.method = p["method"];
  s.preset = PresetKind::reference;
  if (s.method == "ours_thesis") s.method = "ours", s.preset = PresetKind::thesis;
  s.map = "surfels";
  s.clock = p["clock"] == "real" ? ClockKind::real : ClockKind::modelled;
  s.budget_s = p["budget_s"];
  s.test_views = p["test_views"];
  s.judge_every_s = judged_every_s;
  const scene::Mission mission = fly(o, unit, s);
  Json result;
  for (const scene::Score& score : mission.scores) {
    result["elapsed_s"].push_back(score.elapsed_s);
    result["psnr"].push_back(number(score.psnr_db));
    result["completeness"].push_back(number(score.completeness));
  }
  double planning_s = 0, mapping_s = 0, plans = 0;
  for (const StepRecord& step : mission.record.steps)
    planning_s += step.planning_s, mapping_s += step.mapping_s, plans += step.planned ? 1 : 0;
  const StepRecord& last = mission.record.steps.back();
  for (const char* name : {"coverage", "collisions", "surfels"}) result[name] = number(last.metric(name));
  result["views"] = last.index;
  result["way_m"] = last.travelled_m;
  result["planning_s"] = planning_s / std::max(plans, 1.0);
  result["mapping_s"] = mapping_s / static_cast<double>(last.index);
  return result;
}

/// The results of one method with one clock in one scene (or in all of them), a value a run.
struct Runs {
  std::string scene, clock, method;
  std::map<std::string, std::vector<double>> figures;
  std::map<std::string, std::vector<std::vector<double>>> curves;  ///< psnr and completeness on the time grid

  /// The mean of a curve at each time of the grid.
  [[nodiscard]] std::vector<double> mean(const std::string& curve) const {
    const auto& all = curves.at(curve);
    std::vector<double> means;
    for (std::size_t i = 0; i < all.front().size(); ++i) {
      std::vector<double> values;
      for (const std::vector<double>& c : all) values.push_back(c[i]);
      means.push_back(Summary::of(values).mean);
    }
    return means;
  }
};

void add(Runs& runs, const Json& result, const std::vector<double>& grid) {
  std::vector<double> elapsed;
  for (const Json& x : result["elapsed_s"]) elapsed.push_back(number(x));
  for (const char* name : {"psnr", "completeness"}) {
    std::vector<double> values;
    for (const Json& x : result[name]) values.push_back(number(x));
    runs.figures[name].push_back(values.back());
    runs.curves[name].push_back(between_looks(elapsed, values, grid));
  }
  for (const char* name : {"coverage", "collisions", "views", "surfels", "way_m", "planning_s", "mapping_s"})
    runs.figures[name].push_back(number(result[name]));
}

/// Every method with every clock in all scenes together, then in each; those without a run are empty.
std::vector<Runs> collect(const SceneOptions& o, const Units& store, const std::vector<double>& grid) {
  std::vector<Runs> all;
  std::vector<std::string> scenes = {"all"};
  for (std::size_t s = 0; s < o.scene_count(); ++s) scenes.push_back(scene::title_of(o.scenes[s]));
  for (const std::string& scene : scenes)
    for (const std::string& clock : o.clocks)
      for (const std::string& method : o.methods)
        all.push_back({.scene = scene, .clock = clock, .method = method, .figures = {}, .curves = {}});
  for (const Unit& u : plan_units(o))
    if (const auto result = store.result(u))
      for (Runs& r : all)
        if (r.method == u.parameters["method"] && r.clock == u.parameters["clock"] &&
            (r.scene == "all" || r.scene == u.parameters["scene"]))
          add(r, *result, grid);
  return all;
}

Json make_rows(const std::vector<Runs>& all) {
  Json rows = Json::array();
  for (const Runs& r : all) {
    Json row = {{"method", r.method}, {"scene", r.scene}, {"clock", r.clock}};
    row["runs"] = r.figures.empty() ? 0 : r.figures.at("psnr").size();
    for (const auto& [name, values] : r.figures) {
      const Summary s = Summary::of(values);
      row[name] = number(s.mean);
      row[name + "_deviation"] = number(s.count > 1 ? s.deviation : nan);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string results_table(const Json& rows, const std::string& scene, const std::string& clock) {
  const std::string header[] = {"Method",  "PSNR [dB]",   "completeness [%]", "coverage [%]", "views", "way [m]",
                                "surfels", "a plan [ms]", "a mapping [ms]",   "collisions",   "runs"};
  Markdown table(header);
  for (const Json& row : rows) {
    if (row["scene"] != scene || row["clock"] != clock) continue;
    const auto cell = [&](const std::string& name, int digits, double scale = 1) {
      return row["runs"] == 0
                 ? std::string("not run")
                 : with_deviation(scale * number(row[name]), scale * number(row[name + "_deviation"]), digits);
    };
    const std::string cells[] = {row["method"],
                                 cell("psnr", 2),
                                 cell("completeness", 1, 100),
                                 cell("coverage", 1, 100),
                                 cell("views", 0),
                                 cell("way_m", 0),
                                 cell("surfels", 0),
                                 cell("planning_s", 0, 1000),
                                 cell("mapping_s", 0, 1000),
                                 cell("collisions", 1),
                                 row["runs"].dump()};
    table.row(cells);
  }
  return table.text();
}

/// What each method has reached by each time of the grid but its first, on average.
std::string progress_table(const std::vector<Runs>& all, const std::string& scene, const std::string& clock,
                           std::span<const double> grid) {
  std::vector<std::string> header = {"PSNR [dB], completeness [%] after"};
  for (const double t : grid.subspan(1)) header.push_back(short_number(t) + " s");
  Markdown table(header);
  for (const Runs& r : all) {
    if (r.scene != scene || r.clock != clock || r.curves.empty()) continue;
    const std::vector<double> psnr = r.mean("psnr"), completeness = r.mean("completeness");
    std::vector<std::string> cells = {r.method};
    for (std::size_t i = 1; i < grid.size(); ++i)
      cells.push_back(decimals(psnr[i], 2) + ", " + decimals(100 * completeness[i], 1));
    table.row(cells);
  }
  return table.text();
}

std::string write_plot(const SceneOptions& o, const std::vector<Runs>& all, const std::string& scene,
                       const std::string& clock, const std::string& what, const std::vector<double>& grid) {
  Plot plot{.title = what + ", " + (scene == "all" ? std::string("all scenes") : scene) + ", " + clock + " clock",
            .x_label = "mission time [s]",
            .y_label = what == "psnr" ? "dB" : "",
            .curves = {},
            .from_zero = what != "psnr",
            .width_px = 720,
            .height_px = 380};
  for (const Runs& r : all) {
    if (r.scene != scene || r.clock != clock || r.curves.empty()) continue;
    Curve curve{.name = r.method, .x = {}, .y = {}};
    const std::vector<double> mean = r.mean(what);
    for (std::size_t i = 0; i < grid.size(); ++i) {
      if (!std::isfinite(mean[i])) continue;
      curve.x.push_back(grid[i]);
      curve.y.push_back(mean[i]);
    }
    plot.curves.push_back(std::move(curve));
  }
  make_folder(o.out / "figures");
  const std::string file = concat("figures/", what, "_", scene, "_", clock, ".svg");
  write_file(o.out / file, svg_document(plot));
  return file;
}

void write_tables(const SceneOptions& o, const Units& store) {
  const std::vector<double> grid = time_grid(o.budget_s(), judged_every_s);
  const std::vector<Runs> all = collect(o, store, grid);
  const Json rows = make_rows(all);
  const int threads = o.threads == 0 ? tbb::info::default_concurrency() : o.threads;
  const Json summary = {{"study", "scene"},         {"version", VANTAGE_VERSION}, {"seed", o.seed},
                        {"budget_s", o.budget_s()}, {"threads", threads},         {"rows", rows}};
  write_file(o.out / "summary.json", summary.dump(1) + "\n");
  write_file(o.out / "table.csv", csv(rows));
  std::string text = concat(
      "# Scene reconstruction\n\nA robot that knows nothing of a home reconstructs it with surfels for ",
      short_number(o.budget_s()),
      " s of mission time = mapping + planning + flight at 1 m/s: with the real clock as they take on ", threads,
      " threads (load average when a mission began: at most ", decimals(store.busiest(plan_units(o)), 1),
      "), with the modelled clock 1 s and 0.5 s, as the thesis says of its GPU. PSNR over ", o.test_views,
      " views from free space; completeness: surface within 2 cm of the mesh, of all that can be seen from where the "
      "robot's body can be. Mean ± deviation over the runs; a collision is a path too near to a triangle.\n");
  std::vector<std::string> scenes;
  for (const Runs& r : all)
    if (std::ranges::find(scenes, r.scene) == scenes.end()) scenes.push_back(r.scene);
  for (const std::string& scene : scenes)
    for (const std::string& clock : o.clocks) {
      text += "\n## " + (scene == "all" ? std::string("All scenes") : scene) + ", " + clock + " clock\n\n" +
              results_table(rows, scene, clock) + "\n" + progress_table(all, scene, clock, grid);
      for (const char* what : {"psnr", "completeness"})
        text += "\n![](" + write_plot(o, all, scene, clock, what, grid) + ")";
      text += "\n";
    }
  write_file(o.out / "table.md", text);
  std::cout << (o.out / "table.md").string() << '\n';
}

void run(SceneOptions o) {
  if (o.scenes.empty()) o.scenes = fetched_scenes();
  if (o.scenes.empty())
    throw Error("--scenes", "no home is at hand",
                "folders with a scene.json: examples/data/fetch_scenes --all gets some");
  run_study(
      o, plan_units(o), std::cerr, [&](const Unit& u) { return reconstruct(o, u); },
      [&](const Units& store) { write_tables(o, store); });
}

}  // namespace study

int main(int argc, char** argv) {
  CLI::App app(
      "Scene reconstruction with surfels (Fig. 6.4): the system of chapter 6, its ablations and baselines in homes. "
      "Writes summary.json, table.md, table.csv and figures.",
      "scene");
  study::SceneOptions options;
  options.out = "out/studies/scene";
  options.methods = {"ours", "without_roi", "view_count", "fbe", "fisher", "random", "ours_thesis"};
  study::add_study_options(app, options);
  app.add_option("--scenes", options.scenes, "Homes (default: all that examples/data/fetch_scenes got)")
      ->delimiter(',')
      ->type_name("DIR,...");
  app.add_option("--runs", options.runs, "Missions of a method in a scene, each with a seed of its own")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--budget", options.budget, "Mission time")
      ->check(CLI::Range(10.0, 36000.0))
      ->capture_default_str()
      ->type_name("SECONDS");
  app.add_option("--test-views", options.test_views, "Views that the renderings are judged by")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--clocks", options.clocks, "real, modelled")
      ->delimiter(',')
      ->check(CLI::IsMember({"real", "modelled"}))
      ->type_name("CLOCK,...");
  return vantage::run_program(app, argc, argv, std::cout, std::cerr,
                              [&] { vantage::with_threads(options.threads, [&] { study::run(options); }); });
}
