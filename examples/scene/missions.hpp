// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <nlohmann/json.hpp>

#include "input.hpp"
#include "options.hpp"

namespace scene {

/// All that determines the mission, besides the seed.
nlohmann::ordered_json config(const Options& o, const Input& input);

/// Views from a list are taken one after the other, and no way between them is planned.
void look_around(const Options& o, const Input& input);

}  // namespace scene
