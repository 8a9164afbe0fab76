// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <nlohmann/json.hpp>
#include <ostream>
#include <vector>

#include <vantage/mission/record.hpp>

#include "input.hpp"
#include "options.hpp"

namespace scene {

/// What a reconstruction with surfels was worth at some time of the mission (section 6.2.2).
struct Score {
  double elapsed_s = 0;
  double psnr_db = 0;       ///< mean over test views
  double completeness = 0;  ///< share of the surface within the threshold of the mesh
};

/// A mission that was flown.
struct Mission {
  MissionRecord record;
  std::vector<Score> scores = {};  ///< of surfels, over mission time; the last is that of the end
};

/// All that determines the mission, besides the seed.
nlohmann::ordered_json config(const Options& o, const Input& input);

/// Flies the mission that the options name, shows on `log` how it goes, and leaves pictures, maps and the report in the
/// folder o.out, which must be there.
Mission fly_mission(const Options& o, const Input& input, std::ostream& log);

/// A look-around from the input's views: all that is seen is fused.
Mission look_around(const Options& o, const Input& input, std::ostream& log);

}  // namespace scene
