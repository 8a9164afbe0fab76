// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/bytes.hpp>
#include <vantage/core/dense.hpp>
#include <vantage/core/error.hpp>
#include <vantage/maps/field/cell_sensor.hpp>
#include <vantage/maps/field/nd_tree.hpp>
#include <vantage/maps/field/node_prior.hpp>
#include <vantage/maps/field/prior.hpp>

namespace vantage {

/// All measurements of a mission, oldest first; those of one update make a batch.
struct MeasurementHistory {
  std::vector<NdTree::Leaf> cell;  ///< as they were when measured, or what they have merged into
  Eigen::VectorXd value, noise_variance;
  std::vector<std::size_t> batch_end;  ///< one past each batch's last measurement

  [[nodiscard]] std::size_t size() const { return cell.size(); }

  void append(const NdTree& tree, const CellMeasurements& z) {
    for (const std::size_t i : z.cells) cell.push_back(tree[i]);
    const auto old = value.size(), added = z.value.size();
    value.conservativeResize(old + added);
    noise_variance.conservativeResize(old + added);
    value.tail(added) = z.value;
    noise_variance.tail(added) = z.noise_variance;
    batch_end.push_back(cell.size());
  }
  [[nodiscard]] std::size_t bytes() const {
    return cell.size() * sizeof(NdTree::Leaf) + 2 * cell.size() * sizeof(double) + batch_end.size() * sizeof(std::size_t);
  }
  void save(Sink& sink) const {
    std::vector<std::int32_t> level, ix, iy;
    for (const NdTree::Leaf& c : cell) { level.push_back(c.level); ix.push_back(c.ix); iy.push_back(c.iy); }
    sink.put(level); sink.put(ix); sink.put(iy);
    sink.put(value); sink.put(noise_variance);
    sink.put(std::vector<std::uint64_t>(batch_end.begin(), batch_end.end()));
  }
  void load(Source& source, const NdTree& tree) {
    MeasurementHistory h;
    std::vector<std::int32_t> level, ix, iy;
    std::vector<std::uint64_t> end;
    source.get(level); source.get(ix); source.get(iy);
    source.get(h.value); source.get(h.noise_variance);
    source.get(end);
    const std::size_t n = level.size();
    const auto rows = static_cast<Eigen::Index>(n);
    bool sound = ix.size() == n && iy.size() == n && h.value.rows() == rows && h.noise_variance.rows() == rows &&
                 h.value.allFinite() && h.noise_variance.allFinite() && (h.noise_variance.array() > 0).all() &&
                 std::is_sorted(end.begin(), end.end()) && (end.empty() ? n == 0 : end.back() == n);
    for (std::size_t k = 0; sound && k < n; ++k) {
      sound = level[k] >= 0 && level[k] <= tree.config().depth && ix[k] >= 0 && iy[k] >= 0 && ix[k] < tree.side(level[k]) &&
              iy[k] < tree.side(level[k]);
      h.cell.push_back({level[k], ix[k], iy[k], true});
    }
    if (!sound) throw Error(source.where(), concat("a history of ", n, " measurements that is not sound"), "cells, finite values, positive variances");
    h.batch_end.assign(end.begin(), end.end());
    *this = std::move(h);
  }
};

/// A belief that keeps every measurement and infers the cells from scratch after each update, eqs. 2.7 and 2.8 with cells
/// for points. With l measurements and n cells: l^3 / 3 + n l^2 flops an update, and what Rule adds; memory O(l + n) between
/// updates. `Rule` says how measurements covary (see Batch and Committee), and what becomes of them when cells merge:
///
///     Eigen::MatrixXd covariance(prior, history, leaves, jitter) const;   // of the measured values, lower triangle
///     void merge(history, tree, merge) const;
///     static constexpr bool infers_after_merge;      // or else merged cells' beliefs are averaged
template <class Rule>
class Accumulated {
  using Index = Eigen::Index;

 public:
  static constexpr std::string_view name = Rule::name;
  struct Config {
    double jitter = 1e-8;  ///< added to covariances' diagonals, in shares of the prior variance, 0 to 1e-3
  };

