// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>

#include <vantage/core/bytes.hpp>

namespace vantage {

/// Computing as this machine measures it (simulating the world is not counted), travel as the selector models it.
class MeasuredClock {
 public:
  [[nodiscard]] double elapsed_s() const { return elapsed_s_; }
  void begin() { since_ = std::chrono::steady_clock::now(); }
  void mapped() { close(); }
  void planned() { close(); }
  void travelled(double s) { elapsed_s_ += s; }
  void save(Sink& sink) const { sink.put(elapsed_s_); }
  void load(Source& source) { source.get(elapsed_s_); }

 private:
  void close() { elapsed_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - since_).count(); }
  std::chrono::steady_clock::time_point since_ = {};
  double elapsed_s_ = 0;
};

/// Computing at stated costs: a run repeats bit for bit.
class ModelledClock {
 public:
  struct Config {
    double mapping_s = 0.1;   ///< per measurement, >= 0
    double planning_s = 0.1;  ///< per plan, >= 0
  };
  ModelledClock() = default;
  explicit ModelledClock(const Config& config) : config_(config) {
    Check check("ModelledClock::Config");
    check.not_negative("mapping_s", config.mapping_s);
    check.not_negative("planning_s", config.planning_s);
    check.done();
  }
  [[nodiscard]] double elapsed_s() const { return elapsed_s_; }
  void begin() {}
  void mapped() { elapsed_s_ += config_.mapping_s; }
  void planned() { elapsed_s_ += config_.planning_s; }
  void travelled(double s) { elapsed_s_ += s; }
  void save(Sink& sink) const { sink.put(elapsed_s_); }
  void load(Source& source) { source.get(elapsed_s_); }

 private:
  Config config_{};
  double elapsed_s_ = 0;
};

/// Everything in real time since construction, for a robot that really travels.
class WallClock {
 public:
  [[nodiscard]] double elapsed_s() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void begin() {}
  void mapped() {}
  void planned() {}
  void travelled(double) {}

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace vantage
