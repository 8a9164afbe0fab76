// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <vantage/concepts/channels.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/field_image.hpp>
#include <vantage/maps/field/cell_sensor.hpp>
#include <vantage/maps/field/full.hpp>
#include <vantage/maps/field/kernel.hpp>
#include <vantage/maps/field/merging.hpp>
#include <vantage/maps/field/nd_tree.hpp>
#include <vantage/maps/field/prior.hpp>

namespace vantage {

/// Adaptive-resolution Gaussian-process map of a scalar field (chapter 3), by policies:
/// - Kernel: SquaredExponential (eq. 3.4) or a Matern, any SeparableKernel
/// - Cells: what a cell stands for, CellAverage (eq. 3.1) or CellCentre
/// - Belief: the covariance, Full<>, Latent<> or Diagonal
/// - Resolution: Merging<> (section 3.1.5) or Fixed<>, with the interest
/// - Sensor: CellSensor<> (section 3.1.3)
///
/// The field lies in the plane z = 0 [m]; values are in the field's own unit. `integrate` is one update (eqs. 3.6, 3.7)
/// and one merging; cost and memory are the Belief's. Const members may run concurrently.
template <SeparableKernel Kernel = SquaredExponential, class Cells = CellAverage, class Belief = Full<>,
          class Resolution = Merging<>, class Sensor = CellSensor<>>
class IntegralGp {
 public:
  using Measurement = FieldImage;
  struct Config {
    NdTree::Config tree = {};
    double prior_mean = 0.5;  ///< constant mu, finite
    Kernel kernel = {};
    Sensor sensor = {};
    Resolution resolution = {};
    typename Belief::Config belief = {};
  };

  IntegralGp() : IntegralGp(Config{}) {}
  /// Throws Error naming every bad value.
  explicit IntegralGp(const Config& config)
      : config_(validated(config)),
        tree_(config.tree),
        belief_(config.belief, tree_, Prior::make<Cells>(tree_, config.prior_mean, config.kernel)) {}

  /// Folds one image in. Throws Error, the map unchanged, on a bad image (see CellSensor::measure) or if the innovation
  /// covariance is not positive definite to working precision.
  void integrate(const FieldImage& image, Rng&) { fuse(config_.sensor.measure(tree_, image)); }

  /// The same for measurements of cells made elsewhere. Blank cells are remembered: the forecast expects nothing of
  /// them until a value is seen there.
  void fuse(const CellMeasurements& z) {
    check(z);
    if (!z.cells.empty()) belief_.fuse(tree_, z);
    for (const std::size_t i : z.cells) tree_.mark_measured(i);
    for (const std::size_t i : z.blank) tree_.mark_blank(i);
    if (z.cells.empty()) return;
    Merge merge;
    if (config_.resolution.plan(tree_, belief_, merge)) {
      belief_.merge(tree_, merge);
      tree_.merge(merge);
    }
    belief_.settle();
  }

  [[nodiscard]] Box3 bounds() const {
    const Box2& a = config_.tree.area;
    return {Eigen::Vector3d(a.min().x(), a.min().y(), 0), Eigen::Vector3d(a.max().x(), a.max().y(), 0)};
  }

  [[nodiscard]] std::size_t size() const { return tree_.size(); }
  [[nodiscard]] Box2 cell(std::size_t i) const { return tree_.box(i); }
  [[nodiscard]] double mean(std::size_t i) const { return belief_.mean(i); }
  [[nodiscard]] double variance(std::size_t i) const { return belief_.variance(i); }
  [[nodiscard]] std::size_t cell_at(const Eigen::Vector2d& p) const { return tree_.leaf_at(p); }
  [[nodiscard]] double coverage() const { return tree_.coverage(); }
  [[nodiscard]] const auto& interest() const { return config_.resolution.interest; }
  [[nodiscard]] const Config& config() const { return config_; }
  [[nodiscard]] const NdTree& tree() const { return tree_; }
  [[nodiscard]] const Belief& belief() const { return belief_; }
  /// Memory of the map itself.
  [[nodiscard]] std::size_t bytes() const { return tree_.bytes() + belief_.bytes(); }

