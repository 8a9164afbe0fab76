// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/eval/field_metrics.hpp>
#include <vantage/io/npy.hpp>
#include <vantage/maps/field/decompress.hpp>
#include <vantage/mission/canvas.hpp>
#include <vantage/mission/palette.hpp>
#include <vantage/mission/report.hpp>

#include "input.hpp"

// What a person looks at when the mission is over: pictures, the map in common formats, the page.
namespace field {

/// Whether a map's belief says how its cells, which stand for averages, covary.
template <class M>
inline constexpr bool decompressible = false;
template <class Kernel, class Belief, class Resolution, class Sensor>
inline constexpr bool decompressible<IntegralGp<Kernel, CellAverage, Belief, Resolution, Sensor>> =
    requires(const Belief b, const NdTree& tree) { b.covariance_matrix(tree); } || requires(const Belief b, std::size_t i) { b.covariance(i, i); };

/// A picture and how to read it.
struct Drawing {
  std::string file, title, caption;
  Picture picture;
  ColourScale scale;
};

/// Draws truth, map, uncertainty and error, all in the same place and at the same size.
template <FieldMap M, class Interest>
class Artist {
 public:
  Artist(const M& map, const Input& input, const Interest& interest, const std::vector<View>& path)
      : map_(map), input_(input), interest_(interest), path_(path) {}

  [[nodiscard]] std::vector<Drawing> all() const {
    const std::string& unit = truth().quantity().unit;
    const double low = truth().minimum(), high = std::max(truth().maximum(), low + 1e-12);
    const ColourScale values{colours_of(viridis), low, high, unit};
    const auto deviation = [&](std::size_t i) { return std::sqrt(std::max(0.0, map_.variance(i))); };
    const auto error_at = [&](const Eigen::Vector2d& p) { return map_.mean(map_.cell_at(p)) - truth().at(p); };

    std::vector<Drawing> d;
    d.push_back({"truth.png", "The field", "The truth, which the UAV does not know. Lines bound what lies above the threshold, in all pictures.",
                 draw(viridis, low, high, [&](const Eigen::Vector2d& p) { return truth().at(p); }), values});
    d.push_back({"map.png", "The map", "Mean of each cell, and the cells' borders: large where little matters.",
                 draw(viridis, low, high, of_cell([&](std::size_t i) { return map_.mean(i); }), Overlay::cells), values});
    if constexpr (decompressible<M>)
      if (map_.size() <= 2048)  // its cost grows with the cube of the cells
        d.push_back({"decompressed.png", "Decompressed", "What the map says at a higher resolution, through the correlation of its cells.", draw_decompressed(low, high), values});
    d.push_back({"path.png", "The flight", "Views over the field: a dot is a measurement, the large dot the start.",
                 draw(viridis, low, high, [&](const Eigen::Vector2d& p) { return truth().at(p); }, Overlay::path), values});
    const double unsure = quantile(raster(deviation), 0.98), wrong = quantile((raster([&](std::size_t i) { return map_.mean(i); }) - truth().values()).abs(), 0.98);
    d.push_back({"uncertainty.png", "Uncertainty", "Standard deviation that the map states; the brightest colour is for the highest 2 % too.",
                 draw(plum, 0, unsure, of_cell(deviation)), {colours_of(plum), 0, unsure, unit}});
    d.push_back({"error.png", "Error", "Map minus truth: red is too high, blue too low; the extreme colours are for the largest 2 % too.",
                 draw(blue_white_red, -wrong, wrong, error_at), {colours_of(blue_white_red), -wrong, wrong, unit}});
    return d;
  }

  /// value(cell) at every pixel of the truth.
  template <class F>
  [[nodiscard]] Image<double> raster(F&& value) const {
    Image<double> image(truth().rows(), truth().columns());
    for (Eigen::Index row = 0; row < image.rows(); ++row)
      for (Eigen::Index column = 0; column < image.cols(); ++column) image(row, column) = value(map_.cell_at(truth().centre(row, column)));
    return image;
  }

