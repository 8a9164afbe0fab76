// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <vantage/mission/record.hpp>

#include "album.hpp"
#include "referee.hpp"

namespace scene {

/// The report of an exploration: the map from above with the way, how it grew, the mesh, the views.
void write_exploration(const Options& o, const Input& input, const Referee& referee, const Album& album,
                       const MissionRecord& record);

}  // namespace scene