  /// Eq. 3.13 for every view, were `given` measured before: the sum of variance that cells of interest lose, summed
  /// over cells (not weighed by area). A view whose footprint is off the map: 0. Throws Error on a view that does not
  /// look down. Candidates run concurrently.
  void forecast(Views given, Views views, std::span<double> reduction) const {
    std::vector<std::uint8_t> target(size());
    for (std::size_t i = 0; i < size(); ++i) target[i] = !tree_[i].blank && interest().target(mean(i), variance(i));
    typename Belief::Forecaster forecaster(belief_, tree_, target);
    for (const View& v : given) forecaster.given(covered(v));
    std::vector<CellMeasurements> z(views.size());
    parallel_for_blocks(views.size(), 16, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) z[i] = covered(views[i]);
    });
    forecaster.prepare(z);
    std::vector<std::size_t> order(views.size());  // the largest first, so that no thread ends with the long ones
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return z[a].cells.size() > z[b].cells.size(); });
    parallel_for(order.size(),
                 [&](std::size_t k) { reduction[order[k]] = std::max(0.0, forecaster.reduction(z[order[k]])); });
  }

  /// Posterior deviation of the cell under each pixel's centre; 0 where the pixel does not see the map.
  void render(const View& view, const Camera& camera, Rendering<channel::Uncertainty>& out) const {
    check_view(view, "IntegralGp::render");
    camera.validate();
    out.uncertainty.setZero(camera.height, camera.width);
    const Eigen::Vector3d eye = view.position();
    for (int v = 0; v < camera.height; ++v)
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = view.T_W_C.linear() * camera.ray(u + 0.5, v + 0.5);
        const double t = -eye.z() / ray.z();
        if (!(t > 0) || !std::isfinite(t)) continue;
        const Eigen::Vector2d p = (eye + t * ray).template head<2>();
        if (!config_.tree.area.contains(p)) continue;
        out.uncertainty(v, u) = static_cast<float>(std::sqrt(std::max(0.0, variance(tree_.leaf_at(p)))));
      }
  }

  void save(Sink& sink) const {
    sink.put(std::string_view(signature()));
    tree_.save(sink);
    belief_.save(sink);
  }
  /// For a map of the same type and config. Throws Error, the map unchanged, on anything else.
  void load(Source& source) {
    std::string signature;
    source.get(signature);
    if (signature != this->signature())
      throw Error(source.where(), concat("a map of another kind: ", signature.substr(0, 200)), this->signature());
    NdTree tree(config_.tree);
    tree.load(source);
    Belief belief = belief_;
    belief.load(source, tree);
    tree_ = std::move(tree);
    belief_ = std::move(belief);
  }

 private:
  static const Config& validated(const Config& c) {
    Check check("IntegralGp::Config");
    check.finite("prior_mean", c.prior_mean);
    check.done();
    c.kernel.validate();
    c.sensor.validate();
    c.resolution.interest.validate();
    return c;
  }
  void check(const CellMeasurements& z) const {
    const auto l = static_cast<Eigen::Index>(z.cells.size());
    if (z.value.size() != l || z.noise_variance.size() != l)
      throw Error("IntegralGp::fuse",
                  concat(l, " cells, ", z.value.size(), " values, ", z.noise_variance.size(), " variances"),
                  "as many of each");
    for (std::size_t k = 0; k < z.cells.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      if (z.cells[k] >= size() || (k > 0 && z.cells[k] <= z.cells[k - 1]))
        throw Error("IntegralGp::fuse", concat("cell ", z.cells[k]), concat("ascending cells below ", size()));
      if (!std::isfinite(z.value[i]) || !std::isfinite(z.noise_variance[i]) || !(z.noise_variance[i] > 0))
        throw Error(
            "IntegralGp::fuse",
            concat("cell ", z.cells[k], " measured as ", z.value[i], " with noise variance ", z.noise_variance[i]),
            "a finite value and a variance > 0");
    }
    for (const std::size_t i : z.blank)
      if (i >= size()) throw Error("IntegralGp::fuse", concat("blank cell ", i), concat("below ", size()));
  }
  [[nodiscard]] CellMeasurements covered(const View& v) const {
    CellMeasurements z = config_.sensor.covered(tree_, config_.sensor.camera.footprint(v), v.position().z());
    std::size_t kept = 0;
    for (std::size_t k = 0; k < z.cells.size(); ++k) {
      if (tree_[z.cells[k]].blank) continue;
      z.noise_variance[static_cast<Eigen::Index>(kept)] = z.noise_variance[static_cast<Eigen::Index>(k)];
      z.cells[kept++] = z.cells[k];
    }
    z.cells.resize(kept);
    z.noise_variance = Eigen::VectorXd(z.noise_variance.head(static_cast<Eigen::Index>(kept)));
    return z;
  }
  // What the saved numbers depend on.
  [[nodiscard]] std::string signature() const {
    const NdTree::Config& t = config_.tree;
    return concat("IntegralGp ", Kernel::name, " ", config_.kernel.variance, " ", config_.kernel.length_m, " ",
                  Cells::name, " ", Belief::name, " ", Resolution::name, " ", t.area.min().transpose(), " ",
                  t.area.max().transpose(), " ", t.branching, "^", t.depth, " ", config_.prior_mean);
  }

  Config config_;
  NdTree tree_;
  Belief belief_;
};

}  // namespace vantage
