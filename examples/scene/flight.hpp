// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <string>

#include <vantage/io/picture.hpp>
#include <vantage/mission/record.hpp>

#include "input.hpp"
#include "referee.hpp"

// What is to be seen and told of a flight through a scene, whatever the robot's map is.
namespace scene {

/// The map from above after a step, with the way flown until then and the views taken.
Picture from_above(const Referee::Growth& growth, const Referee& referee, const MissionRecord& record, int longer_px);
/// Four moments of the mission side by side.
Picture growth_strip(const Referee& referee, const MissionRecord& record);
/// Surface that was seen (grey) and that was not (red), from above.
Picture seen_surface(const Input& input, const Referee& referee);
/// The way as the robot flew it: a row a waypoint.
std::string path_csv(const Referee& referee);
/// NaN or infinity if it never moved.
double least_clearance_m(const MissionRecord& record);

}  // namespace scene
