// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// Table 3.1 and Fig. 3.4 of the thesis: six ways to map a field from the same 16 measurements.
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

#include <vantage/mission/plot.hpp>

#include "field_claims.hpp"
#include "field_methods.hpp"
#include "field_mission.hpp"
#include "field_options.hpp"
#include "field_pictures.hpp"
#include "statistics.hpp"
#include "table.hpp"
#include "table_3_1.hpp"
#include "units.hpp"

namespace study {

struct FieldOptions : FieldStudyOptions {
  std::vector<int> sizes;
  [[nodiscard]] std::uint64_t field_count() const { return fields.value_or(quick ? 2 : 20); }
  [[nodiscard]] std::vector<int> size_list() const {
    return !sizes.empty() ? sizes : quick ? std::vector{16, 32} : std::vector{16, 32, 64};
  }
};

std::vector<Unit> plan_units(const FieldOptions& o) {
  std::vector<Unit> units;
  const int threads = o.threads == 0 ? tbb::info::default_concurrency() : o.threads;
  for (const int size : o.size_list())
    for (const std::string& reading : o.readings)
      for (const std::string& method : o.methods)
        for (std::uint64_t field = 0; field < o.field_count(); ++field)
          units.push_back({concat("field_", reading, "_", size, "_", method, "_", field),
                           {{"study", "field"},
                            {"noise", reading},
                            {"size", size},
                            {"method", method},
                            {"field", field},
                            {"seed", o.seed},
                            {"threads", threads}}});
  return units;
}

const std::vector<std::string> metrics = {"rmse",  "rmse_hotspots",  "iou",   "mapping_ms",       "construction_ms",
                                          "bytes", "memory_percent", "cells", "rmse_decompressed"};

/// One row per noise, size and method: mean and deviation over the fields that have run, beside the thesis' figures.
Json make_rows(const FieldOptions& o, const Units& store) {
  std::map<std::string, std::map<std::uint64_t, Json>> results;  // by noise, size and method; then by field
  const auto key = [](const std::string& reading, int size, const std::string& method) {
    return concat(reading, ' ', size, ' ', method);
  };
  for (const Unit& u : plan_units(o))
    if (auto r = store.result(u))
      results[key(u.parameters["noise"], u.parameters["size"], u.parameters["method"])][u.parameters["field"]] = *r;

  Json rows = Json::array();
  for (const std::string& reading : o.readings)
    for (const int size : o.size_list())
      for (const std::string& method : o.methods) {
        const auto& of_fields = results[key(reading, size, method)];
        if (of_fields.empty()) continue;
        const auto& dense = results[key(reading, size, "fr_gpf")];
        Json row = {{"method", method},
                    {"label", method_info(method).label},
                    {"size", size},
                    {"noise", reading},
                    {"fields", of_fields.size()}};
        for (const std::string& metric : metrics) {
          std::vector<double> values;
          for (const auto& [field, r] : of_fields) {
            if (metric != "memory_percent")
              values.push_back(number(r[metric]));
            else if (const auto d = dense.find(field); d != dense.end())
              values.push_back(100 * number(r["bytes"]) / number(d->second["bytes"]));
          }
          const Summary s = Summary::of(values);
          row[metric] = number(s.mean);
          row[metric + "_deviation"] = number(s.deviation);
        }
        const PrintedRow* p = printed(method, size);
        const auto put = [&](const std::string& metric, Printed PrintedRow::*member) {
          row["thesis_" + metric] = p ? Json((p->*member).mean) : Json();
          row["thesis_" + metric + "_deviation"] = p ? Json((p->*member).deviation) : Json();
        };
        put("rmse", &PrintedRow::rmse);
        put("rmse_hotspots", &PrintedRow::rmse_hotspots);
        put("iou", &PrintedRow::iou);
        put("mapping_ms", &PrintedRow::mapping_ms);
        put("memory_percent", &PrintedRow::memory_percent);
        put("cells", &PrintedRow::cells);
        rows.push_back(std::move(row));
      }
  return rows;
}

Figures figures_of(const Json& rows, const std::string& reading, int size, const std::string& prefix) {
  return [&rows, reading, size, prefix](std::string_view method, std::string_view metric) {
    for (const Json& row : rows)
      if (row["noise"] == reading && row["size"] == size && row["method"] == method)
        return number(row[prefix + std::string(metric)]);
    return nan;
  };
}

std::string scope_of(const std::string& reading, int size) {
  return concat("noise: ", reading, ", ", size, " x ", size);
}

std::vector<Claim> make_claims(const FieldOptions& o, const Json& rows) {
  std::vector<Claim> claims;
  for (const std::string& reading : o.readings)
    for (const int size : o.size_list()) {
      const std::string scope = scope_of(reading, size);
      const std::vector<Tested> ours = test_claims(figures_of(rows, reading, size, "")),
                                thesis = test_claims(figures_of(rows, reading, size, "thesis_"));
      for (std::size_t i = 0; i < ours.size(); ++i)
        claims.push_back({ours[i].text, scope, ours[i].met, thesis[i].met, ours[i].numbers});
      const Figures f = figures_of(rows, reading, size, "");
      const double difference = std::abs(f("ours", "rmse") - f("ours_latent", "rmse")),
                   cells = std::abs(f("ours", "cells") - f("ours_latent", "cells"));
      claims.push_back(
          {"Beyond the thesis: the latent covariance gives the map of Ours (RMSE within 1e-6, as many cells)", scope,
           std::isnan(difference) ? std::nullopt : std::optional(difference < 1e-6 && cells == 0), std::nullopt,
           concat("RMSE differs by ", short_number(difference), ", cells by ", short_number(cells))});
      const double before = f("ours", "rmse"), after = f("ours", "rmse_decompressed");
      claims.push_back(
          {"Decompression recovers a higher resolution (here: 50 x 50 cells reconstructed from Ours have a lower RMSE "
           "than Ours)",
           scope, std::isnan(before) || std::isnan(after) ? std::nullopt : std::optional(after < before), std::nullopt,
           concat("RMSE ", decimals(before, 4), " before, ", decimals(after, 4), " after, FR-GPF ",
                  decimals(f("fr_gpf", "rmse"), 4))});
    }
  return claims;
}

std::string results_table(const Json& rows, const std::string& reading, int size) {
  const std::string header[] = {
      "Method", "RMSE",  "RMSE (hotspots)", "IoU (hotspots)", "Mapping time [ms]", "Memory [% of FR-GPF]",
      "KiB",    "Cells", "Fields"};
  Markdown table(header);
  for (const Json& row : rows) {
    if (row["noise"] != reading || row["size"] != size) continue;
    const auto cell = [&](const std::string& metric, int digits) {  // 0: three digits
      const auto figure = [&](const std::string& name) {
        const double mean = number(row[name]);
        return with_deviation(mean, number(row[name + "_deviation"]), digits == 0 ? three_digits(mean) : digits);
      };
      return figure(metric) + (row["thesis_" + metric].is_null() ? "" : " (" + figure("thesis_" + metric) + ")");
    };
    const std::string cells[] = {row["label"],
                                 cell("rmse", 3),
                                 cell("rmse_hotspots", 3),
                                 cell("iou", 3),
                                 cell("mapping_ms", 0),
                                 cell("memory_percent", 0),
                                 decimals(number(row["bytes"]) / 1024, three_digits(number(row["bytes"]) / 1024)),
                                 cell("cells", 1),
                                 row["fields"].dump()};
    table.row(cells);
  }
  return table.text();
}

/// Claims as rows; a column for each noise and size, and the thesis' own figures.
std::string claims_table(const FieldOptions& o, const std::vector<Claim>& claims) {
  std::vector<std::string> header = {"Claim of section 3.2.1"}, scopes;
  for (const std::string& reading : o.readings)
    for (const int size : o.size_list()) {
      header.push_back(concat("noise: ", reading, ", ", size));
      scopes.push_back(scope_of(reading, size));
    }
  for (const int size : o.size_list()) header.push_back(concat("printed figures, ", size));
  Markdown table(header);
  std::vector<std::string> texts;
  for (const Claim& c : claims)
    if (std::find(texts.begin(), texts.end(), c.text) == texts.end()) texts.push_back(c.text);
  for (const std::string& text : texts) {
    std::vector<std::string> row = {text}, thesis;
    for (const std::string& scope : scopes)
      for (const Claim& c : claims)
        if (c.text == text && c.scope == scope) {
          row.push_back(verdict(c.met));
          thesis.push_back(verdict(c.of_thesis));
        }
    row.insert(row.end(), thesis.begin(), thesis.begin() + static_cast<std::ptrdiff_t>(o.size_list().size()));
    table.row(row);
  }
  return table.text();
}

std::string numbers_table(const std::vector<Claim>& claims) {
  const std::string header[] = {"Claim", "Noise, size", "", "Numbers"};
  Markdown table(header);
  for (const Claim& c : claims) {
    const std::string cells[] = {c.text, c.scope, verdict(c.met), c.numbers};
    table.row(cells);
  }
  return table.text();
}

/// One plot a metric and noise, over the size of the map. Returns the files' names.
std::vector<std::string> write_plots(const FieldOptions& o, const Json& rows) {
  struct Metric {
    std::string name, title, label;
    bool logarithm = false;
  };
  const std::vector<Metric> shown = {{"rmse", "RMSE", ""},
                                     {"rmse_hotspots", "RMSE in hotspots", ""},
                                     {"iou", "IoU of hotspots", ""},
                                     {"mapping_ms", "Mapping time of 16 updates", "log10 ms", true},
                                     {"bytes", "Memory", "log10 bytes", true},
                                     {"cells", "Cells", "log10", true}};
  std::vector<std::string> files;
  make_folder(o.out / "figures");
  for (const std::string& reading : o.readings)
    for (const Metric& metric : shown) {
      Plot plot{.title = metric.title + ", noise: " + reading,
                .x_label = "cells along a side",
                .y_label = metric.label,
                .curves = {},
                .from_zero = !metric.logarithm,
                .width_px = 760};
      for (const std::string& method : o.methods) {
        Curve curve{.name = std::string(method_info(method).label), .x = {}, .y = {}};
        for (const Json& row : rows)
          if (row["noise"] == reading && row["method"] == method) {
            const double mean = number(row[metric.name]), deviation = number(row[metric.name + "_deviation"]);
            curve.x.push_back(row["size"]);
            curve.y.push_back(metric.logarithm ? std::log10(mean) : mean);
            if (!metric.logarithm) {
              curve.low.push_back(mean - deviation);
              curve.high.push_back(mean + deviation);
            }
          }
        if (!curve.x.empty()) plot.curves.push_back(std::move(curve));
      }
      if (plot.curves.empty()) continue;
      files.push_back("figures/" + metric.name + "_" + reading + ".svg");
      write_file(o.out / files.back(), svg_document(plot));
    }
  return files;
}

/// Fig. 3.4: the first field under every method. Returns a page's part that shows them.
std::string write_pictures(const FieldOptions& o) {
  const std::vector<int> sizes = o.size_list();
  const int size = std::find(sizes.begin(), sizes.end(), 32) != sizes.end() ? 32 : sizes.front();
  const std::string& reading = o.readings.front();
  make_folder(o.out / "figures");
  std::string text;
  const auto put = [&](const std::string& name, const std::string& caption, const Picture& picture) {
    const std::string file = concat("figures/map_", size, "_", reading, "_", name, ".png");
    write_png(o.out / file, picture);
    text += "\n" + caption + "\n\n![](" + file + ")\n";
  };
  for (const std::string& method : o.methods)
    with_reading(reading, [&]<class Preset>() {
      with_method<Preset>(method, [&]<class MapT>() {
        const auto world = make_world<Preset>(o.seed, 0);
        const Flown<MapT> flown = fly<MapT, Preset>(world, size);
        const std::string label(method_info(method).label);
        put(method, label, picture_of(flown.map, world.truth(), flown.path));
        if constexpr (std::is_same_v<MapT, Ours<Preset>>) {
          const ScalarField fine = decompressed(flown.map, world.truth().area());
          put(method + "_decompressed", label + ", decompressed to 50 x 50 cells after the mission",
              picture_of(world.truth(), flown.path, flown.map.interest(), {},
                         [&](const Eigen::Vector2d& p) { return fine.at(p); }));
        }
      });
    });
  return text;
}

void write_tables(const FieldOptions& o, const Units& store) {
  const Json rows = make_rows(o, store);
  if (rows.empty()) throw Error("--merge", "there are no results in " + o.units().string(), "units that have run");
  const std::vector<Claim> claims = make_claims(o, rows);
  const Json summary = {{"study", "field"}, {"version", VANTAGE_VERSION},
                        {"seed", o.seed},   {"threads", o.threads == 0 ? tbb::info::default_concurrency() : o.threads},
                        {"rows", rows},     {"claims", json(claims)}};
  write_file(o.out / "summary.json", summary.dump(1) + "\n");
  write_file(o.out / "table.csv", csv(rows));
  const std::vector<std::string> plots = write_plots(o, rows);

  std::string text = concat(
      "# Field mapping (Table 3.1)\n\nGaussian random fields of 400 x 400 values over 20 m x 20 m, scaled to [0, 1]; "
      "hotspots above 0.7; 16 measurements of 5 m x 5 m "
      "from 2.5 m along a lawnmower path. Mean ± deviation over the fields; in brackets what the thesis prints. The "
      "mapping time is that of all 16 updates, merging "
      "included, on ",
      summary["threads"].dump(), " thread(s) of this machine (load average when a unit began: at most ",
      decimals(store.busiest(plan_units(o)), 1), "; median of up to ", most_repeats,
      " missions where one takes less than ", short_number(repeat_below_s),
      " s). Memory is what the map holds between updates. AR-BCM and AR-GPR-IK hold measurements and no covariance of "
      "cells (the thesis counts one for them).\n");
  for (const std::string& reading : o.readings) {
    text += "\n## Noise: " + reading + "\n\n" + about(reading) + ".\n";
    for (const int size : o.size_list())
      text += concat("\n### ", size, " x ", size, "\n\n", results_table(rows, reading, size));
  }
  text +=
      "\n## Claims\n\nEach is tested on the means over the fields, for each size; on the right, the same test on the "
      "figures that the thesis prints.\n\n" +
      claims_table(o, claims);
  text += "\n## Figures\n\n";
  for (const std::string& file : plots) text += "![](" + file + ")\n";
  text += concat(
      "\nThe first field under each method, as in Fig. 3.4: truth with the path, map with its cells, map minus truth "
      "(blue: ",
      short_number(shown_error), " too low, red: too high). The dark line bounds the true hotspots.\n");
  text += write_pictures(o);
  text += "\n## Numbers behind the claims\n\n" + numbers_table(claims);
  write_file(o.out / "table.md", text);
  std::cout << (o.out / "table.md").string() << '\n';
}

void run(const FieldOptions& o) {
  run_study(
      o, plan_units(o), std::cerr,
      [&](const Unit& u) {
        const auto& p = u.parameters;
        return with_reading(p["noise"].get<std::string>(), [&]<class Preset>() {
          return with_method<Preset>(p["method"].get<std::string>(), [&]<class MapT>() {
            return run_unit<MapT, Preset>(p["seed"], p["field"], p["size"]);
          });
        });
      },
      [&](const Units& store) { write_tables(o, store); });
}

}  // namespace study

int main(int argc, char** argv) {
  CLI::App app(
      "Table 3.1 and Fig. 3.4: six ways to map a field from the same 16 measurements. Writes summary.json, table.md, "
      "table.csv and figures.",
      "field");
  study::FieldOptions options;
  options.out = "out/studies/field";
  for (const study::MethodInfo& m : study::all_methods) options.methods.emplace_back(m.name);
  options.readings = {"reference", "thesis"};
  study::add_field_study_options(app, options);
  app.add_option("--sizes", options.sizes, "Finest cells along a side, separated by commas (default: 16,32,64)")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<int>{8, 16, 32, 64, 128}))
      ->type_name("N,...");
  return vantage::run_program(app, argc, argv, std::cout, std::cerr,
                              [&] { vantage::with_threads(options.threads, [&] { study::run(options); }); });
}
