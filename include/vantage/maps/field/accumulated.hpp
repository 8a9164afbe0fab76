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
    return cell.size() * sizeof(NdTree::Leaf) + 2 * cell.size() * sizeof(double) +
           batch_end.size() * sizeof(std::size_t);
  }
  void save(Sink& sink) const {
    std::vector<std::int32_t> level, ix, iy;
    for (const NdTree::Leaf& c : cell) {
      level.push_back(c.level);
      ix.push_back(c.ix);
      iy.push_back(c.iy);
    }
    sink.put(level);
    sink.put(ix);
    sink.put(iy);
    sink.put(value);
    sink.put(noise_variance);
    sink.put(std::vector<std::uint64_t>(batch_end.begin(), batch_end.end()));
  }
  void load(Source& source, const NdTree& tree) {
    MeasurementHistory h;
    std::vector<std::int32_t> level, ix, iy;
    std::vector<std::uint64_t> end;
    source.get(level);
    source.get(ix);
    source.get(iy);
    Eigen::MatrixXd y, r;  // a hostile file may hold any shape
    source.get(y);
    source.get(r);
    source.get(end);
    const std::size_t n = level.size();
    const auto rows = static_cast<Eigen::Index>(n);
    bool sound = ix.size() == n && iy.size() == n && y.rows() == rows && r.rows() == rows &&
                 (n == 0 || (y.cols() == 1 && r.cols() == 1));
    if (sound) {
      h.value = Eigen::Map<const Eigen::VectorXd>(y.data(), y.size());
      h.noise_variance = Eigen::Map<const Eigen::VectorXd>(r.data(), r.size());
    }
    sound = sound && h.value.allFinite() && h.noise_variance.allFinite() && (h.noise_variance.array() > 0).all() &&
            std::is_sorted(end.begin(), end.end()) && (end.empty() ? n == 0 : end.back() == n);
    for (std::size_t k = 0; sound && k < n; ++k) {
      sound = level[k] >= 0 && level[k] <= tree.config().depth && ix[k] >= 0 && iy[k] >= 0 &&
              ix[k] < tree.side(level[k]) && iy[k] < tree.side(level[k]);
      h.cell.push_back({level[k], ix[k], iy[k], true});
    }
    if (!sound)
      throw Error(source.where(), concat("a history of ", n, " measurements that is not sound"),
                  "cells, finite values, positive variances");
    h.batch_end.assign(end.begin(), end.end());
    *this = std::move(h);
  }
};

/// What regression says about n cells: their means, and their covariance as K - R^T R or, where that is cheaper, as R^T
/// R.
struct CellPosterior {
  Eigen::VectorXd mean;
  Eigen::MatrixXd root;
  bool reduces_prior = true;

  /// Variance of a cell, or of an average over cells; `prior` is its prior variance, `x` its column of the root.
  template <class Column>
  [[nodiscard]] double variance(double prior, const Column& x) const {
    return reduces_prior ? std::max(0.0, prior - x.squaredNorm()) : x.squaredNorm();
  }
};

/// A belief that keeps every measurement and infers the cells from scratch after each update, eqs. 2.7 and 2.8 with
/// cells for points. `Rule` says how, and what becomes of measurements when cells merge (see Batch and Committee):
///
///     CellPosterior infer(prior, prior_mean, history, cells, jitter) const;
///     void merge(history, tree, merge) const;
///     static constexpr bool infers_after_merge;      // or else merged cells' beliefs are averaged
///
/// Between updates, memory is O(l + n) for l measurements and n cells.
template <class Rule>
class Accumulated {
  using Index = Eigen::Index;

 public:
  static constexpr std::string_view name = Rule::name;
  struct Config {
    double jitter = 1e-8;  ///< added to covariances' diagonals, in shares of the prior variance, 0 to 1e-3
  };

  Accumulated(const Config& config, const NdTree& tree, const Prior& prior)
      : prior_(tree, prior),
        prior_mean_(prior.mean),
        jitter_(checked(config) * prior.variance),
        mean_(Eigen::VectorXd::Constant(static_cast<Index>(tree.size()), prior.mean)),
        variance_(mean_.size()) {
    for (std::size_t i = 0; i < tree.size(); ++i) variance_[static_cast<Index>(i)] = prior_(tree[i], tree[i]);
  }

  [[nodiscard]] double mean(std::size_t i) const { return mean_[static_cast<Index>(i)]; }
  [[nodiscard]] double variance(std::size_t i) const { return variance_[static_cast<Index>(i)]; }
  /// Variances of weighted averages over leaves; only within an update, between `fuse` and `settle`.
  [[nodiscard]] std::vector<double> parent_variances(std::span<const ParentCell> parents,
                                                     std::span<const double> weight) const {
    std::vector<double> out;
    for (const ParentCell& p : parents) out.push_back(average_variance(p.leaves, weight));
    return out;
  }
  [[nodiscard]] const MeasurementHistory& history() const { return history_; }

