// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/map.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/maps/surfel/choose_batch.hpp>
#include <vantage/maps/surfel/confidence.hpp>
#include <vantage/maps/surfel/densify.hpp>
#include <vantage/maps/surfel/low_confidence.hpp>
#include <vantage/maps/surfel/pass_pool.hpp>
#include <vantage/maps/surfel/prune.hpp>
#include <vantage/maps/surfel/render_surfels.hpp>
#include <vantage/maps/surfel/surfel_trainer.hpp>
#include <vantage/maps/surfel/tile_rasteriser.hpp>
#include <vantage/maps/surfel/training_frame.hpp>
#include <vantage/maps/voxel/voxel_presets.hpp>

namespace vantage {

/// Gaussian surfels with confidence, and the voxel map that says where a robot can go (section 6.1.1), by policies:
/// - Rasteriser: how surfels are drawn and differentiated, a SurfelRasteriser
/// - Confidence: what k is, a SurfelConfidence
/// - Variation: which smoothness of normals is trained for, EdgeAwareVariation or PlainVariation
/// - Voxels: a VoxelMap, which learns of the same frames
///
/// Models UncertainMap (1 - confidence), renders Colour, Depth, Opacity, Normal, Confidence and Uncertainty; by its
/// voxels NavigableMap, CoverageMap and RegionMap<frontier>; RegionMap<low_confidence>, FisherMap, RefinableMap,
/// ForetellsRefusal and Persistent. Memory: 56 bytes a surfel and 4 more a number of Confidence, which is 76 for
/// IncrementalConfidence, 84 for DispersionConfidence; once it was trained 161 more (Adam's two moments 104, the
/// gradient 57); 7 a pixel of every frame; the voxels; and the rasteriser's passes, one for each that ran at once,
/// which grow with the surfels in sight. Const members may run concurrently; every member uses all threads, and its
/// result does not depend on their number.
template <SurfelRasteriser Rasteriser = TileRasteriser<>, SurfelConfidence Confidence = IncrementalConfidence,
          class Variation = EdgeAwareVariation, NavigableMap Voxels = PresetVoxelMap<preset::reference>>
class SurfelMap {
 public:
  using Measurement = Frame;

  struct Config {
    typename Voxels::Config voxels = {};  ///< with the bounds of both; its range is the voxels' alone
    double far_m = 5;                     ///< depth beyond says nothing of surfels, and d_far of confidence; > 0
    SurfelScale scale = {};
    DensifyConfig densify = {};
    LossWeights loss = {};
    LearningRates rates = {};
    BatchConfig batch = {};
    int iterations = 10;  ///< of training after every frame, >= 0
    PruneConfig prune = {};
    LowConfidenceConfig low_confidence = {};
    std::size_t max_bytes = std::size_t{4} << 30;  ///< of surfels and frames: refuse a frame that might need more
  };

  /// Throws Error naming what is bad.
  explicit SurfelMap(const Config& config)
      : config_(validated(config)), voxels_(config.voxels), trainer_(config.loss, config.rates) {
    surfels_.scale = config.scale;
  }

