// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/geometry/scalar_field.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/io/png.hpp>
#include <vantage/mission/canvas.hpp>
#include <vantage/mission/palette.hpp>

// What Fig. 3.4 shows, for every method alike.
namespace study {

using namespace vantage;

/// Errors from here on are drawn in full blue or red, in the field's unit.
inline constexpr double shown_error = 0.3;

/// Pictures in a row, on white.
inline Picture side_by_side(std::span<const Picture> pictures, int gap_px = 12) {
  int width = -gap_px, height = 1;
  for (const Picture& p : pictures) {
    width += p.width() + gap_px;
    height = std::max(height, p.height());
  }
  Picture all(std::max(width, 1), height);
  int left = 0;
  for (const Picture& p : pictures) {
    for (int row = 0; row < p.height(); ++row)
      for (int column = 0; column < p.width(); ++column) all(row, left + column) = p(row, column);
    left += p.width() + gap_px;
  }
  return all;
}

/// Truth with the path, estimate with its cells, and estimate minus truth (blue: too low, red: too high); `estimate(p)`
/// at a point [m].
template <class Interest, class F>
Picture picture_of(const ScalarField& truth, Views path, const Interest& interest, std::span<const Box2> cells,
                   F&& estimate, int side_px = 480) {
  Canvas field(truth.area(), side_px), means(truth.area(), side_px), error(truth.area(), side_px);
  const auto at = [](const View& v) -> Eigen::Vector2d { return v.position().head<2>(); };
  field.fill([&](const Eigen::Vector2d& p) { return viridis(truth.at(p)); });
  for (std::size_t k = 1; k < path.size(); ++k) field.line(at(path[k - 1]), at(path[k]), 2.5, {200, 30, 40});
  for (const View& v : path) field.dot(at(v), 4, {20, 20, 20});
  means.fill([&](const Eigen::Vector2d& p) { return viridis(estimate(p)); });
  for (const Box2& cell : cells) means.rectangle(cell, 0.7, {255, 255, 255}, 0.3);
  error.fill(
      [&](const Eigen::Vector2d& p) { return blue_white_red(0.5 + 0.5 * (estimate(p) - truth.at(p)) / shown_error); });
  for (Canvas* canvas : {&field, &means, &error})
    canvas->outline([&](const Eigen::Vector2d& p) { return interest.hot(truth.at(p)); }, {20, 20, 20}, 0.8);
  const Picture panels[] = {field.picture(), means.picture(), error.picture()};
  return side_by_side(panels);
}

template <FieldMap M>
Picture picture_of(const M& map, const ScalarField& truth, Views path) {
  std::vector<Box2> cells;
  for (std::size_t i = 0; i < map.size(); ++i) cells.push_back(map.cell(i));
  return picture_of(truth, path, map.interest(), cells,
                    [&](const Eigen::Vector2d& p) { return map.mean(map.cell_at(p)); });
}

}  // namespace study
