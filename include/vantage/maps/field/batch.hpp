// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include <vantage/core/dense.hpp>
#include <vantage/maps/field/accumulated.hpp>

namespace vantage {

/// Gaussian-process regression on all measurements, exact. When cells merge, their measurements are replaced by one of
/// the merged cell: the mean, weighted by area, with the noise variance of such a mean. A template only so that
/// programs which do not use it need not compile it.
template <std::same_as<double> T = double>
struct ExactRegression {
  static constexpr std::string_view name = "batch";
  static constexpr bool infers_after_merge = false;

  /// With L L^T = K_mm + R: R = L^-1 K_m*, m = mu + R^T L^-1 (y - mu). l^3 / 3 + n l^2 flops.
  [[nodiscard]] CellPosterior infer(const NodePrior& prior, double prior_mean, const MeasurementHistory& h,
                                    std::span<const NdTree::Leaf> cells, double jitter) const {
    return regress(prior.covariance(h.cell), prior, prior_mean, h, cells, jitter);
  }
  /// The same for any covariance of the measured values (without noise, lower triangle).
  static CellPosterior regress(dense::Matrix<T> s, const NodePrior& prior, double prior_mean,
                               const MeasurementHistory& h, std::span<const NdTree::Leaf> cells, double jitter) {
    s.diagonal().array() += h.noise_variance.array() + jitter;
    dense::cholesky<T>(s, "Accumulated::fuse");
    CellPosterior p;
    p.root = prior.covariance(h.cell, cells);
    dense::solve_lower<T>(s, p.root);
    Eigen::VectorX<T> g = h.value.array() - prior_mean;
    s.template triangularView<Eigen::Lower>().solveInPlace(g);
    p.mean = (p.root.transpose() * g).array() + prior_mean;
    return p;
  }

  void merge(MeasurementHistory& h, const NdTree& tree, const Merge& m) const {
    std::vector<std::size_t> group_of(tree.size()), times(tree.size(), 0);
    for (std::size_t g = 0; g < m.groups.size(); ++g)
      for (std::size_t i = m.groups[g].first; i < m.groups[g].last; ++i) group_of[i] = g;
    std::vector<std::size_t> leaf;  // of each measurement: its cell has merged along with the leaves so far
    for (const NdTree::Leaf& c : h.cell) {
      const int width = tree.resolution() / tree.side(c.level);
      leaf.push_back(tree.leaf_of_cell(c.ix * width, c.iy * width));
      ++times[leaf.back()];
    }
    struct Mean {
      double weight = 0, value = 0, noise_variance = 0;
    };
    std::vector<Mean> mean(m.groups.size());
    MeasurementHistory kept;
    std::vector<double> value, noise;
    const auto keep = [&](const NdTree::Leaf& cell, double y, double r) {
      kept.cell.push_back(cell);
      value.push_back(y);
      noise.push_back(r);
    };
    for (std::size_t k = 0; k < h.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      const std::size_t g = group_of[leaf[k]];
      if (m.groups[g].last - m.groups[g].first == 1) {
        keep(h.cell[k], h.value[at], h.noise_variance[at]);
        continue;
      }
      const double w = m.weight[leaf[k]] / static_cast<double>(times[leaf[k]]);
      mean[g].weight += w;
      mean[g].value += w * h.value[at];
      mean[g].noise_variance += w * w * h.noise_variance[at];
    }
    for (std::size_t g = 0; g < mean.size(); ++g)
      if (const Mean& a = mean[g]; a.weight > 0)
        keep(tree.parent_of(m.groups[g]), a.value / a.weight, a.noise_variance / (a.weight * a.weight));
    kept.value = Eigen::Map<const Eigen::VectorXd>(value.data(), static_cast<Eigen::Index>(value.size()));
    kept.noise_variance = Eigen::Map<const Eigen::VectorXd>(noise.data(), static_cast<Eigen::Index>(noise.size()));
    kept.batch_end = {kept.size()};
    h = std::move(kept);
  }
};

/// The belief of AR-GPR-IK (section 3.2.1, after Reid et al.): regression with the integral kernel on all measurements,
/// from scratch after every update. The same posterior as Full until cells merge.
using Batch = Accumulated<ExactRegression<>>;

}  // namespace vantage