  /// The mapping step (section 6.1.2): updates the voxels, spawns surfels, trains, updates the confidence of what the
  /// frame saw, and every few frames gives up what no frame sees. A frame without any depth up to far_m changes the
  /// voxels alone, and is not kept. Throws Error, and changes nothing, as `check` does.
  void integrate(const Frame& frame, Rng& rng) {
    check(frame);
    voxels_.integrate(frame, rng);
    Frame seen = frame;
    const auto far = static_cast<float>(config_.far_m);
    for (float& d : std::span(seen.depth.data(), static_cast<std::size_t>(seen.depth.size())))
      if (d > far) d = std::numeric_limits<float>::quiet_NaN();
    if (seen.depth.isNaN().all()) return;
    frames_.reserve(frames_.size() + 1);
    passes_.lend([&](auto& pass) {
      TrainingImages drawn;
      rasteriser_.forward(surfels_, {.view = frame.view, .camera = frame.camera}, pass, drawn);
      densify(surfels_, seen, drawn, config_.densify, rng);
      frames_.emplace_back(seen);
      ++taken_;
      trainer_(surfels_, frames_, config_.batch, config_.iterations, rasteriser_, pass, rng);
      state_.resize(surfels_.size() * Confidence::numbers);
      std::vector<float> weight(surfels_.size());
      const auto look = [&](const TrainingFrame& from) {
        rasteriser_.visibility(surfels_, {.view = from.view, .camera = from.camera, .front_only = true}, pass,
                               from.metres, weight);
      };
      look(frames_.back());
      observe<Confidence>(surfels_, state_, weight, static_cast<float>(config_.prune.least_weight),
                          frame.view.position().cast<float>(), far);
      if (taken_ % static_cast<std::uint64_t>(config_.prune.every_frames) != 0) return;
      for (std::size_t i = 0; i + 1 < frames_.size(); ++i) look(frames_[i]);
      prune(surfels_, state_, Confidence::numbers, weight, config_.prune);
    });
  }
  /// Throws Error if the frame is not valid (Frame::validate), lacks colour or depth, is refused by the voxels, or
  /// might need more memory than max_bytes. O(pixels).
  void check(const Frame& frame) const {
    constexpr std::string_view where = "SurfelMap::integrate";
    frame.validate(where);
    if (frame.colour.empty() || frame.depth.size() == 0)
      throw Error(where, "a frame without colour or without depth", "both");
    voxels_.check(frame);
    const std::size_t pixels = static_cast<std::size_t>(frame.depth.size());
    const std::size_t needed = own_bytes() + pixels * (7 + bytes_per_surfel);
    if (needed > config_.max_bytes)
      throw Error(where, concat("surfels and frames of up to ", needed, " bytes"),
                  concat("at most max_bytes = ", config_.max_bytes));
  }
  /// Trains on, so many iterations, on the frames it has. Nothing happens before the first.
  void refine(int steps, Rng& rng) {
    passes_.lend([&](auto& pass) { trainer_(surfels_, frames_, config_.batch, steps, rasteriser_, pass, rng); });
  }

  [[nodiscard]] const Config& config() const { return config_; }
  [[nodiscard]] const Surfels& surfels() const { return surfels_; }
  [[nodiscard]] const std::vector<TrainingFrame>& frames() const { return frames_; }
  [[nodiscard]] const Voxels& voxels() const { return voxels_; }
  [[nodiscard]] Box3 bounds() const { return voxels_.bounds(); }
  /// Of surfels, frames and voxels; what training needs for itself is not counted.
  [[nodiscard]] std::size_t bytes() const { return own_bytes() + voxels_.bytes(); }

  /// Draws Colour, Depth, Opacity, Normal, Confidence and Uncertainty, in any combination; see render_surfels.
  template <class... Channels>
  void render(const View& view, const Camera& camera, Rendering<Channels...>& out) const
      requires(renders_surfels<Channels...>) {
    passes_.lend([&](auto& pass) { render_surfels(surfels_, rasteriser_, pass, view, camera, out); });
  }

  /// 13 a surfel, in the order of surfel::Parameter.
  [[nodiscard]] std::size_t parameters() const { return surfels_.size() * surfel::parameters; }
  /// Adds the sum over pixels of (sum over channels of dC / dparameter)^2; see the rasteriser for which parameters.
  /// Throws Error unless `diagonal` has parameters() numbers.
  void fisher(const View& view, const Camera& camera, std::span<double> diagonal) const {
    if (diagonal.size() != parameters())
      throw Error("SurfelMap::fisher", concat("a diagonal of ", diagonal.size()), concat(parameters(), " numbers"));
    passes_.lend([&](auto& pass) { rasteriser_.fisher(surfels_, {.view = view, .camera = camera}, pass, diagonal); });
  }