  Accumulated(const Config& config, const NdTree& tree, const Prior& prior)
      : prior_(tree, prior), prior_mean_(prior.mean), jitter_(checked(config) * prior.variance) {
    state_.mean = Eigen::VectorXd::Constant(static_cast<Index>(tree.size()), prior.mean);
    state_.variance.resize(state_.mean.size());
    for (std::size_t i = 0; i < tree.size(); ++i) state_.variance[static_cast<Index>(i)] = prior_(tree[i], tree[i]);
  }

  [[nodiscard]] double mean(std::size_t i) const { return state_.mean[static_cast<Index>(i)]; }
  [[nodiscard]] double variance(std::size_t i) const { return state_.variance[static_cast<Index>(i)]; }
  /// A parent is a query like any other.
  [[nodiscard]] std::vector<double> parent_variances(std::span<const ParentCell> parents, std::span<const double>) const {
    std::vector<NdTree::Leaf> cells;
    for (const ParentCell& p : parents) cells.push_back(p.cell);
    const Eigen::VectorXd v = variances(cells, explained(factor_, history_, cells));
    return {v.data(), v.data() + v.size()};
  }
  /// Posterior covariance of the leaves, n x n.
  [[nodiscard]] Eigen::MatrixXd covariance_matrix(const NdTree& tree) const {
    const std::vector<NdTree::Leaf> cells = leaves(tree);
    Eigen::MatrixXd k = prior_.covariance(cells);
    if (history_.size() != 0) dense::add_gram<double>(k, explained(factorised(history_, cells), history_, cells), -1.0);
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    return k;
  }
  [[nodiscard]] const MeasurementHistory& history() const { return history_; }

  /// Adds measurements and infers all cells. Throws Error, changing nothing, if the measurements' covariance is not positive
  /// definite to working precision.
  void fuse(const NdTree& tree, const CellMeasurements& z) {
    MeasurementHistory history = history_;
    history.append(tree, z);
    const std::vector<NdTree::Leaf> cells = leaves(tree);
    Eigen::MatrixXd factor = factorised(history, cells);
    state_ = infer(factor, history, cells);
    factor_ = std::move(factor);
    history_ = std::move(history);
  }
  void merge(const NdTree& tree, const Merge& m) {
    MeasurementHistory history = history_;
    rule_.merge(history, tree, m);
    std::vector<NdTree::Leaf> cells;
    for (const LeafGroup& g : m.groups) cells.push_back(tree.parent_of(g));
    if constexpr (Rule::infers_after_merge) {
      state_ = infer(factorised(history, cells), history, cells);
    } else {
      Cells merged;
      merged.mean.setZero(static_cast<Index>(cells.size()));
      for (std::size_t g = 0; g < cells.size(); ++g)
        for (std::size_t i = m.groups[g].first; i < m.groups[g].last; ++i) merged.mean[static_cast<Index>(g)] += m.weight[i] * mean(i);
      merged.variance = variances(cells, explained(factor_, history_, cells));
      state_ = std::move(merged);
    }
    history_ = std::move(history);
  }
  void settle() { factor_.resize(0, 0); }

  /// Conditions the posterior covariance of the leaves on measurements to come.
  class Forecaster {
   public:
    Forecaster(const Accumulated& belief, const NdTree& tree, std::span<const std::uint8_t> target)
        : k_(belief.covariance_matrix(tree)) {
      for (std::size_t i = 0; i < target.size(); ++i)
        if (target[i]) target_.push_back(static_cast<Index>(i));
    }
    void given(const CellMeasurements& z) {
      if (z.cells.empty()) return;
      const std::vector<Index> h(z.cells.begin(), z.cells.end());
      Eigen::MatrixXd s = innovation(h, z), w = k_(h, Eigen::all);
      dense::cholesky<double>(s, "Accumulated::Forecaster");
      dense::solve_lower<double>(s, w);
      dense::add_gram<double>(k_, w, -1.0);
      k_.template triangularView<Eigen::StrictlyUpper>() = k_.transpose();
    }
    void prepare() {
      m_.setZero(k_.rows(), k_.cols());
      dense::add_gram<double>(m_, Eigen::MatrixXd(k_(target_, Eigen::all)), 1.0);
      m_.template triangularView<Eigen::StrictlyUpper>() = m_.transpose();
    }
    /// tr(S^-1 M[H, H]).
    [[nodiscard]] double reduction(const CellMeasurements& z) const {
      if (z.cells.empty() || target_.empty()) return 0;
      const std::vector<Index> h(z.cells.begin(), z.cells.end());
      const Eigen::LLT<Eigen::MatrixXd> llt(innovation(h, z));
      if (llt.info() != Eigen::Success)
        throw Error("forecast", "the innovation covariance is not positive definite to working precision", "more noise");
      return llt.solve(Eigen::MatrixXd(m_(h, h))).trace();
    }

