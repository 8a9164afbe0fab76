// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include <vantage/mission/record.hpp>

#include "input.hpp"
#include "page.hpp"
#include "referee.hpp"

// What is to be seen and told of a flight through a scene, whatever the robot's map is.
namespace scene {

/// The map from above with the way and the views, how it grew, which surface was seen; path.csv: the way, a row a
/// waypoint.
void add_flight(Page& page, const Input& input, const Referee& referee, const MissionRecord& record);
/// How large the robot's body is, and how near it came to a surface.
std::string of_the_body(const Options& o, const MissionRecord& record);

}  // namespace scene
