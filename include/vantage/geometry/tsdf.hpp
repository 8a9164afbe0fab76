// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/core/large_matrix.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/brick_volume.hpp>
#include <vantage/geometry/frame.hpp>

namespace vantage {

/// A truncated signed distance field, fused from depth (Curless and Levoy, "A volumetric method for building complex
/// models from range images", SIGGRAPH 1996): in every voxel near a surface the mean over frames of
///
///     min(truncation, (d - z) |p| / z)     wherever that is >= -truncation,
///
/// p the voxel's centre in the camera frame, z its depth, d the depth of the pixel that p falls into: the distance
/// along the ray, positive in front of the surface, negative behind it. Every frame counts alike. A frame changes the
/// bricks of 8^3 voxels that its pixels' bands (from truncation before to truncation behind the surface, along the ray)
/// touch.
///
/// Oblique rays make a surface too thick, the more so the larger the truncation: a sphere of 0.6 m radius seen from all
/// sides grows by 1.4 mm at 10 cm, by less than 0.1 mm at 4 cm (2 cm voxels, no noise).
///
/// Voxel (0, 0, 0) is centred at bounds().min() + voxel_m / 2. Memory: 4 bytes for each of the bricks that fit into the
/// bounds, and 8 bytes a voxel of those that were touched, 20 with colour, in slabs of 512 bricks. Models Map (of
/// frames) and ColouredBrickVolume (for marching_cubes). Const members may run concurrently; `integrate` uses all
/// threads, and its result does not depend on their number.
class Tsdf {
 public:
  using Measurement = Frame;

  struct Config {
    Box3 bounds = {};                              ///< what to map [m]; not empty
    double voxel_m = 0.02;                         ///< > 0
    double truncation_m = 0.10;                    ///< >= voxel_m
    bool colour = true;                            ///< keep colours: every frame must have them
    std::size_t max_bytes = std::size_t{4} << 30;  ///< refuse what would need more memory
  };
  struct Voxel {
    float distance_m = 0;                              ///< to the nearest surface, in [-truncation, truncation]
    float weight = 0;                                  ///< frames that it is the mean of, > 0
    Eigen::Vector3f colour = Eigen::Vector3f::Zero();  ///< RGB in [0, 1]; zero without colours
  };

  /// Throws Error naming all bad members, or if the bounds hold more bricks than max_bytes (or 2^31) allow.
  explicit Tsdf(const Config& config) : config_(config) {
    Check check("Tsdf::Config");
    const Box3& box = config.bounds;
    check(is_proper(box), "bounds", concat("(", box.min().transpose(), ") to (", box.max().transpose(), ")"),
          "finite, not empty");
    check.positive("voxel_m", config.voxel_m);
    check(std::isfinite(config.truncation_m) && config.truncation_m >= config.voxel_m, "truncation_m",
          config.truncation_m, "finite and >= voxel_m");
    check.done();
    double bricks = 1, entries = 1;  // the latter with a border, see touched_bricks
    for (int axis = 0; axis < 3; ++axis) {
      const double n = std::max(1.0, std::ceil((box.max()[axis] - box.min()[axis]) / brick_m() - 1e-9));
      bricks *= n;
      entries *= n + 2;
      size_[axis] = n < 0x1p30 ? static_cast<int>(n) : 0;  // too many are refused below
    }
    if (!(entries < 0x1p31) || entries * sizeof(std::int32_t) > static_cast<double>(config.max_bytes))
      throw Error("Tsdf", concat("the bounds hold ", bricks, " bricks of 8^3 voxels of ", config.voxel_m, " m"),
                  concat("fewer than 2^31, and 4 bytes for each in ", config.max_bytes, " bytes"));
    directory_.assign(static_cast<std::size_t>(bricks), -1);
  }

  /// Folds a frame in. Throws Error, and changes nothing, for a bad frame, one without depth (or colour, if that is
  /// kept), or if memory would exceed max_bytes. O(pixels + voxels of the touched bricks).
  void integrate(const Frame& frame);
  void integrate(const Frame& frame, Rng&) { integrate(frame); }

