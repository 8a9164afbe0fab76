// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "table.hpp"

// The claims of section 3.2.1, as tests on the figures of one map size: ours, and those that the thesis prints.
namespace study {

/// The mean over the fields of a metric (rmse, rmse_hotspots, iou, mapping_ms, memory_percent, cells) of a method; NaN
/// if it was not measured.
using Figures = std::function<double(std::string_view method, std::string_view metric)>;

struct Tested {
  std::string text;
  std::optional<bool> met;  ///< none if a figure is missing
  std::string numbers;
};

namespace detail {

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  [[nodiscard]] bool known() const { return !std::isnan(low); }
  [[nodiscard]] std::string text() const {
    const auto brief = [](double x) {
      return x == 0 || std::abs(x) >= 1 ? decimals(x, three_digits(std::abs(x))) : decimals(x, 4);
    };
    return low == high || !known() ? brief(low) : brief(low) + " to " + brief(high);
  }
};

inline Range range(const Figures& f, const std::vector<std::string_view>& methods, std::string_view metric) {
  Range r;
  for (const std::string_view m : methods) {
    const double x = f(m, metric);
    if (std::isnan(x)) return {nan, nan};
    r.low = std::min(r.low, x);
    r.high = std::max(r.high, x);
  }
  return r;
}

}  // namespace detail

inline std::vector<Tested> test_claims(const Figures& f) {
  using List = std::vector<std::string_view>;
  const List independent = {"fr_idp", "ar_idp"}, gaussian = {"ar_bcm", "ar_gpr_ik", "fr_gpf", "ours"};
  std::vector<Tested> tested;
  // "all of `more` above all of `less`"
  const auto above = [&](std::string text, const List& more, const List& less, std::string_view metric,
                         const std::string& more_name, const std::string& less_name) {
    const detail::Range a = detail::range(f, more, metric), b = detail::range(f, less, metric);
    tested.push_back({std::move(text), a.known() && b.known() ? std::optional(a.low > b.high) : std::nullopt,
                      more_name + " " + a.text() + ", " + less_name + " " + b.text()});
  };
  const auto within = [&](std::string text, const List& methods, std::string_view metric, auto&& spread, double most,
                          std::string_view what) {
    const detail::Range r = detail::range(f, methods, metric);
    tested.push_back({std::move(text), r.known() ? std::optional(spread(r) <= most) : std::nullopt,
                      r.text() + ", " + std::string(what) + " " + decimals(spread(r), 3)});
  };
  const auto ratio = [](const detail::Range& r) { return r.high / r.low; };
  const auto distance = [](const detail::Range& r) { return r.high - r.low; };

  above("Assuming independent cells (FR-IDP, AR-IDP) yields the highest RMSE of all", independent, gaussian, "rmse",
        "IDP", "GP");
  above("Assuming independent cells yields the highest RMSE in hotspots", independent, gaussian, "rmse_hotspots", "IDP",
        "GP");
  above("Assuming independent cells yields the lowest IoU", gaussian, independent, "iou", "GP", "IDP");
  above("Merging costs the adaptive GP approaches total RMSE, against FR-GPF", {"ar_bcm", "ar_gpr_ik", "ours"},
        {"fr_gpf"}, "rmse", "adaptive", "FR-GPF");
  within("All GP approaches are comparably accurate in hotspots (here: RMSE within 10 %)", gaussian, "rmse_hotspots",
         ratio, 1.1, "ratio");
  within("All GP approaches have similar IoU (here: within 0.01)", gaussian, "iou", distance, 0.01, "distance");
  above("AR-BCM is the slowest of all [ms]", {"ar_bcm"}, {"fr_idp", "ar_idp", "ar_gpr_ik", "fr_gpf", "ours"},
        "mapping_ms", "AR-BCM", "others");
  above("AR-GPR-IK is slower than both fusions, FR-GPF and Ours [ms]", {"ar_gpr_ik"}, {"fr_gpf", "ours"}, "mapping_ms",
        "AR-GPR-IK", "fusions");
  above("AR-IDP is slower than FR-IDP [ms]", {"ar_idp"}, {"fr_idp"}, "mapping_ms", "AR-IDP", "FR-IDP");
  above("Ours has the fastest updates of the GP approaches [ms]", {"ar_bcm", "ar_gpr_ik", "fr_gpf"}, {"ours"},
        "mapping_ms", "others", "Ours");
  above("FR-GPF takes the most memory [% of FR-GPF]", {"fr_gpf"}, {"fr_idp", "ar_idp", "ar_bcm", "ar_gpr_ik", "ours"},
        "memory_percent", "FR-GPF", "others");
  above("Ours compresses best of the GP approaches [% of FR-GPF]", {"ar_bcm", "ar_gpr_ik", "fr_gpf"}, {"ours"},
        "memory_percent", "others", "Ours");
  above("AR-IDP merges worst of the adaptive approaches [cells]", {"ar_idp"}, {"ar_bcm", "ar_gpr_ik", "ours"}, "cells",
        "AR-IDP", "others");
  above("Ours is more accurate in hotspots than FR-IDP and AR-IDP", independent, {"ours"}, "rmse_hotspots", "IDP",
        "Ours");
  above("Ours has a higher IoU than FR-IDP and AR-IDP", {"ours"}, independent, "iou", "Ours", "IDP");
  return tested;
}

}  // namespace study
