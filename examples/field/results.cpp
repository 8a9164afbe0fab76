// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "results.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <vantage/io/npy.hpp>
#include <vantage/mission/canvas.hpp>
#include <vantage/mission/palette.hpp>
#include <vantage/mission/report.hpp>

namespace field {

namespace {

/// A picture and how to read it.
struct Drawing {
  std::string file, title, caption;
  Picture picture;
  ColourScale scale;
};

/// Draws truth, map, uncertainty and error, all in the same place and at the same size.
class Artist {
 public:
  Artist(const Snapshot& map, const ScalarField& truth, double threshold, const std::vector<View>& path)
      : map_(map), truth_(truth), threshold_(threshold), path_(path) {}

  [[nodiscard]] std::vector<Drawing> all() const {
    const std::string& unit = truth_.quantity().unit;
    const double low = truth_.minimum(), high = std::max(truth_.maximum(), low + 1e-12);
    const ColourScale values{colours_of(viridis), low, high, unit};
    std::vector<Drawing> d;
    d.push_back(
        {"truth.png", "The field",
         "The truth, which the UAV does not know. In all pictures, lines bound what truly lies above the threshold.",
         draw(viridis, low, high, truth_.values()), values});
    d.push_back({"map.png", "The map", "Mean of each cell, and the cells' borders: large where little matters.",
                 draw(viridis, low, high, map_.mean_raster, Overlay::cells), values});
    if (map_.decompressed.size() != 0)
      d.push_back({"decompressed.png", "Decompressed",
                   "What the map says at a higher resolution, by the correlation of its cells.",
                   draw(viridis, low, high, map_.decompressed), values});
    d.push_back({"path.png", "The flight", "A dot is a measurement, the large dot the start.",
                 draw(viridis, low, high, truth_.values(), Overlay::path), values});
    const Image<double> error = map_.mean_raster - truth_.values();
    const double unsure = quantile(map_.deviation_raster, 0.98), wrong = quantile(error.abs(), 0.98);
    d.push_back({"uncertainty.png",
                 "Uncertainty",
                 "Standard deviation that the map states. The end of the scale stands for the highest 2 %, too.",
                 draw(plum, 0, unsure, map_.deviation_raster),
                 {colours_of(plum), 0, unsure, unit}});
    d.push_back(
        {"error.png",
         "Error",
         "Map minus truth: red is too high, blue too low. The ends of the scale stand for the largest 2 %, too.",
         draw(blue_white_red, -wrong, wrong, error),
         {colours_of(blue_white_red), -wrong, wrong, unit}});
    return d;
  }

 private:
  enum class Overlay { none, cells, path };

  /// The pixel of a raster over the whole area that holds p.
  [[nodiscard]] double at(const Image<double>& raster, const Eigen::Vector2d& p) const {
    const Eigen::Vector2d t = (p - truth_.area().min()).cwiseQuotient(truth_.area().sizes());
    return raster(std::min(static_cast<Eigen::Index>(t.y() * static_cast<double>(raster.rows())), raster.rows() - 1),
                  std::min(static_cast<Eigen::Index>(t.x() * static_cast<double>(raster.cols())), raster.cols() - 1));
  }
  [[nodiscard]] Picture draw(Palette palette, double low, double high, const Image<double>& raster,
                             Overlay overlay = Overlay::none) const {
    Canvas canvas(truth_.area(), 800);
    canvas.fill([&](const Eigen::Vector2d& p) {
      return palette(std::isnan(truth_.at(p)) ? truth_.at(p) : (at(raster, p) - low) / (high - low));
    });
    if (overlay == Overlay::cells)
      for (const Box2& cell : map_.cell)
        if (canvas.px_per_m() * cell.sizes().minCoeff() >= 6) canvas.rectangle(cell, 0.7, {255, 255, 255}, 0.22);
    canvas.outline([&](const Eigen::Vector2d& p) { return truth_.at(p) > threshold_; }, {20, 20, 20}, 0.85);
    if (overlay == Overlay::path) draw_path(canvas);
    return canvas.picture();
  }
  void draw_path(Canvas& canvas) const {
    const auto spot = [&](std::size_t k) -> Eigen::Vector2d { return path_[k].position().head<2>(); };
    for (std::size_t k = 1; k < path_.size(); ++k) canvas.line(spot(k - 1), spot(k), 4.5, {20, 20, 20}, 0.45);
    for (std::size_t k = 1; k < path_.size(); ++k) canvas.line(spot(k - 1), spot(k), 2.2, {255, 255, 255});
    for (std::size_t k = 1; k < path_.size(); ++k) {
      canvas.dot(spot(k), 4.6, {255, 255, 255});
      canvas.dot(spot(k), 3.0, {190, 30, 45});
    }
    if (path_.empty()) return;
    canvas.dot(spot(0), 9, {255, 255, 255});
    canvas.dot(spot(0), 6, {20, 20, 20});
  }
  /// Of what is not masked; never 0, so that a scale has an extent.
  [[nodiscard]] double quantile(const Image<double>& image, double share) const {
    std::vector<double> v;
    for (Eigen::Index k = 0; k < image.size(); ++k)  // both are row-major
      if (!std::isnan(truth_.values().data()[k])) v.push_back(image.data()[k]);
    const auto place = v.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(v.size() - 1));
    std::nth_element(v.begin(), place, v.end());
    return *place > 0 ? *place : 1.0;
  }

