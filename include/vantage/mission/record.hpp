// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/io/json.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/version.hpp>

// What a mission was: filled by a Recorder, written as mission.json, told by a report.
namespace vantage {

/// One number about a map, such as `rmse`; NaN where it means nothing (null in JSON).
struct Metric {
  std::string name;
  double value = 0;
};

/// One measurement of a mission and the map after it.
struct StepRecord {
  std::uint64_t index = 0;  ///< measurements so far; 0 = the prior
  View view = {};           ///< chosen (of the prior: where the robot starts)
  bool planned = false;
  double utility = std::numeric_limits<double>::quiet_NaN(), best_utility = utility;
  std::uint64_t candidates = 0;
  double planning_s = 0, mapping_s = 0, action_s = 0;  ///< of this step, by the mission's clock
  double elapsed_s = 0, travelled_m = 0;               ///< since the mission began
  std::vector<Metric> metrics = {};

  [[nodiscard]] double metric(std::string_view name) const {
    for (const Metric& m : metrics)
      if (m.name == name) return m.value;
    return std::numeric_limits<double>::quiet_NaN();
  }
  void save(Sink& sink) const {
    sink.put(index);
    view.save(sink);
    sink.put(planned);
    for (const double x : {utility, best_utility, planning_s, mapping_s, action_s, elapsed_s, travelled_m}) sink.put(x);
    sink.put(candidates);
    sink.put(static_cast<std::uint64_t>(metrics.size()));
    for (const Metric& m : metrics) {
      sink.put(m.name);
      sink.put(m.value);
    }
  }
  void load(Source& source) {
    StepRecord r;
    source.get(r.index);
    r.view.load(source);
    r.planned = source.get<std::uint8_t>() != 0;
    for (double* x :
         {&r.utility, &r.best_utility, &r.planning_s, &r.mapping_s, &r.action_s, &r.elapsed_s, &r.travelled_m})
      source.get(*x);
    source.get(r.candidates);
    const auto n = source.get<std::uint64_t>();
    if (n > source.left() / 16)
      throw Error(source.where(), concat(n, " metrics"), "no more than the bytes that are left hold");
    r.metrics.resize(static_cast<std::size_t>(n));
    for (Metric& m : r.metrics) {
      source.get(m.name);
      source.get(m.value);
    }
    *this = std::move(r);
  }
};

/// A whole mission. `config` must determine it together with the seed; what cannot change the result (threads, output
/// folder) does not belong there.
struct MissionRecord {
  nlohmann::ordered_json config = nlohmann::ordered_json::object();
  std::uint64_t seed = 0;
  std::vector<StepRecord> steps = {};
  std::optional<StopReason> reason = {};  ///< none while it runs
};

/// "stop_rule", "nothing_to_do" or "world_ended", as mission.json says it.
inline std::string_view name_of(StopReason reason) {
  switch (reason) {
    case StopReason::stop_rule:
      return "stop_rule";
    case StopReason::nothing_to_do:
      return "nothing_to_do";
    case StopReason::world_ended:
      return "world_ended";
  }
  return "unknown";
}

/// The compiler that made this program: "g++ 12.2.0".
inline std::string compiler_version() {
#if defined(__clang__)
  return concat("clang ", __clang_major__, ".", __clang_minor__, ".", __clang_patchlevel__);
#else
  return concat("g++ ", __GNUC__, ".", __GNUC_MINOR__, ".", __GNUC_PATCHLEVEL__);
#endif
}

/// Libraries and compiler, by name.
inline nlohmann::ordered_json versions() {
  return {{"vantage", VANTAGE_VERSION},
          {"compiler", compiler_version()},
          {"eigen", concat(EIGEN_WORLD_VERSION, ".", EIGEN_MAJOR_VERSION, ".", EIGEN_MINOR_VERSION)}};
}

/// One element of `steps` in mission.json. A view is its position [m], where it looks (forward) and the image's up.
inline nlohmann::ordered_json to_json(const StepRecord& r) {
  const auto xyz = [](const Eigen::Vector3d& v) {
    return nlohmann::ordered_json::array({v.x() + 0.0, v.y() + 0.0, v.z() + 0.0});  // + 0.0: never "-0.0"
  };
  nlohmann::ordered_json metrics = nlohmann::ordered_json::object();
  for (const Metric& m : r.metrics) {
    if (m.value == std::floor(m.value) && std::abs(m.value) < 1e15)
      metrics[m.name] = static_cast<std::int64_t>(m.value);  // a count
    else
      metrics[m.name] = m.value;
  }
  return {{"step", r.index},
          {"view",
           {{"position", xyz(r.view.position())},
            {"forward", xyz(r.view.forward())},
            {"up", xyz(-r.view.T_W_C.linear().col(1))}}},
          {"planned", r.planned},
          {"utility", r.utility},
          {"best_utility", r.best_utility},
          {"candidates", r.candidates},
          {"planning_s", r.planning_s},
          {"mapping_s", r.mapping_s},
          {"action_s", r.action_s},
          {"elapsed_s", r.elapsed_s},
          {"travelled_m", r.travelled_m},
          {"metrics", metrics}};
}

/// mission.json: valid JSON (names that are no UTF-8: see json_text), one line a step, numbers so that they read back
/// as the same double.
inline std::string mission_json(const MissionRecord& record) {
  using Json = nlohmann::ordered_json;
  std::string text = "{\n  \"config\": " + json_text(record.config) + ",\n  \"seed\": " + std::to_string(record.seed) +
                     ",\n  \"versions\": " + json_text(versions()) +
                     ",\n  \"stop_reason\": " + json_text(record.reason ? Json(name_of(*record.reason)) : Json()) +
                     ",\n  \"steps\": [";
  for (std::size_t i = 0; i < record.steps.size(); ++i)
    text += (i == 0 ? "\n    " : ",\n    ") + json_text(to_json(record.steps[i]));
  return text + "\n  ]\n}\n";
}

}  // namespace vantage
