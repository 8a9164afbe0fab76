// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <vantage/geometry/view.hpp>
#include <vantage/planning/heading.hpp>

namespace vantage {

/// Of a polyline [m].
inline double length_m(std::span<const Eigen::Vector3d> points) {
  double sum_m = 0;
  for (std::size_t i = 1; i < points.size(); ++i) sum_m += (points[i] - points[i - 1]).norm();
  return sum_m;
}

/// The views of a robot on its way from one view to another along `points` (two at least, the first and the last are
/// those of the views): on the way its camera is level and looks where the next leg goes, or as before if that goes
/// straight up or down. It flies forward, into what it sees, and turns to the goal's view only once it is there.
inline std::vector<View> views_along(std::span<const Eigen::Vector3d> points, const View& from, const View& goal) {
  std::vector<View> views = {from};
  Eigen::Vector3d ahead = heading(from);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Eigen::Vector3d leg = points[i + 1] - points[i];
    if (leg.head<2>().norm() > 1e-6) ahead = Eigen::Vector3d(leg.x(), leg.y(), 0).normalized();
    views.push_back(look_at(points[i], points[i] + ahead));
  }
  views.push_back(goal);
  return views;
}

}  // namespace vantage