 private:
  [[nodiscard]] const ScalarField& truth() const { return input_.truth; }
  template <class F>
  auto of_cell(F value) const {
    return [this, value](const Eigen::Vector2d& p) { return std::isnan(truth().at(p)) ? truth().at(p) : value(map_.cell_at(p)); };
  }
  enum class Overlay { none, cells, path };
  template <class F>
  [[nodiscard]] Picture draw(Palette palette, double low, double high, F&& value, Overlay overlay = Overlay::none) const {
    Canvas canvas(truth().area(), 800);
    canvas.fill([&](const Eigen::Vector2d& p) { return palette((value(p) - low) / (high - low)); });
    if (overlay == Overlay::cells)
      for (std::size_t i = 0; i < map_.size(); ++i)
        if (canvas.px_per_m() * map_.cell(i).sizes().minCoeff() >= 6) canvas.rectangle(map_.cell(i), 0.7, {255, 255, 255}, 0.22);
    canvas.outline([&](const Eigen::Vector2d& p) { return interest_.hot(truth().at(p)); }, {20, 20, 20}, 0.85);
    if (overlay == Overlay::path) draw_path(canvas);
    return canvas.picture();
  }
  [[nodiscard]] Picture draw_decompressed(double low, double high) const
    requires decompressible<M>
  {
    const Eigen::Vector2d side = truth().area().sizes();
    const int columns = std::max(1, static_cast<int>(std::lround(100 * side.x() / side.maxCoeff())));
    const int rows = std::max(1, static_cast<int>(std::lround(100 * side.y() / side.maxCoeff())));
    const std::vector<Box2> boxes = grid_boxes(truth().area(), columns, rows);
    const Decompressed fine = decompress(map_, boxes);
    return draw(viridis, low, high, [&](const Eigen::Vector2d& p) {
      const Eigen::Vector2d t = (p - truth().area().min()).cwiseQuotient(side);
      const int column = std::min(static_cast<int>(t.x() * columns), columns - 1), row = std::min(static_cast<int>(t.y() * rows), rows - 1);
      return std::isnan(truth().at(p)) ? truth().at(p) : fine.mean[row * columns + column];
    });
  }
  /// Of what is not masked; never 0.
  [[nodiscard]] double quantile(const Image<double>& image, double share) const {
    std::vector<double> v;
    for (Eigen::Index k = 0; k < image.size(); ++k)  // both are row-major
      if (!std::isnan(truth().values().data()[k])) v.push_back(image.data()[k]);
    const auto at = v.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(v.size() - 1));
    std::nth_element(v.begin(), at, v.end());
    return *at > 0 ? *at : 1.0;
  }
  void draw_path(Canvas& canvas) const {
    const auto at = [&](std::size_t k) -> Eigen::Vector2d { return path_[k].position().head<2>(); };
    for (std::size_t k = 1; k < path_.size(); ++k) canvas.line(at(k - 1), at(k), 4.5, {20, 20, 20}, 0.45);
    for (std::size_t k = 1; k < path_.size(); ++k) canvas.line(at(k - 1), at(k), 2.2, {255, 255, 255});
    for (std::size_t k = 1; k < path_.size(); ++k) {
      canvas.dot(at(k), 4.6, {255, 255, 255});
      canvas.dot(at(k), 3.0, {190, 30, 45});
    }
    if (!path_.empty()) {
      canvas.dot(at(0), 9, {255, 255, 255});
      canvas.dot(at(0), 6, {20, 20, 20});
    }
  }

  const M& map_;
  const Input& input_;
  const Interest& interest_;
  const std::vector<View>& path_;
};

