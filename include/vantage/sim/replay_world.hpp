// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

struct ReplayConfig {
  std::uint32_t uses = 1;     ///< how often each frame is given; 0: as often as asked
  double metres_per_rad = 1;  ///< how far apart views are that differ by 1 rad of orientation only; finite, >= 0
  double most_apart_m = std::numeric_limits<double>::infinity();  ///< farther frames are not given; >= 0
};

/// A recording, or any other set of posed pictures, as a World: a view that is asked for is answered by the recorded
/// frame nearest to it, which tells where it was really taken. `views()` gives a Pool that proposes exactly what was
/// recorded (the data-set experiments of chapter 4). Not shared between threads.
class ReplayWorld {
 public:
  /// `views` lists where frames were taken; `frame(i)` makes or reads the i-th, whose view is views[i]. Throws Error if
  /// there is no view, or a view or the configuration is bad.
  ReplayWorld(std::vector<View> views, std::function<Frame(std::size_t)> frame, const ReplayConfig& config = {})
      : views_(std::move(views)), frame_(std::move(frame)), config_(config), used_(views_.size(), 0) {
    Check check("ReplayConfig");
    check.not_negative("metres_per_rad", config_.metres_per_rad);
    check(config_.most_apart_m >= 0, "most_apart_m", config_.most_apart_m, ">= 0");
    check.done();
    if (views_.empty()) throw Error("ReplayWorld", "there is no frame", "at least one");
    for (std::size_t i = 0; i < views_.size(); ++i) check_view(views_[i], concat("ReplayWorld (view ", i, ")"));
  }

  [[nodiscard]] const std::vector<View>& views() const { return views_; }
  /// How many frames may still be given.
  [[nodiscard]] std::size_t left() const {
    return static_cast<std::size_t>(std::count_if(used_.begin(), used_.end(), [&](auto n) { return fresh(n); }));
  }

  /// The frame nearest to `view`; of equals the first. None if all have been given, or the nearest is too far. Throws
  /// Error for a view that is not rigid, and what reading the frame throws; the world is then unchanged. O(frames).
  std::optional<Frame> observe(const View& view) {
    check_view(view, "ReplayWorld::observe");
    std::optional<std::size_t> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < views_.size(); ++i)
      if (const double d = apart_m(view, views_[i]); fresh(used_[i]) && d <= config_.most_apart_m && d < least) {
        nearest = i;
        least = d;
      }
    if (!nearest) return std::nullopt;
    Frame frame = frame_(*nearest);
    if (config_.uses != 0) ++used_[*nearest];
    return frame;
  }

  void save(Sink& sink) const {
    sink.put(hash());
    sink.put(used_);
  }
  /// Throws Error if it was saved over other views; the world is then unchanged.
  void load(Source& source) {
    if (source.get<std::uint64_t>() != hash())
      throw Error(source.where(), "the world was saved over another recording", "the recording of this mission");
    std::vector<std::uint32_t> used;
    source.get(used);
    if (used.size() != used_.size() ||
        std::any_of(used.begin(), used.end(), [&](std::uint32_t n) { return n > config_.uses; }))
      throw Error(source.where(), "frames were given that this world cannot have given", "the world that was saved");
    used_ = std::move(used);
  }

 private:
  [[nodiscard]] bool fresh(std::uint32_t used) const { return config_.uses == 0 || used < config_.uses; }
  [[nodiscard]] double apart_m(const View& a, const View& b) const {
    const double turn_rad = Eigen::AngleAxisd(a.T_W_C.linear().transpose() * b.T_W_C.linear()).angle();
    return distance_m(a, b) + config_.metres_per_rad * turn_rad;
  }
  [[nodiscard]] std::uint64_t hash() const {
    Sink sink;
    for (const View& v : views_) v.save(sink);
    return fnv1a(sink.bytes());
  }

  std::vector<View> views_;
  std::function<Frame(std::size_t)> frame_;
  ReplayConfig config_;
  std::vector<std::uint32_t> used_;
};

}  // namespace vantage
