// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/mission/record.hpp>

#include "input.hpp"
#include "page.hpp"
#include "referee.hpp"

// What is to be seen and told of a flight through a scene, whatever the robot's map is.
namespace scene {

/// The map from above with the way and the views, how it grew, which surface was seen; path.csv: the way, a row a
/// waypoint.
void add_flight(Page& page, const Input& input, const Referee& referee, const MissionRecord& record);
/// NaN or infinity if it never moved.
double least_clearance_m(const MissionRecord& record);

}  // namespace scene
