// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <vantage/io/file.hpp>
#include <vantage/io/json.hpp>
#include <vantage/mission/record.hpp>

namespace vantage {

struct RecorderConfig {
  std::filesystem::path file = {};  ///< mission.json; empty: keep the record in memory only
  nlohmann::ordered_json config = nlohmann::ordered_json::object();  ///< all that determines the mission, an object
  std::uint64_t seed = 0;
  bool with_prior = true;    ///< steps[0] is the map before the first measurement; else the state after the first views
  double write_every_s = 1;  ///< of real time, >= 0; the last state is always written
};

/// Observer that records a mission and keeps mission.json up to date, whole at any moment.
///
///     Recorder recorder(RecorderConfig{.file = "out/mission.json", .seed = 7},
///                       [&](const auto& map) { return std::vector<Metric>{{"rmse", rmse(map, truth)}}; });
///     loop.run(world, start, first, stop, clock, rng, recorder, checkpoint);
///
/// `metrics(map)` returns what to say about the map, the same names every time; it is not counted as mission time.
/// Persistent: a checkpoint that holds the recorder lets a resumed mission end in the same file, byte for byte (with a
/// modelled clock). Throws Error if the file cannot be written.
template <class Metrics>
class Recorder {
 public:
  Recorder(RecorderConfig config, Metrics metrics)
      : file_(std::move(config.file)),
        with_prior_(config.with_prior),
        write_every_(config.write_every_s),
        metrics_(std::move(metrics)) {
    Check check("RecorderConfig");
    check.not_negative("write_every_s", config.write_every_s);
    check(config.config.is_object(), "config", json_text(config.config), "a JSON object");
    check.done();
    record_.config = std::move(config.config);
    record_.seed = config.seed;
  }

  [[nodiscard]] const MissionRecord& record() const { return record_; }

  template <class M>
  void started(const M& map, const Situation& q) {
    record_.steps.clear();
    record_.reason.reset();
    if (with_prior_) add(map, q, StepRecord{.view = q.here});
    write();
  }

  template <class M, class Z>
  void measured(const M& map, const Situation& q, const Step<Z>& step) {
    StepRecord r{.index = step.index,
                 .view = step.plan ? step.plan->view : q.here,
                 .planned = step.plan != nullptr,
                 .planning_s = step.planning_s,
                 .mapping_s = step.mapping_s,
                 .action_s = step.action_s};
    if (step.plan) {
      r.utility = step.plan->utility;
      r.best_utility = step.plan->best_utility;
      r.candidates = step.plan->candidates;
    }
    if (!with_prior_ && !r.planned && !record_.steps.empty()) {  // the first views together make steps[0]
      r.mapping_s += record_.steps.front().mapping_s;
      record_.steps.clear();
    }
    add(map, q, std::move(r));
    if (std::chrono::steady_clock::now() - written_ >= write_every_) write();
  }

  template <class M>
  void finished(const M&, const Situation&, StopReason reason) {
    record_.reason = reason;
    write();
  }

  void save(Sink& sink) const {
    sink.put(json_text(record_.config));
    sink.put(record_.seed);
    sink.put(static_cast<std::uint64_t>(record_.steps.size()));
    for (const StepRecord& r : record_.steps) r.save(sink);
  }
  /// Throws Error, naming the options that differ, if the record is another mission's.
  void load(Source& source) {
    std::string config;
    source.get(config);
    const auto seed = source.get<std::uint64_t>();
    if (config != json_text(record_.config))
      throw Error(source.where(), "is of a mission with other options" + differences(config), "the same options");
    if (seed != record_.seed)
      throw Error(source.where(), concat("is of a mission with seed ", seed), concat("seed ", record_.seed));
    const auto n = source.get<std::uint64_t>();
    if (n > source.left() / 128)
      throw Error(source.where(), concat(n, " steps"), "no more than the bytes that are left hold");
    std::vector<StepRecord> steps(static_cast<std::size_t>(n));
    for (StepRecord& r : steps) r.load(source);
    record_.steps = std::move(steps);
    record_.reason.reset();
  }

 private:
  template <class M>
  void add(const M& map, const Situation& q, StepRecord&& r) {
    r.elapsed_s = q.elapsed_s;
    r.travelled_m = q.travelled_m;
    r.metrics = metrics_(map);
    record_.steps.push_back(std::move(r));
  }
  void write() {
    if (!file_.empty()) write_file(file_, mission_json(record_));
    written_ = std::chrono::steady_clock::now();
  }
  // " (resolution: 32 there, 16 here)" for as much as can be read.
  [[nodiscard]] std::string differences(const std::string& other) const {
    const auto there = nlohmann::ordered_json::parse(other, nullptr, false);
    if (!there.is_object()) return "";
    std::string text;
    const auto value = [](const nlohmann::ordered_json& object, const std::string& key) {
      const auto at = object.find(key);
      return at == object.end() ? std::string("none") : at->is_structured() ? std::string("...") : json_text(*at);
    };
    const auto compare = [&](const std::string& key) {
      const auto a = there.find(key), b = record_.config.find(key);
      const bool same = a != there.end() && b != record_.config.end() && json_text(*a) == json_text(*b);
      if (!same)
        text += (text.empty() ? " (" : ", ") + key + ": " + value(there, key) + " there, " +
                value(record_.config, key) + " here";
    };
    for (const auto& [key, unused] : there.items()) compare(key);
    for (const auto& [key, unused] : record_.config.items())
      if (!there.contains(key)) compare(key);
    return text.empty() ? text : text + ")";
  }

  std::filesystem::path file_;
  bool with_prior_;
  std::chrono::duration<double> write_every_;
  Metrics metrics_;
  MissionRecord record_;
  std::chrono::steady_clock::time_point written_ = {};
};

}  // namespace vantage
