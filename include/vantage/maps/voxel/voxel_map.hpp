// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/map.hpp>
#include <vantage/core/assert.hpp>
#include <vantage/core/bytes.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/frame.hpp>
#include <vantage/geometry/voxel_bits.hpp>
#include <vantage/geometry/voxel_grid.hpp>
#include <vantage/maps/voxel/class_counts.hpp>
#include <vantage/maps/voxel/clearance.hpp>
#include <vantage/maps/voxel/frame_voxels.hpp>
#include <vantage/maps/voxel/known_voxels.hpp>
#include <vantage/maps/voxel/projective.hpp>
#include <vantage/maps/voxel/ray_cast.hpp>
#include <vantage/maps/voxel/render_voxels.hpp>
#include <vantage/maps/voxel/voxel_blocks.hpp>

namespace vantage {

/// What a voxel map with these semantics knows of 512 voxels.
template <class Semantics>
struct ClassedBlock : VoxelBlock {
  [[no_unique_address]] typename Semantics::Block classes;
};

/// Probabilistic occupancy of a box in voxels (ch. 6), by policies:
/// - Update: how depth changes it and what free and occupied mean, Projective or RayCast
/// - Semantics: what it keeps of labels, NoClasses or ClassCounts<n>
/// - Clearance: where a robot fits, BallInFreeVoxels or NoOccupiedCentreInBall
///
/// A voxel is explored once a frame hit or passed it. What can be asked of voxels: KnownVoxels. Memory: 4 bytes for
/// each block of 8^3 voxels that fits into the box, and 4.65 bytes a voxel (with n classes 4 n more) of the blocks that
/// were touched, in slabs of 64 (fewer if these are large). Models UncertainMap, DepthMap, NavigableMap,
/// RegionMap<frontier>, CoverageMap, ForetellsRefusal and Persistent; with classes Renders<channel::Semantics>. Const
/// members may run concurrently; `integrate` uses all threads, and its result does not depend on their number.
template <class Update = RayCast, class Semantics = NoClasses, class Clearance = BallInFreeVoxels>
class VoxelMap : public KnownVoxels<ClassedBlock<Semantics>, Clearance> {
  using Block = ClassedBlock<Semantics>;
  using Known = KnownVoxels<Block, Clearance>;
  using Known::grid_, Known::blocks_;

 public:
  using Measurement = Frame;

  struct Config {
    Box3 bounds = {};          ///< what to map [m]; the grid holds it
    double voxel_m = 0.2;      ///< > 0
    double clearance_m = 0.3;  ///< that the robot needs around its centre, >= 0, at most 24 voxels
    DepthRange range = {};
    Update update = {};
    [[no_unique_address]] Semantics semantics = {};
    /// Refuse what would need more memory for index and blocks: bytes(). What a frame needs is not counted: about 210
    /// bytes for each block of the box around what its camera sees, and 9 for each that was ever touched.
    std::size_t max_bytes = std::size_t{4} << 30;
  };

  /// Throws Error naming what is bad, or if the box holds more voxels than max_bytes (or 2^31 blocks) allow.
  explicit VoxelMap(const Config& config)
      : Known(Update::grid(validated(config).bounds, config.voxel_m), config.clearance_m, config.max_bytes),
        config_(config) {}

  /// Folds a frame in; its colours are not read. A frame without any valid depth changes nothing, or clears space as
  /// far as DepthRange::no_return_m says. Throws Error, and changes nothing, as `check` does.
  void integrate(const Frame& frame) {
    seen_.reset(region(frame));
    config_.update.mark(grid_, frame, config_.range, seen_);
    make_touched();
    fold(frame);
    if constexpr (Semantics::classes > 0) count_classes(frame);
    Known::derive(slots_, changed_);
  }
  void integrate(const Frame& frame, Rng&) { integrate(frame); }
  /// Throws Error if camera, pose or a depth are bad, if there is no depth, a label beyond the classes, or if the
  /// blocks around what the camera sees might need more memory than max_bytes. O(pixels).
  void check(const Frame& frame) const { (void)region(frame); }

  [[nodiscard]] const Config& config() const { return config_; }

  /// Draws Depth, Entropy, Uncertainty, InformationGain and, with classes, Semantics, in any combination; see
  /// render_voxels. All but depth reach as far as the depth range.
  template <class... Channels>
  void render(const View& view, const Camera& camera, Rendering<Channels...>& out) const
      requires(renders_voxels<Semantics, Channels...>) {
    render_voxels(*this, config_.update.one_voxel(), config_.semantics, config_.range.max_m, view, camera, out);
  }

