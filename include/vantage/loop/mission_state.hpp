// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// Where a mission stands, besides what its policies, its clock and its world remember: with those, all that it needs
/// to go on after a crash.
struct MissionState {
  View here;
  Rng rng;                         ///< never advanced: step k draws from its forks, so that k says it all
  std::vector<View> visited = {};  ///< every view measured so far, oldest first
  double travelled_m = 0;

  void save(Sink& sink) const {
    here.save(sink);
    for (const std::uint64_t word : rng.state()) sink.put(word);
    save_views(sink, visited);
    sink.put(travelled_m);
  }
  void load(Source& source) {
    MissionState s;
    s.here.load(source);
    const auto key = source.get<std::uint64_t>(), counter = source.get<std::uint64_t>();
    s.rng = Rng::restored({key, counter});
    s.visited = load_views(source);
    s.travelled_m = source.get<double>();
    *this = std::move(s);
  }
};

}  // namespace vantage
