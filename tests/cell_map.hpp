// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

#include <vantage/concepts/map.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/field_image.hpp>

namespace vantage::test {

/// A finished field map: cells with their beliefs, learnt elsewhere.
struct CellMap {
  struct Cell {
    Box2 box;
    double mean = 0, variance = 0;
  };
  std::vector<Cell> cells;

  using Measurement = FieldImage;
  void integrate(const FieldImage&, Rng&) { throw Error("CellMap", "learns nothing"); }
  [[nodiscard]] Box3 bounds() const {
    Box3 b;
    for (const Cell& c : cells)
      for (const Eigen::Vector2d& p : {c.box.min(), c.box.max()}) b.extend(Eigen::Vector3d(p.x(), p.y(), 0));
    return b;
  }
  [[nodiscard]] std::size_t size() const { return cells.size(); }
  [[nodiscard]] Box2 cell(std::size_t i) const { return cells[i].box; }
  [[nodiscard]] double mean(std::size_t i) const { return cells[i].mean; }
  [[nodiscard]] double variance(std::size_t i) const { return cells[i].variance; }
  [[nodiscard]] std::size_t cell_at(const Eigen::Vector2d& p) const {
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (cells[i].box.contains(p)) return i;
    throw Error("CellMap::cell_at", "the point is outside");
  }
};
static_assert(FieldMap<CellMap>);

}  // namespace vantage::test
