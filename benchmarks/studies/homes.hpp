// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "scene/input.hpp"

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

}  // namespace study
