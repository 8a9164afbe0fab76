// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/maps/field/presets.hpp>
#include <vantage/mission/command_line.hpp>

namespace field {

using namespace vantage;

/// How the UAV gets its views: planned from the map, or along a fixed pattern.
enum class Protocol { plan, lawnmower16, lawnmower81 };

inline std::string_view name_of(Protocol p) {
  return p == Protocol::plan ? "plan" : p == Protocol::lawnmower16 ? "lawnmower16" : "lawnmower81";
}

inline const std::vector<MethodName>& methods() {
  static const std::vector<MethodName> list = {
      {"ours", "adaptive resolution, GP fusion with integral kernels (chapter 3)"},
      {"latent", "the same map by a low-rank covariance: for 128 x 128 cells and more"},
      {"fr_gpf", "FR-GPF: fixed resolution, GP fusion at the cells' centres"},
      {"fr_idp", "FR-IDP: fixed resolution, independent cells"},
      {"ar_idp", "AR-IDP: adaptive resolution, independent cells"},
      {"ar_gpr_ik", "AR-GPR-IK: regression with the integral kernel on all measurements; flies a lawnmower pattern"},
      {"ar_bcm", "AR-BCM: Bayesian committee machine; flies a lawnmower pattern"},
      {"lawnmower", "the map of ours, measured along a lawnmower pattern"},
      {"random", "the map of ours, measured at random views of the lattice"}};
  return list;
}

struct Options : MissionOptions {
  std::filesystem::path file = {};  ///< --field; empty: the default field
  std::optional<std::string> column = {};
  std::optional<std::uint64_t> random = {};  ///< --random SEED: a random field
  Protocol protocol = Protocol::plan;
  std::optional<int> resolution = {};    ///< cells a side; default 32, of the protocol lawnmower81 64
  std::optional<double> threshold = {};  ///< in the field's unit; default 70 % of its range
  std::optional<double> alpha = {};      ///< noise of the sensor; default the preset's
  int pixels = 20;
  double half_angle_deg = 45;
  double side_m = 20;       ///< of the flight area, the longer one
  double checkpoint_s = 1;  ///< real time between two checkpoints

  Options() {
    out = "out/field";
    preset = std::is_same_v<DefaultFieldPreset, vantage::preset::thesis> ? PresetKind::thesis : PresetKind::reference;
    budget_s = 300;
  }
  [[nodiscard]] int cells_a_side() const { return resolution.value_or(protocol == Protocol::lawnmower81 ? 64 : 32); }
  [[nodiscard]] int depth() const {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(cells_a_side()))) - 1;
  }
};

inline void add_options(CLI::App& app, Options& o) {
  add_mission_options(app, o, methods());
  app.add_option("--field", o.file, "Field to measure: x, y and values, one sample a line, on a grid or scattered")
      ->type_name("FILE.csv");
  app.add_option("--column", o.column, "Which column holds the values (default: the last)")->type_name("NAME");
  app.add_option("--random", o.random, "A Gaussian random field instead of a file")
      ->check(vantage::detail::whole_number())
      ->type_name("SEED");
  app.add_option("--resolution", o.resolution,
                 "Finest cells along a side, a power of two (default 32); above 128: latent, fr_idp and ar_idp only")
      ->check(CLI::IsMember(std::vector<int>{4, 8, 16, 32, 64, 128, 256, 512, 1024}))
      ->type_name("N");
  app.add_option("--threshold", o.threshold, "What is above matters, in the field's unit (default: 70 % of its range)")
      ->type_name("VALUE");
  app.add_option("--protocol", o.protocol,
                 "plan: views are planned. lawnmower16: 4 x 4 views side by side (Table 3.1). lawnmower81: 9 x 9 views "
                 "that overlap by half, 64 x 64 cells (Fig. 3.5)")
      ->transform(vantage::detail::one_of<Protocol>({Protocol::plan, Protocol::lawnmower16, Protocol::lawnmower81}))
      ->default_str("plan")
      ->type_name("NAME");
  app.add_option("--side", o.side_m, "Longer side of the flight area, to which the field is scaled")
      ->check(vantage::detail::between(0.001, 1e6))
      ->capture_default_str()
      ->type_name("METRES");
  app.add_option("--noise", o.alpha,
                 "Sensor noise per metre of height, for a field scaled to [0, 1] (default: the preset's)")
      ->check(vantage::detail::positive())
      ->type_name("ALPHA");
  app.add_option("--pixels", o.pixels, "Pixels along a side of the sensor's image")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str()
      ->type_name("N");
  app.add_option("--half-angle", o.half_angle_deg, "Half of the sensor's field of view")
      ->check(vantage::detail::between(1, 80))
      ->capture_default_str()
      ->type_name("DEGREES");
  app.add_option("--checkpoint", o.checkpoint_s, "Real time between two checkpoints; 0: after every measurement")
      ->check(vantage::detail::between(0, 1e9))
      ->capture_default_str()
      ->type_name("SECONDS");
}

/// Whether a method computes with the covariance of every cell with every other.
inline bool has_full_covariance(const std::string& method) {
  return method != "latent" && method != "fr_idp" && method != "ar_idp";
}

/// Throws Error for options that contradict each other, and for a map that would not fit.
inline void validate(const Options& o) {
  if (!o.file.empty() && o.random) throw Error("--random", "given together with --field", "one of them");
  if (o.column && o.file.empty()) throw Error("--column", "given without --field", "a file that has the column");
  if (o.threshold && !std::isfinite(*o.threshold)) throw Error("--threshold", concat(*o.threshold), "a finite number");
  if (const int n = o.cells_a_side(); n > 128 && has_full_covariance(o.method))
    throw Error("--resolution",
                concat(n, " x ", n, " cells by method ", o.method, ", whose covariance takes ",
                       std::round(8 * std::pow(n, 4) / 1e9), " GB"),
                "--method latent, or at most 128");
}

}  // namespace field