  const Snapshot& map_;
  const ScalarField& truth_;
  double threshold_;
  const std::vector<View>& path_;
};

/// The map for other programs: one line a cell, and rasters for numpy.
void write_map(const std::filesystem::path& out, const Snapshot& map) {
  std::string csv = "x_min_m,y_min_m,x_max_m,y_max_m,mean,deviation\n";
  char line[256];
  for (std::size_t i = 0; i < map.cell.size(); ++i) {
    const Box2& b = map.cell[i];
    std::snprintf(line, sizeof line, "%.10g,%.10g,%.10g,%.10g,%.17g,%.17g\n", b.min().x(), b.min().y(), b.max().x(),
                  b.max().y(), map.mean[i], map.deviation[i]);
    csv += line;
  }
  write_file(out / "cells.csv", csv);
  write_npy(out / "mean.npy", map.mean_raster);
  write_npy(out / "deviation.npy", map.deviation_raster);
}

double tenths(double x) { return std::round(10 * x) / 10; }

std::vector<KeyFigure> key_figures(const MissionRecord& record, const Input& input) {
  const StepRecord& last = record.steps.back();
  const std::string& unit = input.truth.quantity().unit;
  const auto share = [&](const char* metric) {
    const double x = last.metric(metric);
    return std::isnan(x) ? "there are none" : short_number(tenths(100 * x / input.truth.range())) + " % of the range";
  };
  return {
      {"RMSE", short_number(last.metric("rmse")), unit, share("rmse")},
      {"RMSE in hotspots", short_number(last.metric("rmse_hotspots")), unit, share("rmse_hotspots")},
      {"IoU of hotspots", short_number(tenths(100 * last.metric("iou"))), "%", "in map and truth / in either"},
      {"Cells", short_number(last.metric("cells")), "", "from " + short_number(record.steps.front().metric("cells"))},
      {"Measurements", short_number(static_cast<double>(last.index)), "",
       short_number(tenths(last.travelled_m)) + " m flown"},
      {"Mission time", short_number(tenths(last.elapsed_s)), "s", "planning, mapping, flight"}};
}

}  // namespace

void write_results(const Options& o, const Input& input, const Snapshot& map, double threshold,
                   const MissionRecord& record) {
  write_map(o.out, map);
  const ScalarField& truth = input.truth;
  const Quantity& q = truth.quantity();
  Report report{.title = "Field mission: " + words(input.name)};
  report.lead =
      concat("A UAV maps ", words(q.name), " (", short_number(truth.minimum()), " to ", short_number(truth.maximum()),
             q.unit.empty() ? "" : " ", q.unit, ") over ", short_number(tenths(truth.area().sizes().x())), " m x ",
             short_number(tenths(truth.area().sizes().y())), " m; what lies above ", short_number(threshold),
             q.unit.empty() ? "" : " ", q.unit, " matters. Method ", o.method, ", at most ", o.cells_a_side(), " x ",
             o.cells_a_side(), " cells. ", input.note);
  report.figures = key_figures(record, input);

  std::vector<View> path;
  for (const StepRecord& r : record.steps) path.push_back(r.view);
  for (Drawing& d : Artist(map, truth, threshold, path).all()) {
    std::vector<std::byte> png = encode_png(d.picture);
    write_file(o.out / d.file, png);
    report.pictures.push_back({d.title, d.caption, std::move(png), d.scale});
  }
  report.plots.push_back(metric_plot(record, "Error", q.unit, {"rmse", "rmse_hotspots"}));
  report.plots.push_back(metric_plot(record, "Intersection over union of hotspots", "", {"iou"}));
  report.plots.back().y_least_top = 1;
  report.plots.push_back(metric_plot(record, "Cells of the map", "", {"cells"}));
  Curve height{.name = "height", .x = {}, .y = {}};
  for (const StepRecord& r : record.steps) {
    height.x.push_back(r.elapsed_s);
    height.y.push_back(r.view.position().z());
  }
  report.plots.push_back({.title = "Flight height", .x_label = "mission time [s]", .y_label = "m", .curves = {height}});
  for (const std::string& word : o.command) report.command += (report.command.empty() ? "" : " ") + word;
  write_file(o.out / "report.html", report_html(report, record));
}

}  // namespace field
