// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "method_names.hpp"
#include "statistics.hpp"
#include "table.hpp"

// The claims of section 3.2.3, as tests on missions.
namespace study {

/// A figure of a method's missions, one value a field; empty if they were not flown.
using PerField = std::function<std::vector<double>(std::string_view method, std::string_view figure)>;
/// A metric's mean over the fields, one value for each time of the grid.
using OverTime = std::function<std::vector<double>(std::string_view method, std::string_view metric)>;

inline std::vector<Claim> test_planning_claims(const PerField& figure, const OverTime& curve,
                                               std::span<const double> grid) {
  std::vector<Claim> claims;
  // `better` (sign +1: more is better) than every one of `others`, on average over the fields.
  const auto better = [&](std::string text, std::string_view method, const std::vector<std::string_view>& others,
                          std::string_view name, int sign, int digits) {
    Claim c{.text = std::move(text), .scope = {}, .met = true, .numbers = {}};
    for (const std::string_view other : others) {
      std::vector<double> a = figure(method, name), b = figure(other, name);
      if (a.empty() || a.size() != b.size()) {
        c.met = std::nullopt;
        c.numbers = "not all were flown";
        break;
      }
      for (std::size_t i = 0; i < a.size(); ++i)  // only fields that both have a figure for
        if (std::isnan(a[i]) || std::isnan(b[i])) a[i] = b[i] = nan;
      const Summary d = difference(a, b);
      if (std::isnan(d.mean)) {  // such as no low view at all
        c.met = std::nullopt;
        c.numbers = "nothing to compare";
        break;
      }
      c.met = *c.met && sign * d.mean > 0;
      c.numbers += std::string(c.numbers.empty() ? "" : "; ") + std::string(method_info(method).label) + " " +
                   decimals(Summary::of(a).mean, digits) + " - " + std::string(method_info(other).label) + " " +
                   decimals(Summary::of(b).mean, digits) + " = " + with_deviation(d.mean, d.standard_error(), digits);
    }
    claims.push_back(std::move(c));
  };
  // Best of all at so many times of the grid; the first minute, in which all maps are little more than the prior,
  // aside.
  const auto consistently = [&](std::string text, std::string_view metric, int sign) {
    Claim c{.text = std::move(text), .scope = {}, .met = std::nullopt, .numbers = "not all were flown"};
    const std::vector<double> ours = curve("ours", metric);
    std::size_t times = 0, best = 0;
    bool known = !ours.empty();
    for (std::size_t i = 0; known && i < grid.size(); ++i) {
      if (grid[i] < 60) continue;
      bool is_best = true;
      for (const std::string_view other : {"fr_gpf", "fr_idp", "ar_idp"}) {
        const std::vector<double> o = curve(other, metric);
        known = known && !o.empty();
        is_best = is_best && known && sign * (ours[i] - o[i]) >= 0;
      }
      ++times;
      best += is_best;
    }
    if (known && times > 0) {
      const double share = static_cast<double>(best) / static_cast<double>(times);
      c.met = share >= 0.9;
      c.numbers = decimals(100 * share, 0) + " % of the times from 60 s on";
    }
    claims.push_back(std::move(c));
  };

  better("Ours has the lowest RMSE in hotspots, averaged over the mission", "ours", {"fr_gpf", "fr_idp", "ar_idp"},
         "rmse_hotspots_average", -1, 4);
  better("Ours has the lowest RMSE in hotspots at the end of the mission", "ours", {"fr_gpf", "fr_idp", "ar_idp"},
         "rmse_hotspots_end", -1, 4);
  better("Ours has the highest IoU, averaged over the mission", "ours", {"fr_gpf", "fr_idp", "ar_idp"}, "iou_average",
         +1, 4);
  better("Ours has the highest IoU at the end of the mission", "ours", {"fr_gpf", "fr_idp", "ar_idp"}, "iou_end", +1,
         4);
  consistently("Ours is best consistently: in RMSE in hotspots at 90 % of all times", "rmse_hotspots", -1);
  consistently("Ours is best consistently: in IoU at 90 % of all times", "iou", +1);
  better("Ours spends less time planning than FR-GPF [s]", "ours", {"fr_gpf"}, "planning_s", -1, 2);
  better("FR-IDP ends less accurate in hotspots than both GP fusions", "fr_idp", {"fr_gpf", "ours"},
         "rmse_hotspots_end", +1, 4);
  better("AR-IDP ends less accurate in hotspots than both GP fusions", "ar_idp", {"fr_gpf", "ours"},
         "rmse_hotspots_end", +1, 4);
  better("FR-IDP plans faster than Ours [s]", "fr_idp", {"ours"}, "planning_s", -1, 2);
  better(
      "FR-IDP is misled to look closely at what does not matter: more of its low views than of Ours see no hotspot "
      "(share)",
      "fr_idp", {"ours"}, "wasted_share", +1, 3);
  better("AR-IDP is misled in the same way (share)", "ar_idp", {"ours"}, "wasted_share", +1, 3);
  return claims;
}

}  // namespace study
