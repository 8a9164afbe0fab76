// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <string>
#include <system_error>
#include <vector>

#include <vantage/core/error.hpp>

#include "scene/missions.hpp"
#include "study_options.hpp"
#include "units.hpp"

namespace study {

/// Every home that examples/data/fetch_scenes got.
inline std::vector<std::filesystem::path> fetched_scenes() {
  const std::filesystem::path folder = scene::default_scene().parent_path();
  std::vector<std::filesystem::path> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none))
    if (std::filesystem::exists(entry.path() / "scene.json")) found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

/// The home of that name.
inline std::filesystem::path home_named(const std::string& name, const std::vector<std::filesystem::path>& homes) {
  for (const std::filesystem::path& home : homes)
    if (scene::title_of(home) == name) return home;
  throw vantage::Error("--scenes", "no home is called " + name);
}

/// Flies a mission, in silence; its report stays in a folder of the unit's name.
inline scene::Mission fly(const Options& o, const Unit& unit, scene::Options mission) {
  mission.out = o.out / "missions" / unit.name;
  mission.keep_views = false;
  vantage::make_folder(mission.out);
  std::ostream silent(nullptr);
  scene::Mission flown = scene::fly_mission(mission, scene::load(mission), silent);
  std::filesystem::remove(mission.out / "mission.checkpoint");
  return flown;
}

}  // namespace study
