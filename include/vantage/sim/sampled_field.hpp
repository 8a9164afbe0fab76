// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/scalar_field.hpp>
#include <vantage/sim/delaunay.hpp>

// Worlds from data: what a campaign sampled, on a grid or wherever it could, becomes the truth of a mission.
namespace vantage {

/// Into which area, and how finely.
struct SampledFieldConfig {
  Box2 area_m = {Eigen::Vector2d(0, 0), Eigen::Vector2d(20, 20)};  ///< the flight area
  int pixels = 400;       ///< along the area's longer side, 2 to 16384; pixels are square
  double held_out = 0.2;  ///< share of scattered samples kept from the truth, [0, 0.9]

  void validate() const {
    Check check("SampledFieldConfig");
    check(pixels >= 2 && pixels <= 16384, "pixels", pixels, "2 to 16384");
    check(held_out >= 0 && held_out <= 0.9, "held_out", held_out, "0 to 0.9");
    check(!area_m.isEmpty() && area_m.sizes().allFinite() && area(area_m) > 0, "area_m", area(area_m),
          "finite and > 0 m^2");
    check.done();
  }
};

/// The truth, and what of the data it does not know.
struct SampledField {
  ScalarField truth;
  std::vector<FieldSample> held_out =
      {};  ///< scattered data: samples that the truth was not made of, inside its hull [m]
  bool gridded = false;
  double scale = 1;  ///< metres of the flight area per unit of the samples' positions
};

namespace detail {

/// Positions origin + i step, i = 0 .. count - 1.
struct LatticeAxis {
  double origin = 0, step = 0;
  std::size_t count = 0;
  [[nodiscard]] double index(double x) const { return (x - origin) / step; }
};

/// The lattice of which all coordinates are, or none. Files round: a tenth of a step is forgiven.
inline std::optional<LatticeAxis> lattice_axis(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  const double range = x.back() - x.front();
  x.erase(std::unique(x.begin(), x.end(), [&](double a, double b) { return b - a <= 1e-6 * range; }), x.end());
  if (x.size() < 2) return std::nullopt;
  double narrowest = range, sum = 0, gaps = 0;
  for (std::size_t i = 1; i < x.size(); ++i) narrowest = std::min(narrowest, x[i] - x[i - 1]);
  for (std::size_t i = 1; i < x.size(); ++i)  // wider gaps are several steps: columns without a sample
    if (x[i] - x[i - 1] < 1.5 * narrowest) sum += x[i] - x[i - 1], ++gaps;
  const double steps = std::round(range / (sum / gaps));
  const LatticeAxis axis{x.front(), range / steps, static_cast<std::size_t>(steps) + 1};
  for (const double v : x)
    if (std::abs(axis.index(v) - std::round(axis.index(v))) > 0.1) return std::nullopt;
  return axis;
}

struct LatticeField {
  LatticeAxis x, y;
  Image<double> values;  ///< (index along y, index along x), NaN where there is no sample
};

/// The samples as a lattice: regular along both axes and at least three in ten of its places taken (else the samples
/// are scattered, and merely have rounded coordinates). Samples at the same place are averaged.
inline std::optional<LatticeField> as_lattice(const std::vector<FieldSample>& samples) {
  std::vector<double> xs, ys;
  for (const FieldSample& s : samples) xs.push_back(s.position.x()), ys.push_back(s.position.y());
  const auto x = lattice_axis(std::move(xs)), y = lattice_axis(std::move(ys));
  if (!x || !y ||
      static_cast<double>(x->count) * static_cast<double>(y->count) * 0.3 > static_cast<double>(samples.size()))
    return std::nullopt;
  const auto rows = static_cast<Eigen::Index>(y->count), columns = static_cast<Eigen::Index>(x->count);
  Image<double> sum = Image<double>::Zero(rows, columns), count = sum;
  for (const FieldSample& s : samples) {
    if (std::isnan(s.value)) continue;
    const Eigen::Index row = std::lround(y->index(s.position.y())), column = std::lround(x->index(s.position.x()));
    sum(row, column) += s.value;
    count(row, column) += 1;
  }
  return LatticeField{*x, *y, sum / count};  // 0 / 0 = NaN: no value
}

/// Bilinear interpolation at lattice coordinates (u along x, v along y); NaN unless all four neighbours have a value.
inline double bilinear(const Image<double>& values, double u, double v) {
  const auto column = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(u), 0, values.cols() - 2);
  const auto row = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(v), 0, values.rows() - 2);
  const double a = u - static_cast<double>(column), b = v - static_cast<double>(row);
  return (1 - b) * ((1 - a) * values(row, column) + a * values(row, column + 1)) +
         b * ((1 - a) * values(row + 1, column) + a * values(row + 1, column + 1));
}

