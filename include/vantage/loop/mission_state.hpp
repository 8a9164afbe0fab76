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
    sink.put(Eigen::Matrix4d(here.T_W_C.matrix()));
    for (const std::uint64_t word : rng.state()) sink.put(word);
    sink.put(static_cast<std::uint64_t>(visited.size()));
    for (const View& v : visited) sink.put(Eigen::Matrix4d(v.T_W_C.matrix()));
    sink.put(travelled_m);
  }
  void load(Source& source) {
    MissionState s;
    const auto view = [&] {
      Eigen::MatrixXd pose;
      source.get(pose);
      if (pose.rows() != 4 || pose.cols() != 4) throw Error(source.where(), "a pose of another size", "4 x 4");
      View v;
      v.T_W_C.matrix() = pose;
      check_view(v, source.where());
      return v;
    };
    s.here = view();
    const auto key = source.get<std::uint64_t>(), counter = source.get<std::uint64_t>();
    s.rng = Rng::restored({key, counter});
    const auto n = source.get<std::uint64_t>();
    if (n > source.left() / sizeof(Eigen::Matrix4d))
      throw Error(source.where(), concat(n, " visited views"), "no more than the bytes that are left hold");
    for (std::uint64_t i = 0; i < n; ++i) s.visited.push_back(view());
    s.travelled_m = source.get<double>();
    *this = std::move(s);
  }
};

}  // namespace vantage
