// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/maps/field/cell_sensor.hpp>
#include <vantage/maps/field/nd_tree.hpp>
#include <vantage/maps/field/prior.hpp>

namespace vantage {

/// Cells that are independent of each other: scalar Kalman updates (the FR-IDP and AR-IDP baselines of section 3.2.1).
/// A merged cell's variance is the mean of its children's <reference>. O(l) an update.
class Diagonal {
 public:
  static constexpr std::string_view name = "diagonal";
  struct Config {};

  Diagonal(const Config&, const NdTree& tree, const Prior& prior)
      : mean_(Eigen::VectorXd::Constant(static_cast<Eigen::Index>(tree.size()), prior.mean)),
        variance_(Eigen::VectorXd::Constant(mean_.size(), prior.variance * prior.kx(0, 0) * prior.ky(0, 0))) {}

  [[nodiscard]] double mean(std::size_t i) const { return mean_[static_cast<Eigen::Index>(i)]; }
  [[nodiscard]] double variance(std::size_t i) const { return variance_[static_cast<Eigen::Index>(i)]; }
  [[nodiscard]] std::vector<double> parent_variances(std::span<const ParentCell> parents,
                                                     std::span<const double> weight) const {
    std::vector<double> out;
    for (const ParentCell& p : parents) {
      double sum = 0;
      for (std::size_t i = p.leaves.first; i < p.leaves.last; ++i) sum += weight[i] * variance(i);
      out.push_back(sum);
    }
    return out;
  }

  void fuse(const NdTree&, const CellMeasurements& z) {
    for (std::size_t k = 0; k < z.cells.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(z.cells[k]), j = static_cast<Eigen::Index>(k);
      const double gain = variance_[i] / (variance_[i] + z.noise_variance[j]);
      mean_[i] += gain * (z.value[j] - mean_[i]);
      variance_[i] -= gain * variance_[i];
    }
  }
  void merge(const NdTree&, const Merge& m) {
    Eigen::Index to = 0;
    for (const LeafGroup& g : m.groups) {
      double mean = 0, variance = 0;
      for (std::size_t i = g.first; i < g.last; ++i) {
        mean += m.weight[i] * this->mean(i);
        variance += m.weight[i] * this->variance(i);
      }
      mean_[to] = mean;
      variance_[to++] = variance;
    }
    mean_.conservativeResize(to);
    variance_.conservativeResize(to);
  }
  void settle() {}

  /// Forecasts by independent cells: each measured target loses k^2 / (k + r).
  class Forecaster {
   public:
    Forecaster(const Diagonal& belief, const NdTree&, std::span<const std::uint8_t> target)
        : variance_(belief.variance_), target_(target.begin(), target.end()) {}
    void given(const CellMeasurements& z) {
      for (std::size_t k = 0; k < z.cells.size(); ++k) variance_[at(z, k)] -= loss(z, k);
    }
    void prepare(std::span<const CellMeasurements>) {}
    [[nodiscard]] double reduction(const CellMeasurements& z) const {
      double sum = 0;
      for (std::size_t k = 0; k < z.cells.size(); ++k)
        if (target_[z.cells[k]]) sum += loss(z, k);
      return sum;
    }

   private:
    static Eigen::Index at(const CellMeasurements& z, std::size_t k) { return static_cast<Eigen::Index>(z.cells[k]); }
    [[nodiscard]] double loss(const CellMeasurements& z, std::size_t k) const {
      const double v = variance_[at(z, k)];
      return v * v / (v + z.noise_variance[static_cast<Eigen::Index>(k)]);
    }
    Eigen::VectorXd variance_;
    std::vector<std::uint8_t> target_;
  };

  [[nodiscard]] std::size_t bytes() const {
    return static_cast<std::size_t>(mean_.size() + variance_.size()) * sizeof(double);
  }
  void save(Sink& sink) const {
    sink.put(mean_);
    sink.put(variance_);
  }
  void load(Source& source, const NdTree& tree) {
    Eigen::VectorXd mean, variance;
    load_column(source, mean, tree.size());
    load_column(source, variance, tree.size());
    mean_ = std::move(mean);
    variance_ = std::move(variance);
  }

 private:
  static void load_column(Source& source, Eigen::VectorXd& v, std::size_t n) {
    Eigen::MatrixXd m;
    source.get(m);
    if (m.cols() != 1 || m.rows() != static_cast<Eigen::Index>(n) || !m.allFinite())
      throw Error(source.where(), concat(m.rows(), " x ", m.cols(), " values"), concat(n, " finite ones"));
    v = m;
  }
  Eigen::VectorXd mean_, variance_;
};

}  // namespace vantage