/// Samples with a value, those at the same place averaged, in order of x, then y: the order in the file does not
/// matter.
inline std::vector<FieldSample> distinct(std::vector<FieldSample> samples) {
  std::erase_if(samples, [](const FieldSample& s) { return std::isnan(s.value); });
  const auto key = [](const FieldSample& s) { return std::array{s.position.x(), s.position.y(), s.value}; };
  std::sort(samples.begin(), samples.end(),
            [&](const FieldSample& a, const FieldSample& b) { return key(a) < key(b); });
  std::vector<FieldSample> out;
  for (std::size_t i = 0, n = 0; i < samples.size(); i += n) {
    double sum = 0;
    for (n = 0; i + n < samples.size() && samples[i + n].position == samples[i].position; ++n)
      sum += samples[i + n].value;
    out.push_back({samples[i].position, sum / static_cast<double>(n)});
  }
  return out;
}

}  // namespace detail

/// Makes a world's truth of samples.
///
/// Scale: the bounding box of the samples' positions is scaled isotropically so that it just fits into the flight area,
/// and put in its middle; what it does not reach is masked. Values keep their unit.
///
/// Gridded samples (a regular lattice, blanks allowed) are interpolated bilinearly where all four neighbours have a
/// value, and masked elsewhere. Of scattered samples a share, drawn by `rng`, is held out; the truth is the linear
/// interpolation over the Delaunay triangulation of the others, masked outside of their convex hull.
///
/// Throws Error for samples that are infinite, have no extent along both axes, or are too few (5 with a value).
inline SampledField sampled_field(const FieldSamples& data, Rng rng, const SampledFieldConfig& config = {}) {
  config.validate();
  Box2 extent;
  std::size_t values = 0;
  for (const FieldSample& s : data.samples) {
    if (!s.position.allFinite() || std::isinf(s.value))
      throw Error("sampled_field", "a sample is not finite", "finite positions and values");
    extent.extend(s.position);
    if (!std::isnan(s.value)) ++values;
  }
  if (values < 5) throw Error("sampled_field", concat(values, " samples with a value"), "at least 5");
  if (!((extent.sizes().array() > 0).all() && extent.sizes().allFinite() && extent.center().allFinite()))
    throw Error("sampled_field", concat("the samples extend over ", extent.sizes().x(), " x ", extent.sizes().y()),
                "a rectangle");

  const Eigen::Vector2d side_m = config.area_m.sizes();
  const double scale = side_m.cwiseQuotient(extent.sizes()).minCoeff();
  if (!(std::isfinite(scale) && scale > 0))
    throw Error("sampled_field", concat("a scale of ", scale), "finite and > 0");
  const auto count = [&](double side) {
    return std::max<Eigen::Index>(1, std::lround(config.pixels * side / side_m.maxCoeff()));
  };
  const Eigen::Index rows = count(side_m.y()), columns = count(side_m.x());
  const auto place = [&](const Eigen::Vector2d& p) -> Eigen::Vector2d {
    return config.area_m.center() + scale * (p - extent.center());
  };

  if (const auto lattice = detail::as_lattice(data.samples)) {
    Image<double> image = Image<double>::Constant(rows, columns, std::numeric_limits<double>::quiet_NaN());
    const Eigen::Vector2d pixel_m(side_m.x() / static_cast<double>(columns), side_m.y() / static_cast<double>(rows));
    for (Eigen::Index row = 0; row < rows; ++row)
      for (Eigen::Index column = 0; column < columns; ++column) {
        const Eigen::Vector2d centre_m =
            config.area_m.min() +
            pixel_m.cwiseProduct(Eigen::Vector2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5));
        const Eigen::Vector2d p = extent.center() + (centre_m - config.area_m.center()) / scale;
        if (extent.contains(p))
          image(row, column) = detail::bilinear(lattice->values, lattice->x.index(p.x()), lattice->y.index(p.y()));
      }
    return {ScalarField(config.area_m, std::move(image), data.quantity), {}, true, scale};
  }

  std::vector<FieldSample> kept = detail::distinct(data.samples), held_out;
  for (FieldSample& s : kept) s.position = place(s.position);
  const auto held = static_cast<std::size_t>(std::lround(config.held_out * static_cast<double>(kept.size())));
  for (std::size_t i = 0; i < held; ++i) {  // the first of a random order
    std::swap(kept[i], kept[i + rng.index(kept.size() - i)]);
    held_out.push_back(kept[i]);
  }
  kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(held));
  ScalarField truth(config.area_m, interpolate_scattered(kept, config.area_m, rows, columns), data.quantity);
  std::erase_if(held_out, [&](const FieldSample& s) { return std::isnan(truth.at(s.position)); });
  return {std::move(truth), std::move(held_out), false, scale};
}

}  // namespace vantage
