// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/maps/field/latent.hpp>
#include <vantage/maps/field/methods.hpp>
#include <vantage/sim/field_world.hpp>
#include <vantage/sim/random_field.hpp>

#include "method_names.hpp"

// What the studies of chapter 3 compare, and on what.
namespace study {

using namespace vantage;

/// Chapter 3 as it is written, with less noise: see Reading.
struct ThesisQuietly {};

}  // namespace study

template <>
struct vantage::FieldPreset<study::ThesisQuietly> : vantage::FieldPreset<vantage::preset::thesis> {
  using HeightNoise = DeviationGrowsWithHeight;
};

namespace study {

/// Readings of chapter 3. All take the kernel of section 3.2.1 (sigma^2 = 1, l = 2.36 m) and the threshold 0.7.
/// - reference: as the published code does it. Noise deviation alpha h, here with alpha = 0.05, which meets the
///   errors of Table 3.1; measured cells merge where mean + deviation < 0.7; adaptive maps skip cells seen in part.
/// - thesis: as it is written. Noise variance alpha h, alpha = 0.03; cells merge where mean + 2 variance <= 0.7 (eq.
///   3.8); cells seen in part count with more noise.
/// - thesis_quiet: the rules of the text with the noise of the code.
template <class Preset>
struct Reading;
template <>
struct Reading<preset::thesis> {
  using Noise = VarianceByHeight;
  static constexpr double alpha = 0.03;
};
template <>
struct Reading<preset::reference> {
  using Noise = DeviationByHeight;
  static constexpr double alpha = 0.05;
};
template <>
struct Reading<ThesisQuietly> : Reading<preset::reference> {};

inline const std::vector<std::string>& all_readings() {
  static const std::vector<std::string> names = {"reference", "thesis", "thesis_quiet"};
  return names;
}

inline std::string about(std::string_view reading) {
  const std::string loud = "noise variance 0.03 h (deviation 0.27 at 2.5 m)",
                    quiet = "noise deviation 0.05 h (0.125 at 2.5 m)";
  if (reading == "reference")
    return quiet +
           ", measured cells merge where mean + deviation < 0.7, cells seen in part are skipped by adaptive maps";
  return (reading == "thesis" ? loud : quiet) +
         ", cells merge where mean + 2 variance <= 0.7, cells seen in part count with more noise";
}

/// f.operator()<Preset>() for a reading's name.
template <class F>
decltype(auto) with_reading(std::string_view name, F&& f) {
  if (name == "thesis") return f.template operator()<preset::thesis>();
  if (name == "thesis_quiet") return f.template operator()<ThesisQuietly>();
  return f.template operator()<preset::reference>();
}

// f.operator()<MapT>() for a method's name.
template <class Preset, class F>
decltype(auto) with_planned_method(std::string_view name, F&& f) {
  if (name == "fr_idp") return f.template operator()<FrIdp<Preset>>();
  if (name == "ar_idp") return f.template operator()<ArIdp<Preset>>();
  if (name == "fr_gpf") return f.template operator()<FrGpf<Preset>>();
  if (name == "ours_latent") return f.template operator()<Ours<Preset, Latent<>>>();
  return f.template operator()<Ours<Preset>>();
}

/// Those and the ones that infer from all measurements again and again.
template <class Preset, class F>
decltype(auto) with_method(std::string_view name, F&& f) {
  if (name == "ar_bcm") return f.template operator()<ArBcm<Preset>>();
  if (name == "ar_gpr_ik") return f.template operator()<ArGprIk<Preset>>();
  return with_planned_method<Preset>(name, std::forward<F>(f));
}

template <class MapT, class Preset>
typename MapT::Config map_config(int cells_a_side, FieldTask task) {
  typename MapT::Config c = configured<MapT, Preset>(task);
  c.kernel = {.variance = 1, .length_m = 2.36};
  c.sensor.alpha = Reading<Preset>::alpha;
  c.tree.depth = static_cast<int>(std::bit_width(static_cast<unsigned>(cells_a_side))) - 1;
  return c;
}

/// The k-th field of a study and a UAV above it. Every method meets the same fields; the noise of the k-th measurement
/// is the same, too.
template <class Preset>
FieldWorld<typename Reading<Preset>::Noise> make_world(std::uint64_t seed, std::uint64_t field) {
  return {random_field(Rng(seed).fork(field)), {.alpha = Reading<Preset>::alpha}, Rng(seed).fork(1u << 20).fork(field)};
}

}  // namespace study
