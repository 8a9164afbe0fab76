// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include <vantage/geometry/view.hpp>

// What a robot that knows nothing may do without moving.
namespace scene {

using namespace vantage;

/// All headings, one field of view apart, at each pitch.
inline std::vector<View> turn_around(const View& start, double field_of_view_rad,
                                     std::initializer_list<double> pitches_rad = {0}) {
  std::vector<View> views;
  const int turns = static_cast<int>(std::ceil(2 * std::numbers::pi / field_of_view_rad - 1e-9));
  const Eigen::Vector3d forward = start.forward();
  const double heading_rad = std::atan2(forward.y(), forward.x());
  for (const double pitch_rad : pitches_rad)
    for (int k = 0; k < turns; ++k) {
      const double yaw_rad = heading_rad + k * 2 * std::numbers::pi / turns;
      const Eigen::Vector3d ahead(std::cos(pitch_rad) * std::cos(yaw_rad), std::cos(pitch_rad) * std::sin(yaw_rad),
                                  std::sin(pitch_rad));
      views.push_back(look_at(start.position(), start.position() + ahead));
    }
  return views;
}
/// Everything around a point: level, up and down, so that no direction but straight up and down is left out.
inline std::vector<View> look_all_around(const View& start, double field_of_view_rad) {
  return turn_around(start, field_of_view_rad, {0, -0.8 * field_of_view_rad, 0.8 * field_of_view_rad});
}

}  // namespace scene