  // What the voxels know.
  [[nodiscard]] Space at(const Eigen::Vector3d& p) const { return voxels_.at(p); }
  [[nodiscard]] const VoxelGrid& grid() const { return voxels_.grid(); }
  [[nodiscard]] Space state(const Eigen::Vector3i& voxel) const { return voxels_.state(voxel); }
  [[nodiscard]] std::span<const Eigen::Vector3i> known_blocks() const { return voxels_.known_blocks(); }
  [[nodiscard]] VoxelBits free_in(const Eigen::Vector3i& block) const { return voxels_.free_in(block); }
  [[nodiscard]] VoxelBits occupied_in(const Eigen::Vector3i& block) const { return voxels_.occupied_in(block); }
  [[nodiscard]] VoxelBits unexplored_in(const Eigen::Vector3i& block) const { return voxels_.unexplored_in(block); }
  [[nodiscard]] double clearance_m() const { return voxels_.clearance_m(); }
  [[nodiscard]] bool navigable(const Eigen::Vector3i& voxel) const { return voxels_.navigable(voxel); }
  [[nodiscard]] VoxelBits navigable_in(const Eigen::Vector3i& block) const { return voxels_.navigable_in(block); }
  [[nodiscard]] double coverage() const { return voxels_.coverage(); }
  [[nodiscard]] std::vector<Region> regions(frontier kind) const { return voxels_.regions(kind); }
  /// See low_confidence_regions.
  [[nodiscard]] std::vector<Region> regions(low_confidence) const {
    return low_confidence_regions(surfels_, voxels_, config_.low_confidence);
  }

  void save(Sink& sink) const {
    sink.put(std::string_view(signature()));
    sink.put(taken_);
    for (const auto& values : surfels_.parameter) sink.put(values);
    sink.put(surfels_.confidence);
    sink.put(state_);
    sink.put(static_cast<std::uint64_t>(frames_.size()));
    for (const TrainingFrame& f : frames_) f.save(sink);
    voxels_.save(sink);
  }
  /// For a map of the same scale, policies and voxels; what else the config says may differ. Throws Error, the map
  /// unchanged, on anything else.
  void load(Source& source) {
    std::string signature;
    source.get(signature);
    if (signature != this->signature())
      throw Error(source.where(), concat("a map of another kind: ", signature.substr(0, 200)), this->signature());
    const auto taken = source.get<std::uint64_t>();
    Surfels surfels;
    surfels.scale = surfels_.scale;
    for (auto& values : surfels.parameter) source.get(values);
    source.get(surfels.confidence);
    std::vector<float> state;
    source.get(state);
    bool fits = state.size() == surfels.size() * Confidence::numbers;
    for (const auto& values : surfels.parameter) fits &= values.size() == surfels.size();
    if (!fits) throw Error(source.where(), "surfels of unequal numbers of parameters", "as many of each");
    std::vector<TrainingFrame> frames;
    for (auto n = source.get<std::uint64_t>(); n > 0; --n) frames.emplace_back().load(source);
    voxels_.load(source);
    taken_ = taken;
    surfels_ = std::move(surfels);
    state_ = std::move(state);
    frames_ = std::move(frames);
  }

 private:
  static constexpr std::size_t bytes_per_surfel = sizeof(float) * (surfel::parameters + 1 + Confidence::numbers);

  static const Config& validated(const Config& c) {
    Check check("SurfelMap::Config");
    check.positive("far_m", c.far_m);
    check.positive("scale.unit_m", c.scale.unit_m);
    check(c.scale.max_m > 0, "scale.max_m", c.scale.max_m, "> 0");
    check(c.iterations >= 0, "iterations", c.iterations, ">= 0");
    check.done();
    c.densify.validate();
    c.batch.validate();
    c.prune.validate();
    c.low_confidence.validate();
    return c;
  }
  [[nodiscard]] std::size_t own_bytes() const {
    std::size_t bytes = surfels_.size() * bytes_per_surfel;
    for (const TrainingFrame& f : frames_) bytes += f.bytes();
    return bytes;
  }
  [[nodiscard]] std::string signature() const {
    return concat("SurfelMap 1 ", Confidence::name, " of ", surfels_.scale.unit_m, " to ", surfels_.scale.max_m, " m");
  }

  Config config_;
  Voxels voxels_;
  Surfels surfels_;
  std::vector<float> state_;  // of the confidence, Confidence::numbers a surfel
  std::vector<TrainingFrame> frames_;
  std::uint64_t taken_ = 0;  // frames, ever
  Rasteriser rasteriser_;
  SurfelTrainer<Rasteriser, Variation> trainer_;
  mutable PassPool<typename Rasteriser::Pass> passes_;
};

}  // namespace vantage