  [[nodiscard]] const Config& config() const { return config_; }
  /// What is mapped: the config's bounds, the upper sides moved out to whole bricks.
  [[nodiscard]] Box3 bounds() const {
    return {config_.bounds.min(), Eigen::Vector3d(config_.bounds.min() + brick_m() * size_.cast<double>())};
  }
  /// Of the directory and all slabs.
  [[nodiscard]] std::size_t bytes() const {
    return directory_.size() * sizeof(std::int32_t) + corners_.capacity() * sizeof(Eigen::Vector3i) +
           slabs_.size() * slab_bytes();
  }
  /// Voxel (i, j, k); none if no frame saw it.
  [[nodiscard]] std::optional<Voxel> at(const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3i corner(voxel.x() >> 3, voxel.y() >> 3, voxel.z() >> 3);
    const std::ptrdiff_t b = brick_at(corner);
    if (b < 0) return std::nullopt;
    const Eigen::Vector3i in = voxel - brick_edge * corner;
    const auto brick = static_cast<std::size_t>(b);
    const int sample = in.x() + brick_edge * (in.y() + brick_edge * in.z());
    const auto i = static_cast<std::size_t>(sample);
    if (!(data(brick)[brick_samples + i] > 0)) return std::nullopt;
    return Voxel{value(brick, i), data(brick)[brick_samples + i],
                 has_colour() ? colour(brick, i) : Eigen::Vector3f::Zero()};
  }

  // BrickVolume
  [[nodiscard]] std::size_t bricks() const { return corners_.size(); }
  [[nodiscard]] Eigen::Vector3i corner(std::size_t brick) const { return corners_[brick]; }
  [[nodiscard]] std::ptrdiff_t brick_at(const Eigen::Vector3i& corner) const {
    for (int axis = 0; axis < 3; ++axis)
      if (corner[axis] < 0 || corner[axis] >= size_[axis]) return -1;
    return directory_[slot(corner)];
  }
  void load(std::size_t brick, std::span<float, brick_samples> values) const {
    const float *distance = data(brick), *weight = distance + brick_samples;
    for (std::size_t i = 0; i < brick_samples; ++i)
      values[i] = weight[i] > 0 ? distance[i] : std::numeric_limits<float>::quiet_NaN();
  }
  [[nodiscard]] float value(std::size_t brick, std::size_t i) const {
    return data(brick)[brick_samples + i] > 0 ? data(brick)[i] : std::numeric_limits<float>::quiet_NaN();
  }
  [[nodiscard]] Eigen::Vector3d origin() const {
    return config_.bounds.min() + Eigen::Vector3d::Constant(config_.voxel_m / 2);
  }
  [[nodiscard]] Eigen::Vector3d spacing_m() const { return Eigen::Vector3d::Constant(config_.voxel_m); }
  [[nodiscard]] bool has_colour() const { return config_.colour; }
  [[nodiscard]] Eigen::Vector3f colour(std::size_t brick, std::size_t i) const {
    const float* c = data(brick) + 2 * brick_samples + i;
    return {c[0], c[brick_samples], c[2 * brick_samples]};
  }

 private:
  struct Projection;
  static constexpr std::size_t slab_bricks = 512;

  [[nodiscard]] double brick_m() const { return brick_edge * config_.voxel_m; }
  [[nodiscard]] std::size_t slot(const Eigen::Vector3i& corner) const {
    const auto nx = static_cast<std::size_t>(size_.x()), ny = static_cast<std::size_t>(size_.y());
    return (static_cast<std::size_t>(corner.z()) * ny + static_cast<std::size_t>(corner.y())) * nx +
           static_cast<std::size_t>(corner.x());
  }
  // Floats of a brick: 512 distances, 512 weights, then 512 each of red, green and blue.
  [[nodiscard]] std::size_t brick_floats() const { return (config_.colour ? 5 : 2) * brick_samples; }
  [[nodiscard]] std::size_t slab_bytes() const { return slab_bricks * brick_floats() * sizeof(float); }
  [[nodiscard]] const float* data(std::size_t brick) const {
    return slabs_[brick / slab_bricks].col(static_cast<Eigen::Index>(brick % slab_bricks));
  }
  [[nodiscard]] float* data(std::size_t brick) {
    return slabs_[brick / slab_bricks].col(static_cast<Eigen::Index>(brick % slab_bricks));
  }
  [[nodiscard]] std::vector<Eigen::Vector3i> touched_bricks(const Frame& frame) const;
  void allocate(std::span<const Eigen::Vector3i> corners);
  static void update(const Projection& projection, const Eigen::Vector3i& corner, float* brick);