/// The map for other programs: one line a cell, and rasters for numpy (rows along +y).
template <FieldMap M, class Interest>
void write_map(const std::filesystem::path& out, const M& map, const Artist<M, Interest>& artist) {
  std::string csv = "x_min_m,y_min_m,x_max_m,y_max_m,mean,deviation\n";
  char line[256];
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Box2 b = map.cell(i);
    std::snprintf(line, sizeof line, "%.10g,%.10g,%.10g,%.10g,%.17g,%.17g\n", b.min().x(), b.min().y(), b.max().x(), b.max().y(), map.mean(i),
                  std::sqrt(std::max(0.0, map.variance(i))));
    csv += line;
  }
  write_file(out / "cells.csv", csv);
  write_npy(out / "mean.npy", artist.raster([&](std::size_t i) { return map.mean(i); }));
  write_npy(out / "deviation.npy", artist.raster([&](std::size_t i) { return std::sqrt(std::max(0.0, map.variance(i))); }));
}

/// "volcano elevation" from volcano_elevation.
inline std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

inline std::vector<KeyFigure> key_figures(const MissionRecord& record, const Input& input) {
  const StepRecord& last = record.steps.back();
  const std::string& unit = input.truth.quantity().unit;
  const auto share = [&](const char* metric) { return short_number(std::round(1000 * last.metric(metric) / input.truth.range()) / 10) + " % of the range"; };
  const double iou = last.metric("iou");
  return {{"RMSE", short_number(last.metric("rmse")), unit, share("rmse")},
          {"RMSE, hotspots", short_number(last.metric("rmse_hotspots")), unit, share("rmse_hotspots")},
          {"IoU of hotspots", short_number(std::round(1000 * iou) / 10), "%", "hot in map and truth / in either"},
          {"Cells", short_number(last.metric("cells")), "", "from " + short_number(record.steps.front().metric("cells"))},
          {"Measurements", short_number(static_cast<double>(last.index)), "", short_number(std::round(10 * last.travelled_m) / 10) + " m flown"},
          {"Mission time", short_number(std::round(10 * last.elapsed_s) / 10), "s", "planning, mapping and flight"}};
}

/// Writes pictures, map and page into o.out.
template <FieldMap M, class Interest>
void write_results(const Options& o, const Input& input, const M& map, const Interest& interest, const MissionRecord& record) {
  std::vector<View> path;
  for (const StepRecord& r : record.steps) path.push_back(r.view);
  const Artist<M, Interest> artist(map, input, interest, path);
  write_map(o.out, map, artist);

  const Quantity& q = input.truth.quantity();
  const auto value = [&](double v) { return short_number(v) + (q.unit.empty() ? "" : " " + q.unit); };
  Report report{.title = "Field mission: " + words(input.name)};
  report.lead = concat("A UAV maps ", words(q.name), " (", short_number(input.truth.minimum()), " to ", value(input.truth.maximum()), ") over ",
                       short_number(input.truth.area().sizes().x()), " m x ", short_number(input.truth.area().sizes().y()),
                       " m; what lies above ", value(interest.threshold), " matters. Method ", o.method, ", up to ", o.cells_a_side(), " x ", o.cells_a_side(), " cells. ", input.note);
  report.figures = key_figures(record, input);
  for (Drawing& d : artist.all()) {
    std::vector<std::byte> png = encode_png(d.picture);
    write_file(o.out / d.file, png);
    report.pictures.push_back({d.title, d.caption, std::move(png), d.scale});
  }
  report.plots.push_back(metric_plot(record, "Error", q.unit, {"rmse", "rmse_hotspots"}));
  report.plots.push_back(metric_plot(record, "Intersection over union of hotspots", "", {"iou"}));
  report.plots.back().y_least_top = 1;
  report.plots.push_back(metric_plot(record, "Cells of the map", "", {"cells"}));
  Plot& height = report.plots.emplace_back(Plot{.title = "Flight height", .x_label = "mission time [s]", .y_label = "m", .curves = {{.name = "height", .x = {}, .y = {}}}});
  for (const StepRecord& r : record.steps) {
    height.curves[0].x.push_back(r.elapsed_s);
    height.curves[0].y.push_back(r.view.position().z());
  }
  for (const std::string& word : o.command) report.command += (report.command.empty() ? "" : " ") + word;
  write_file(o.out / "report.html", report_html(report, record));
}

}  // namespace field
