// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/view.hpp>

// The first views of a robot that knows nothing yet: what it may do without moving.
namespace vantage {

/// All headings from one point, at each pitch (up > 0): as many as a camera of this field of view needs to leave none
/// out, beginning with the start's own heading. Throws Error for a field of view out of (0, pi], or no pose.
inline std::vector<View> turn_around(const View& start, double field_of_view_rad,
                                     std::initializer_list<double> pitches_rad = {0}) {
  check_view(start, "turn_around");
  Check check("turn_around");
  check(field_of_view_rad > 0 && field_of_view_rad <= std::numbers::pi, "field_of_view_rad", field_of_view_rad,
        "in (0, pi]");
  check.done();
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

/// Everything around a point: level, down and up, so that no direction but straight up and down is left out. A robot
/// that flies only where its map knows all space to be free (BallInFreeVoxels) needs it: one view frees no ball.
inline std::vector<View> look_all_around(const View& start, double field_of_view_rad) {
  return turn_around(start, field_of_view_rad, {0, -0.8 * field_of_view_rad, 0.8 * field_of_view_rad});
}

}  // namespace vantage