  Config config_;
  Eigen::Vector3i size_;                   // bricks along x, y, z
  std::vector<std::int32_t> directory_;    // which brick lies at each place; -1: none
  std::vector<Eigen::Vector3i> corners_;   // of each brick, in the order of their first being touched
  std::vector<LargeMatrix<float>> slabs_;  // one column a brick
};

// The bricks that hold a point of some pixel's band, in the order of the directory. Each band is cut into pieces no
// longer than a brick (at the ray's centre of the image); a piece touches the bricks of the box around its ends.
// Neighbouring pixels mostly have the same ends.
inline std::vector<Eigen::Vector3i> Tsdf::touched_bricks(const Frame& frame) const {
  const Camera& camera = frame.camera;
  const auto width = static_cast<std::size_t>(camera.width), height = static_cast<std::size_t>(camera.height);
  const int pieces = static_cast<int>(std::ceil(2 * config_.truncation_m / brick_m()));
  const auto truncation = static_cast<float>(config_.truncation_m);
  // Places in bricks, counted from a border of one brick around the bounds, into which all falls that lies outside.
  const Eigen::Matrix3d R = frame.view.T_W_C.linear() / brick_m();
  const Eigen::Vector3f eye =
      ((frame.view.position() - config_.bounds.min()) / brick_m() + Eigen::Vector3d::Ones()).cast<float>();
  const Eigen::Vector3i border(size_.x() + 2, size_.y() + 2, size_.z() + 2);
  const Eigen::Vector3f last = (border - Eigen::Vector3i::Ones()).cast<float>();

  std::vector<std::uint64_t> marks((directory_.size() + 63) / 64);
  const auto mark = [&](int from, int to) {
    const auto decoded = [&](int key) {
      return Eigen::Vector3i(key % border.x(), key / border.x() % border.y(), key / border.x() / border.y());
    };
    const Eigen::Vector3i a = decoded(from), b = decoded(to);
    const Eigen::Vector3i low = a.cwiseMin(b).cwiseMax(1), high = a.cwiseMax(b).cwiseMin(size_);
    for (int z = low.z(); z <= high.z(); ++z)
      for (int y = low.y(); y <= high.y(); ++y)
        for (int x = low.x(); x <= high.x(); ++x) {
          const std::size_t i = slot({x - 1, y - 1, z - 1});
          const std::atomic_ref<std::uint64_t> word(marks[i / 64]);
          const std::uint64_t bit = std::uint64_t{1} << i % 64;
          if ((word.load(std::memory_order_relaxed) & bit) == 0) word.fetch_or(bit, std::memory_order_relaxed);
        }
  };

  parallel_for_blocks(height, 8, [&](std::size_t begin, std::size_t end) {
    Eigen::ArrayXf ray_x(camera.width), half(camera.width);
    std::vector<std::int32_t> now(width), before(width);
    for (std::size_t u = 0; u < width; ++u)
      ray_x[static_cast<Eigen::Index>(u)] = static_cast<float>((static_cast<double>(u) + 0.5 - camera.cx) / camera.fx);
    for (std::size_t row = begin; row < end; ++row) {
      const float* depth = frame.depth.data() + row * width;
      const double ray_y = (static_cast<double>(row) + 0.5 - camera.cy) / camera.fy;
      const Eigen::Vector3f along = R.col(0).cast<float>(), across = (R.col(1) * ray_y + R.col(2)).cast<float>();
      half = truncation / (ray_x.square() + static_cast<float>(1 + ray_y * ray_y)).sqrt();  // of the band, along z
      for (int piece = 0; piece <= pieces; ++piece) {
        const float at = -1 + 2 * static_cast<float>(piece) / static_cast<float>(pieces);
        for (std::size_t u = 0; u < width; ++u) {
          const float rx = ray_x.data()[u], raw = depth[u] + at * half.data()[u], z = raw < 0 ? 0 : raw;
          const auto cell = [&](int i) {  // NaN falls into the border
            const float x = eye[i] + z * (along[i] * rx + across[i]);
            const float above = x > 0 ? x : 0;
            return static_cast<std::int32_t>(above < last[i] ? above : last[i]);
          };
          now[u] = (cell(2) * border.y() + cell(1)) * border.x() + cell(0);
        }
        if (piece > 0)
          for (std::size_t u = 0; u < width; ++u)
            if (u == 0 || now[u] != now[u - 1] || before[u] != before[u - 1]) mark(before[u], now[u]);
        std::swap(now, before);
      }
    }
  });

  std::vector<Eigen::Vector3i> touched;
  for (std::size_t w = 0; w < marks.size(); ++w)
    for (std::uint64_t word = marks[w]; word != 0; word &= word - 1) {
      const auto i = static_cast<int>(64 * w + static_cast<std::size_t>(std::countr_zero(word)));
      touched.emplace_back(i % size_.x(), i / size_.x() % size_.y(), i / size_.x() / size_.y());
    }
  return touched;
}

inline void Tsdf::allocate(std::span<const Eigen::Vector3i> corners) {
  const auto missing = static_cast<std::size_t>(
      std::ranges::count_if(corners, [&](const Eigen::Vector3i& c) { return directory_[slot(c)] < 0; }));
  const std::size_t slabs = (corners_.size() + missing + slab_bricks - 1) / slab_bricks;
  if (const std::size_t more = (slabs - slabs_.size()) * slab_bytes(); bytes() + more > config_.max_bytes)
    throw Error("Tsdf::integrate", concat("the frame needs ", more, " bytes besides the ", bytes(), " in use"),
                concat("max_bytes = ", config_.max_bytes, " at most"));
  corners_.reserve(std::max(corners_.size() + missing, slabs * slab_bricks));
  slabs_.reserve(slabs);
  while (slabs_.size() < slabs)
    slabs_.emplace_back(static_cast<Eigen::Index>(brick_floats()), static_cast<Eigen::Index>(slab_bricks));
  for (const Eigen::Vector3i& c : corners)
    if (std::int32_t& entry = directory_[slot(c)]; entry < 0) {
      entry = static_cast<std::int32_t>(corners_.size());
      corners_.push_back(c);
    }
}

/// What all bricks share in one frame, in single precision: the camera, its images, and where the 64 voxels of a slice
/// lie, in the camera frame, from the first of them.
struct Tsdf::Projection {
  Projection(const Config& config, const Frame& f)
      : frame(f),
        truncation(static_cast<float>(config.truncation_m)),
        T_C_W(f.view.T_C_W()),
        origin(config.bounds.min() + Eigen::Vector3d::Constant(config.voxel_m / 2)),
        voxel_m(config.voxel_m),
        step_z((T_C_W.linear().col(2) * voxel_m).cast<float>()),
        colour(config.colour) {
    const Eigen::Vector3d step_x = T_C_W.linear().col(0) * voxel_m, step_y = T_C_W.linear().col(1) * voxel_m;
    for (int i = 0; i < 64; ++i)
      for (int axis = 0; axis < 3; ++axis)
        offset(axis, i) = static_cast<float>((i & 7) * step_x[axis] + (i >> 3) * step_y[axis]);
  }
  const Frame& frame;
  float truncation;
  Eigen::Isometry3d T_C_W;
  Eigen::Vector3d origin;
  double voxel_m;
  Eigen::Vector3f step_z;
  bool colour;
  Eigen::Matrix<float, 3, 64, Eigen::RowMajor> offset;
};

// Loops over the 64 voxels of a slice, each simple enough for the compiler to turn into vectors.
inline void Tsdf::update(const Projection& in, const Eigen::Vector3i& corner, float* brick) {
  using Slice = Eigen::Array<float, 64, 1>;
  const Camera& camera = in.frame.camera;
  const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx), cy = static_cast<float>(camera.cy);
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  const float nan = std::numeric_limits<float>::quiet_NaN(), truncation = in.truncation;
  const float *depth = in.frame.depth.data(), *off_x = in.offset.data(), *off_y = off_x + 64, *off_z = off_x + 128;
  const Eigen::Vector3d first_voxel = in.origin + in.voxel_m * (brick_edge * corner).cast<double>();
  const Eigen::Vector3f first = (in.T_C_W * first_voxel).cast<float>();
  Slice z, inverse_z, square, distance, seen_colour;
  alignas(64) std::array<std::int32_t, 64> pixel;
  for (int k = 0; k < brick_edge; ++k) {
    const Eigen::Vector3f at = first + static_cast<float>(k) * in.step_z;
    for (int i = 0; i < 64; ++i) {
      const float px = at.x() + off_x[i], py = at.y() + off_y[i], pz = at.z() + off_z[i], inv = 1 / pz;
      const float u = fx * px * inv + cx, v = fy * py * inv + cy;
      const bool in_view = (pz > 0) & (u >= 0) & (u < width) & (v >= 0) & (v < height);
      z[i] = pz;
      inverse_z[i] = inv;
      square[i] = px * px + py * py + pz * pz;
      const auto column = static_cast<std::int32_t>(in_view ? u : 0), row = static_cast<std::int32_t>(in_view ? v : 0);
      pixel[static_cast<std::size_t>(i)] = in_view ? row * camera.width + column : -1;
    }
    square = square.sqrt();  // |p|
    int seen = 0;
    for (int i = 0; i < 64; ++i) {
      const std::int32_t p = pixel[static_cast<std::size_t>(i)];
      const float d = p < 0 ? nan : depth[p];
      distance[i] = (d - z[i]) * square[i] * inverse_z[i];
      seen += distance[i] >= -truncation;
    }
    if (seen == 0) continue;
    float *mean = brick + 64 * k, *weight = mean + brick_samples;
    Slice share;  // of this frame in the new mean
    for (int i = 0; i < 64; ++i) {
      const bool sees = distance[i] >= -truncation;
      const float value = distance[i] < truncation ? distance[i] : truncation;
      const float n = weight[i] + (sees ? 1.0F : 0.0F), one_in_n = 1 / n;
      weight[i] = n;
      share[i] = sees ? one_in_n : 0;
      mean[i] += (value - mean[i]) * share[i];
    }
    if (!in.colour) continue;
    float* mean_colour = mean + 2 * brick_samples;
    for (const Image<float>* plane : {&in.frame.colour.r, &in.frame.colour.g, &in.frame.colour.b}) {
      const float* colour = plane->data();
      for (int i = 0; i < 64; ++i) {
        const std::int32_t p = pixel[static_cast<std::size_t>(i)];
        seen_colour[i] = colour[p < 0 ? 0 : p];
      }
      for (int i = 0; i < 64; ++i) mean_colour[i] += (seen_colour[i] - mean_colour[i]) * share[i];
      mean_colour += brick_samples;
    }
  }
}

inline void Tsdf::integrate(const Frame& frame) {
  frame.validate("Tsdf::integrate");
  if (frame.depth.size() == 0) throw Error("Tsdf::integrate", "the frame has no depth", "a depth image");
  if (config_.colour && frame.colour.empty())
    throw Error("Tsdf::integrate", "the frame has no colour", "colours, or Config::colour = false");
  const std::vector<Eigen::Vector3i> touched = touched_bricks(frame);
  allocate(touched);
  const Projection projection(config_, frame);
  parallel_for_blocks(touched.size(), 8, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      update(projection, touched[i], data(static_cast<std::size_t>(directory_[slot(touched[i])])));
  });
}

}  // namespace vantage
