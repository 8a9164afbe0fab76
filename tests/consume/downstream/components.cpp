// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT

// What the optional components bring along can be included.
#include <CLI/CLI.hpp>
#include <libqhull_r/qhull_ra.h>
#include <nlohmann/json.hpp>
#include <png.h>

int main() {}