  /// Pixels of each class seen in a voxel of the grid; none of it before any was.
  [[nodiscard]] std::array<std::uint32_t, Semantics::classes> class_counts(const Eigen::Vector3i& voxel) const
      requires(Semantics::classes > 0) {
    std::array<std::uint32_t, Semantics::classes> counts{};
    if (const Block* b = blocks_.find(block_of(voxel)))
      std::ranges::copy(b->classes.of(local_of(voxel)), counts.begin());
    return counts;
  }
  /// The class seen most often in a voxel of the grid, the lowest of several; 0 = unknown.
  [[nodiscard]] std::uint16_t label(const Eigen::Vector3i& voxel) const requires(Semantics::classes > 0) {
    const Block* b = blocks_.find(block_of(voxel));
    if (!b) return 0;
    const auto counts = b->classes.of(local_of(voxel));
    return static_cast<std::uint16_t>(std::ranges::max_element(counts) - counts.begin());
  }
  /// How likely it is that what is in a voxel of the grid is of a class (below Semantics::classes): the mean of a
  /// Dirichlet posterior, see ClassCounts. They sum to 1 over all classes, 0 = unknown included; label() has the most.
  [[nodiscard]] double class_probability(const Eigen::Vector3i& voxel, std::uint16_t label) const
      requires(Semantics::classes > 0) {
    VANTAGE_ASSERT(label < Semantics::classes);
    const Block* b = blocks_.find(block_of(voxel));
    return config_.semantics.probability(b ? &b->classes : nullptr, local_of(voxel), label);
  }

  void save(Sink& sink) const;
  /// For a map of the same grid and policies; what else the config says may differ. Throws Error, the map unchanged, on
  /// anything else.
  void load(Source& source);

 private:
  static const Config& validated(const Config& c) {
    Check check("VoxelMap::Config");
    check.not_negative("clearance_m", c.clearance_m);
    check.done();
    c.range.validate();
    c.update.validate();
    c.semantics.validate();
    return c;
  }
  // Checks a frame, and where it can change something.
  [[nodiscard]] FrameVoxels::Region region(const Frame& frame) const;
  // Blocks that the frame hits or passes, as numbers of seen_; those not known yet are made.
  void make_touched();
  void fold(const Frame& frame);
  void count_classes(const Frame& frame) requires(Semantics::classes > 0);
  [[nodiscard]] std::string signature() const {
    return concat("VoxelMap ", Update::name, " ", Semantics::name, " ", Semantics::classes, " ",
                  grid_.size().transpose(), " voxels of ", grid_.voxel_m().transpose(), " from ",
                  grid_.origin().transpose());
  }

  Config config_;
  // Kept from frame to frame for their memory.
  FrameVoxels seen_;
  std::vector<std::size_t> touched_;
  std::vector<std::size_t> slots_;     // of those
  std::vector<std::uint8_t> changed_;  // whether those did
};

template <class Update, class Semantics, class Clearance>
FrameVoxels::Region VoxelMap<Update, Semantics, Clearance>::region(const Frame& frame) const {
  constexpr std::string_view where = "VoxelMap::integrate";
  frame.camera.validate();
  check_view(frame.view, where);
  const auto sized = [&](const auto& image, std::string_view name) {
    if (image.rows() != frame.camera.height || image.cols() != frame.camera.width)
      throw Error(where, concat(name, " of ", image.cols(), " x ", image.rows(), " px"),
                  concat("the camera's ", frame.camera.width, " x ", frame.camera.height));
  };
  sized(frame.depth, "depth");
  if constexpr (Semantics::classes > 0)
    if (frame.labels.size() != 0) {
      sized(frame.labels, "labels");
      if (const auto most = frame.labels.maxCoeff(); most >= Semantics::classes)
        throw Error(where, concat("label ", most), concat("below ", Semantics::classes));
    }
  FrameVoxels::Region r = FrameVoxels::around(grid_, frame, config_.range);
  std::size_t missing = 0;
  for (int z = 0; z < r.size.z(); ++z)
    for (int y = 0; y < r.size.y(); ++y)
      for (int x = 0; x < r.size.x(); ++x) missing += blocks_.slot(r.first + Eigen::Vector3i(x, y, z)) < 0;
  blocks_.check_room(missing);
  return r;
}

template <class Update, class Semantics, class Clearance>
void VoxelMap<Update, Semantics, Clearance>::make_touched() {
  touched_.clear();
  slots_.clear();
  for (std::size_t i = 0; i < seen_.count(); ++i)
    if (seen_.hits[i].any() || seen_.passes[i].any()) touched_.push_back(i);
  const auto missing = std::ranges::count_if(touched_, [&](std::size_t i) { return blocks_.slot(seen_.block(i)) < 0; });
  blocks_.reserve(static_cast<std::size_t>(missing));
  for (const std::size_t i : touched_) {
    const Eigen::Vector3i block = seen_.block(i);
    if (blocks_.slot(block) < 0) blocks_.make(block);
    slots_.push_back(static_cast<std::size_t>(blocks_.slot(block)));
  }
}

template <class Update, class Semantics, class Clearance>
void VoxelMap<Update, Semantics, Clearance>::fold(const Frame& frame) {
  changed_.assign(touched_.size(), 0);
  parallel_for_blocks(touched_.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const VoxelBits &hit = seen_.hits[touched_[k]], &pass = seen_.passes[touched_[k]];
      Block& b = blocks_[slots_[k]];
      config_.update.fold(grid_, frame.view, seen_.block(touched_[k]), hit, pass, b.log_odds);
      const VoxelBits explored = b.explored | hit | pass;
      const VoxelBits free = explored & config_.update.free(b.log_odds),
                      occupied = explored & config_.update.occupied(b.log_odds);
      changed_[k] = !(explored == b.explored && free == b.free && occupied == b.occupied);
      b.explored = explored;
      b.free = free;
      b.occupied = occupied;
    }
  });
}