   private:
    [[nodiscard]] Eigen::MatrixXd innovation(const std::vector<Index>& h, const CellMeasurements& z) const {
      Eigen::MatrixXd s = k_(h, h);
      s.diagonal() += z.noise_variance;
      return s;
    }
    Eigen::MatrixXd k_, m_;
    std::vector<Index> target_;
  };

  [[nodiscard]] std::size_t bytes() const {
    return prior_.bytes() + history_.bytes() + static_cast<std::size_t>(2 * state_.mean.size() + factor_.size()) * sizeof(double);
  }
  void save(Sink& sink) const {
    history_.save(sink);
    sink.put(state_.mean);
    sink.put(state_.variance);
  }
  void load(Source& source, const NdTree& tree) {
    MeasurementHistory history;
    history.load(source, tree);
    Cells state;
    source.get(state.mean);
    source.get(state.variance);
    const auto n = static_cast<Index>(tree.size());
    if (state.mean.rows() != n || state.variance.rows() != n || !state.mean.allFinite() || !state.variance.allFinite())
      throw Error(source.where(), concat("a belief about ", state.mean.rows(), " cells"), concat(n, " finite means and variances"));
    history_ = std::move(history);
    state_ = std::move(state);
    factor_.resize(0, 0);
  }

 private:
  struct Cells {
    Eigen::VectorXd mean, variance;
  };

  static double checked(const Config& c) {
    Check check("Accumulated::Config");
    check(c.jitter >= 0 && c.jitter <= 1e-3, "jitter", c.jitter, "0 to 1e-3");
    check.done();
    return c.jitter;
  }
  static std::vector<NdTree::Leaf> leaves(const NdTree& tree) {
    std::vector<NdTree::Leaf> cells(tree.size());
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = tree[i];
    return cells;
  }
  // L L^T = the measurements' covariance.
  [[nodiscard]] Eigen::MatrixXd factorised(const MeasurementHistory& h, std::span<const NdTree::Leaf> cells) const {
    Eigen::MatrixXd s = rule_.covariance(prior_, h, cells, jitter_);
    s.diagonal().array() += h.noise_variance.array() + jitter_;
    dense::cholesky<double>(s, "Accumulated::fuse");
    return s;
  }
  // L^-1 K[measurements, cells].
  [[nodiscard]] Eigen::MatrixXd explained(const Eigen::MatrixXd& factor, const MeasurementHistory& h, std::span<const NdTree::Leaf> cells) const {
    Eigen::MatrixXd v = prior_.covariance(h.cell, cells);
    dense::solve_lower<double>(factor, v);
    return v;
  }
  [[nodiscard]] Eigen::VectorXd variances(std::span<const NdTree::Leaf> cells, const Eigen::MatrixXd& v) const {
    Eigen::VectorXd out(v.cols());
    for (Index i = 0; i < v.cols(); ++i) {
      const NdTree::Leaf& c = cells[static_cast<std::size_t>(i)];
      out[i] = std::max(0.0, prior_(c, c) - v.col(i).squaredNorm());
    }
    return out;
  }
  [[nodiscard]] Cells infer(const Eigen::MatrixXd& factor, const MeasurementHistory& h, std::span<const NdTree::Leaf> cells) const {
    const Eigen::MatrixXd v = explained(factor, h, cells);
    Eigen::VectorXd g = h.value.array() - prior_mean_;
    factor.template triangularView<Eigen::Lower>().solveInPlace(g);
    return {(v.transpose() * g).array() + prior_mean_, variances(cells, v)};
  }

  NodePrior prior_;
  double prior_mean_, jitter_;
  Rule rule_;
  MeasurementHistory history_;
  Cells state_;
  Eigen::MatrixXd factor_;  // of the last update's measurements, until it is settled
};

}  // namespace vantage
