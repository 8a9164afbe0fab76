// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/geometry/scalar_field.hpp>
#include <vantage/geometry/view.hpp>

namespace vantage {

/// How the noise of a pixel grows with the height above ground: the standard deviation for fields in [0, 1].
template <class N>
concept PixelNoise = std::copyable<N> && requires(const N n, double height_m) {
  { n.deviation(height_m) } -> std::convertible_to<double>;
  n.validate();
};

/// <thesis>, section 3.1.3: the variance is alpha h.
struct VarianceByHeight {
  double alpha = 0.03;  ///< [1/m], >= 0
  [[nodiscard]] double deviation(double height_m) const { return std::sqrt(alpha * height_m); }
  void validate() const {
    Check check("VarianceByHeight");
    check.not_negative("alpha", alpha);
    check.done();
  }
};

/// <reference>: the standard deviation is alpha h. With 0.05 (0.125 at 2.5 m) Table 3.1 of the thesis is met.
struct DeviationByHeight {
  double alpha = 0.05;  ///< [1/m], >= 0
  [[nodiscard]] double deviation(double height_m) const { return alpha * height_m; }
  void validate() const {
    Check check("DeviationByHeight");
    check.not_negative("alpha", alpha);
    check.done();
  }
};

struct FieldWorldConfig {
  NadirSensor sensor = {};
  /// What 1 is to the noise policy, in the field's unit: by default the truth's range (maximum - minimum), so that a
  /// field in metres or degrees is as hard as the same field scaled to [0, 1]. Finite, >= 0.
  std::optional<double> noise_unit = {};
};

/// A simulated UAV above a known field: a World for the maps that read a FieldImage.
///
/// Each pixel of the image takes the truth's pixel nearest to its centre; NaN outside of the field and where it is
/// masked. Zero-mean Gaussian noise is added, independent from pixel to pixel; the noise of measurement k comes from
/// the k-th fork of the world's stream, whatever is measured, so that a mission resumed from a checkpoint sees the same
/// bytes. Not shared between threads.
template <PixelNoise Noise = DeviationByHeight>
class FieldWorld {
 public:
  FieldWorld(ScalarField truth, Noise noise, const Rng& rng, const FieldWorldConfig& config = {})
      : truth_(std::move(truth)),
        noise_(std::move(noise)),
        rng_(rng),
        sensor_(config.sensor),
        noise_unit_(config.noise_unit.value_or(truth_.range())) {
    noise_.validate();
    sensor_.validate();
    Check check("FieldWorldConfig");
    check.not_negative("noise_unit", noise_unit_);
    check.done();
    const auto& values = truth_.values();
    truth_hash_ = fnv1a(std::as_bytes(std::span(values.data(), static_cast<std::size_t>(values.size()))));
  }

  [[nodiscard]] const ScalarField& truth() const { return truth_; }
  [[nodiscard]] const NadirSensor& sensor() const { return sensor_; }
  [[nodiscard]] double noise_unit() const { return noise_unit_; }
  /// Standard deviation of a pixel's noise, in the field's unit: what a map's sensor model should assume.
  [[nodiscard]] double noise_deviation(double height_m) const { return noise_.deviation(height_m) * noise_unit_; }
  /// Images taken so far.
  [[nodiscard]] std::uint64_t measurements() const { return measurements_; }

  /// What the sensor sees from `view`. None if the footprint lies wholly outside of the field's area; if it overlaps
  /// the area but meets masked pixels only, an image of NaN, which a map skips. Throws Error for a view that is not
  /// finite, not above ground or does not look straight down. O(pixels).
  std::optional<FieldImage> observe(const View& view) {
    FieldImage image{view, sensor_.footprint(view), {}};
    if (!(area(image.footprint.intersection(truth_.area())) > 0)) return std::nullopt;
    const double deviation = noise_deviation(view.position().z());
    const Eigen::Vector2d pixel_m = image.footprint.sizes() / sensor_.pixels;
    Rng noise = rng_.fork(measurements_++);
    image.values.resize(sensor_.pixels, sensor_.pixels);
    for (Eigen::Index row = 0; row < sensor_.pixels; ++row)
      for (Eigen::Index column = 0; column < sensor_.pixels; ++column) {
        const Eigen::Vector2d t(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
        image.values(row, column) =
            truth_.at(image.footprint.min() + pixel_m.cwiseProduct(t)) + deviation * noise.normal();
      }
    return image;
  }

  void save(Sink& sink) const {
    sink.put(truth_hash_);
    for (const std::uint64_t word : rng_.state()) sink.put(word);
    sink.put(measurements_);
  }
  /// Throws Error if it was saved over another field; the world is then unchanged.
  void load(Source& source) {
    const auto hash = source.get<std::uint64_t>();
    if (hash != truth_hash_)
      throw Error(source.where(), "the world was saved over another field", "the field of this mission");
    const auto key = source.get<std::uint64_t>(), counter = source.get<std::uint64_t>();
    const auto measurements = source.get<std::uint64_t>();
    rng_ = Rng::restored({key, counter});
    measurements_ = measurements;
  }

 private:
  ScalarField truth_;
  Noise noise_;
  Rng rng_;
  NadirSensor sensor_;
  double noise_unit_;
  std::uint64_t measurements_ = 0, truth_hash_ = 0;
};

}  // namespace vantage