template <class Update, class Semantics, class Clearance>
void VoxelMap<Update, Semantics, Clearance>::count_classes(const Frame& frame) requires(Semantics::classes > 0) {
  if (frame.labels.size() == 0) return;
  seen_.template for_pixels<false>(
      grid_, frame, config_.range, [&](Eigen::Index first, std::span<const std::int32_t> numbers) {
        std::int32_t last = -1;
        Block* block = nullptr;
        for (std::size_t i = 0; i < numbers.size(); ++i) {
          const std::uint16_t label = frame.labels.data()[first + static_cast<Eigen::Index>(i)];
          if (numbers[i] < 0 || label == 0) continue;
          if (const std::int32_t number = numbers[i] >> 9; number != last || !block) {
            last = number;
            block = &blocks_[static_cast<std::size_t>(blocks_.slot(seen_.block(static_cast<std::size_t>(number))))];
          }
          block->classes.add(static_cast<std::size_t>(numbers[i] & 511), label);
        }
      });
  parallel_for_blocks(slots_.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) blocks_[slots_[k]].classes.settle();
  });
}

template <class Update, class Semantics, class Clearance>
void VoxelMap<Update, Semantics, Clearance>::save(Sink& sink) const {
  sink.put(std::string_view(signature()));
  // A block that explores nothing was made by an integrate() that ran out of memory: it says as much as none.
  std::uint64_t count = 0;
  for (std::size_t s = 0; s < blocks_.count(); ++s) count += blocks_[s].explored.any();
  sink.put(count);
  for (std::size_t s = 0; s < blocks_.count(); ++s) {
    if (!blocks_[s].explored.any()) continue;
    for (const int i : blocks_.known()[s]) sink.put(static_cast<std::int32_t>(i));
    for (const std::uint64_t slice : blocks_[s].explored.slice) sink.put(slice);
    sink.put(std::span<const float>(blocks_[s].log_odds));
    if constexpr (Semantics::classes > 0) sink.put(std::span<const std::uint32_t>(blocks_[s].classes.counts));
  }
}

template <class Update, class Semantics, class Clearance>
void VoxelMap<Update, Semantics, Clearance>::load(Source& source) {
  std::string signature;
  source.get(signature);
  if (signature != this->signature())
    throw Error(source.where(), concat("a map of another kind: ", signature.substr(0, 200)), this->signature());
  VoxelMap loaded(config_);
  const auto refuse = [&](std::uint64_t block, std::string_view what, std::string_view expected) {
    throw Error(source.where(), concat("block ", block, " of the map ", what), expected);
  };
  const auto count = source.get<std::uint64_t>();
  std::vector<float> log_odds;
  std::vector<std::uint32_t> classes;
  for (std::uint64_t n = 0; n < count; ++n) {
    Eigen::Vector3i at;
    for (int& i : at) i = source.get<std::int32_t>();
    if (!loaded.blocks_.contains(at)) refuse(n, concat("at (", at.transpose(), ")"), "in the grid");
    if (loaded.blocks_.slot(at) >= 0) refuse(n, concat("at (", at.transpose(), ")"), "each block once");
    loaded.blocks_.reserve(1);
    loaded.blocks_.make(at);
    Block& b = loaded.blocks_[static_cast<std::size_t>(n)];  // in place: with many classes it would fill a stack
    for (std::uint64_t& slice : b.explored.slice) source.get(slice);
    if (!b.explored.any() || !((b.explored & ~VoxelBits::inside(grid_, at)) == VoxelBits{}))
      refuse(n, "explores no voxel of the grid, or others", "some voxels of the grid");
    source.get(log_odds);
    if (log_odds.size() != 512) refuse(n, concat("has ", log_odds.size(), " log-odds"), "512");
    for (std::size_t i = 0; i < 512; ++i)
      if (!std::isfinite(log_odds[i]) || (!b.explored[i] && log_odds[i] != 0))
        refuse(n, concat("has log-odds ", log_odds[i]), "finite, 0 where unexplored");
    std::ranges::copy(log_odds, b.log_odds.begin());
    if constexpr (Semantics::classes > 0) {
      source.get(classes);
      if (classes.size() != b.classes.counts.size())
        refuse(n, concat("has ", classes.size(), " counts"), concat(b.classes.counts.size()));
      std::ranges::copy(classes, b.classes.counts.begin());
    }
    b.free = b.explored & config_.update.free(b.log_odds);
    b.occupied = b.explored & config_.update.occupied(b.log_odds);
  }
  loaded.derive();
  *this = std::move(loaded);
}

}  // namespace vantage