  /// Adds measurements and infers all cells. Throws Error, changing nothing, if the measurements' covariance is not
  /// positive definite to working precision.
  void fuse(const NdTree& tree, const CellMeasurements& z) {
    MeasurementHistory history = history_;
    history.append(tree, z);
    infer(history, leaves(tree));
    history_ = std::move(history);
  }
  void merge(const NdTree& tree, const Merge& m) {
    MeasurementHistory history = history_;
    rule_.merge(history, tree, m);
    std::vector<NdTree::Leaf> cells;
    for (const LeafGroup& g : m.groups) cells.push_back(tree.parent_of(g));
    if constexpr (Rule::infers_after_merge) {
      infer(history, cells);
    } else {
      Eigen::VectorXd mean = Eigen::VectorXd::Zero(static_cast<Index>(cells.size())), variance(mean.size());
      for (std::size_t g = 0; g < cells.size(); ++g) {
        for (std::size_t i = m.groups[g].first; i < m.groups[g].last; ++i)
          mean[static_cast<Index>(g)] += m.weight[i] * this->mean(i);
        variance[static_cast<Index>(g)] = average_variance(m.groups[g], m.weight);
      }
      mean_ = std::move(mean);
      variance_ = std::move(variance);
    }
    history_ = std::move(history);
  }
  void settle() {
    posterior_ = {};
    cells_ = {};
  }

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
    void prepare(std::span<const CellMeasurements>) {
      m_.setZero(k_.rows(), k_.cols());
      dense::add_gram<double>(m_, Eigen::MatrixXd(k_(target_, Eigen::all)), 1.0);
      m_.template triangularView<Eigen::StrictlyUpper>() = m_.transpose();
    }
    /// tr(S^-1 M[H, H]), M = K[:, HS] K[HS, :].
    [[nodiscard]] double reduction(const CellMeasurements& z) const {
      if (z.cells.empty() || target_.empty()) return 0;
      const std::vector<Index> h(z.cells.begin(), z.cells.end());
      const Eigen::LLT<Eigen::MatrixXd> llt(innovation(h, z));
      if (llt.info() != Eigen::Success)
        throw Error("forecast", "the innovation covariance is not positive definite to working precision",
                    "more noise");
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
    return prior_.bytes() + history_.bytes() +
           static_cast<std::size_t>(2 * mean_.size() + posterior_.root.size()) * sizeof(double) +
           cells_.capacity() * sizeof(NdTree::Leaf);
  }
  void save(Sink& sink) const {
    history_.save(sink);
    sink.put(mean_);
    sink.put(variance_);
  }
  void load(Source& source, const NdTree& tree) {
    MeasurementHistory history;
    history.load(source, tree);
    Eigen::VectorXd mean, variance;
    load_column(source, mean, tree.size());
    load_column(source, variance, tree.size());
    history_ = std::move(history);
    mean_ = std::move(mean);
    variance_ = std::move(variance);
    settle();
  }

 private:
  static double checked(const Config& c) {
    Check check("Accumulated::Config");
    check(c.jitter >= 0 && c.jitter <= 1e-3, "jitter", c.jitter, "0 to 1e-3");
    check.done();
    return c.jitter;
  }
  static void load_column(Source& source, Eigen::VectorXd& v, std::size_t n) {
    Eigen::MatrixXd m;  // a hostile file may hold any shape
    source.get(m);
    if (m.cols() != 1 || m.rows() != static_cast<Index>(n) || !m.allFinite())
      throw Error(source.where(), concat(m.rows(), " x ", m.cols(), " values"), concat(n, " finite ones"));
    v = m;
  }
  static std::vector<NdTree::Leaf> leaves(const NdTree& tree) {
    std::vector<NdTree::Leaf> cells(tree.size());
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = tree[i];
    return cells;
  }
  void infer(const MeasurementHistory& history, std::vector<NdTree::Leaf> cells) {
    CellPosterior p = rule_.infer(prior_, prior_mean_, history, cells, jitter_);
    Eigen::VectorXd variance(p.mean.size());
    for (Index i = 0; i < variance.size(); ++i) {
      const NdTree::Leaf& c = cells[static_cast<std::size_t>(i)];
      variance[i] = p.variance(prior_(c, c), p.root.col(i));
    }
    mean_ = p.mean;
    variance_ = std::move(variance);
    posterior_ = std::move(p);
    cells_ = std::move(cells);
  }
  // Posterior covariance of the leaves, n x n, inferred anew.
  [[nodiscard]] Eigen::MatrixXd covariance_matrix(const NdTree& tree) const {
    const std::vector<NdTree::Leaf> cells = leaves(tree);
    Eigen::MatrixXd k = prior_.covariance(cells);
    if (history_.size() != 0) {
      const CellPosterior p = rule_.infer(prior_, prior_mean_, history_, cells, jitter_);
      if (!p.reduces_prior) k.setZero();
      dense::add_gram<double>(k, p.root, p.reduces_prior ? -1.0 : 1.0);
    }
    k.template triangularView<Eigen::StrictlyUpper>() = k.transpose();
    return k;
  }
  // q C q^T for a weighted average over leaves.
  [[nodiscard]] double average_variance(const LeafGroup& g, std::span<const double> weight) const {
    const auto first = static_cast<Index>(g.first), count = static_cast<Index>(g.last - g.first);
    const Eigen::Map<const Eigen::VectorXd> q(weight.data() + first, count);
    double prior = 0;
    if (posterior_.reduces_prior)
      for (std::size_t j = g.first; j < g.last; ++j) {
        double below = 0;
        for (std::size_t i = j + 1; i < g.last; ++i) below += weight[i] * prior_(cells_[i], cells_[j]);
        prior += weight[j] * (weight[j] * prior_(cells_[j], cells_[j]) + 2 * below);
      }
    return posterior_.variance(prior, posterior_.root.middleCols(first, count) * q);
  }

  NodePrior prior_;
  double prior_mean_, jitter_;
  Rule rule_;
  MeasurementHistory history_;
  Eigen::VectorXd mean_, variance_;
  CellPosterior posterior_;  // of the last update's cells, until it is settled
  std::vector<NdTree::Leaf> cells_;
};

}  // namespace vantage
