// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/maps/surfel/raster_images.hpp>
#include <vantage/maps/surfel/splat_chain.hpp>
#include <vantage/maps/surfel/tile_bins.hpp>
#include <vantage/maps/surfel/tile_blend.hpp>
#include <vantage/maps/surfel/tile_sweep.hpp>
#include <vantage/maps/surfel/visible_splats.hpp>

namespace vantage {

/// The rasteriser to use: float, sixteen pixels or surfels at once, tiles of `tile` x `tile` px (8, 16 or 32)
/// concurrently. A splat reaches exactly where its alpha is at least 1/255; Depth is LinearDepth or RayPlaneDepth.
/// Models SurfelRasteriser. The same bits with any number of threads. Throws Error for a view that is none, or images
/// of another size; a surfel with NaN, or one too large to be drawn in floats, is left out.
template <int tile = 16, class Depth = LinearDepth>
class TileRasteriser {
 public:
  class Pass {
   public:
    /// Surfels that the last call drew, and how often they stand in a tile.
    [[nodiscard]] std::size_t visible() const { return splats_.size(); }
    [[nodiscard]] std::size_t tile_entries() const { return bins_.entries(); }

   private:
    friend class TileRasteriser;
    VisibleSplats splats_;
    TileBins bins_;
    std::size_t surfels_ = 0;
    Camera camera_;
    bool has_drawn_ = false, colour_ = false, depth_ = false, normal_ = false;
    std::vector<KeptSums<tile>> kept_;  // of every tile
    std::vector<SplatSums> sums_;
    std::vector<float> largest_;
    std::vector<PoseGradient> pose_of_chunk_;
    Rendering<channel::Colour> colour_image_;  // of fisher
    std::vector<std::uint32_t> scratch_;
  };

  /// O(surfels) to find those in sight, and O(blends) to draw them.
  template <class... Channels>
  void forward(const Surfels& s, const RasterView& view, Pass& pass, Rendering<Channels...>& out) const {
    prepare(s, view, pass);
    blend(view, pass, out);
  }

  void backward(const Surfels& s, const RasterView& view, Pass& pass, const ImageGradient& d,
                SurfelGradient& gradient) const {
    PoseGradient pose = PoseGradient::Zero();
    backward(s, view, pass, d, gradient, pose);
  }
  void backward(const Surfels& s, const RasterView& view, Pass& pass, const ImageGradient& d, SurfelGradient& gradient,
                PoseGradient& pose) const {
    check_backward(s, view, pass, d);
    if (gradient.is_touched.size() != s.size()) gradient.reset(s.size());
    pass.sums_.resize(pass.bins_.entries());
    sweep(view, pass, [&](std::size_t t, const TilePixels<tile>& at) {
      return GradientPixels<tile, Depth>(at, d, pass.kept_[t], pass.sums_.data() + pass.bins_.begin(t));
    });
    pose += add_gradient<Depth>(s, view, pass.splats_, pass.bins_, pass.sums_, gradient, pass.pose_of_chunk_);
    mark_touched(pass.splats_, gradient, pass.scratch_);
  }

  void visibility(const Surfels& s, const RasterView& view, Pass& pass, const Image<float>& measured,
                  std::span<float> weight) const {
    check_image_size(measured, view.camera, "TileRasteriser::visibility", "the measured depth");
    check_length(weight.size(), s.size(), "TileRasteriser::visibility", "weight");
    prepare(s, view, pass);
    pass.largest_.resize(pass.bins_.entries());
    sweep(view, pass, [&](std::size_t t, const TilePixels<tile>& at) {
      return VisibilityPixels<tile>(at, measured, pass.largest_.data() + pass.bins_.begin(t));
    });
    parallel_for(pass.splats_.chunks(), [&](std::size_t c) {
      for (std::size_t k = c * VisibleSplats::chunk; k < c * VisibleSplats::chunk + pass.splats_.count(c); ++k)
        for (const std::uint32_t place : pass.bins_.places(static_cast<std::uint32_t>(k))) {
          float& largest = weight[pass.splats_.surfel[k]];
          largest = std::max(largest, pass.largest_[place]);
        }
    });
  }

  /// Surfel-major, surfel::parameters numbers each; those of the rotation are left as they are (FisherRF).
  void fisher(const Surfels& s, const RasterView& view, Pass& pass, std::span<double> diagonal) const {
    check_length(diagonal.size(), surfel::parameters * s.size(), "TileRasteriser::fisher", "diagonal");
    prepare(s, view, pass);
    blend(view, pass, pass.colour_image_);
    pass.sums_.resize(pass.bins_.entries());
    sweep(view, pass, [&](std::size_t t, const TilePixels<tile>&) {
      return FisherPixels<tile>(pass.kept_[t], pass.sums_.data() + pass.bins_.begin(t));
    });
    add_fisher<Depth>(s, view, pass.splats_, pass.bins_, pass.sums_, diagonal);
  }

  /// How many surfels each pixel of the last call drew, all together.
  [[nodiscard]] std::size_t blends(const RasterView& view, Pass& pass) const {
    std::vector<std::size_t> of_tile(pass.bins_.tiles(), 0);
    sweep(view, pass, [&](std::size_t t, const TilePixels<tile>&) { return CountedPixels{&of_tile[t]}; });
    std::size_t n = 0;
    for (const std::size_t k : of_tile) n += k;
    return n;
  }

 private:
  struct CountedPixels {
    struct Sums {
      std::size_t n = 0;
    };
    static void add(Sums& sums, std::size_t, const PackedSplat&, const Transmittance::Drawn& d) {
      sums.n += static_cast<std::size_t>(std::popcount(bits(d.weight > Lanes<float>(0.0F))));
    }
    void write(const Sums& sums, std::size_t) const { *total += sums.n; }
    std::size_t* total;
  };

  static void check_backward(const Surfels& s, const RasterView& view, const Pass& pass, const ImageGradient& d) {
    constexpr const char* where = "TileRasteriser::backward";
    check_gradient_sizes(d, view.camera, where);
    if (!pass.has_drawn_ || pass.surfels_ != s.size() || pass.camera_.width != view.camera.width ||
        pass.camera_.height != view.camera.height)
      throw Error(where, "the pass holds no forward of these surfels and view", "forward first");
    if ((d.colour.r.size() + d.colour.g.size() + d.colour.b.size() > 0 && !pass.colour_) ||
        (d.depth.size() > 0 && !pass.depth_) ||
        (d.normal_x.size() + d.normal_y.size() + d.normal_z.size() > 0 && !pass.normal_))
      throw Error(where, "a gradient by a channel that forward did not draw",
                  "Colour, Depth or Normal in its rendering");
  }

  static void prepare(const Surfels& s, const RasterView& view, Pass& pass) {
    check_raster_input(s, view, "TileRasteriser");
    pass.has_drawn_ = false;
    pass.surfels_ = s.size();
    pass.camera_ = view.camera;
    pass.splats_.template project<Depth>(s, view);
    pass.bins_.template fill<tile>(pass.splats_, view.camera);
  }

  template <class R>
  static void blend(const RasterView& view, Pass& pass, R& out) {
    for_images(out, [&](Image<float>& image) { image.resize(view.camera.height, view.camera.width); });
    pass.kept_.resize(pass.bins_.tiles());
    parallel_for(pass.bins_.tiles(), [&](std::size_t t) {
      const TilePixels<tile> at(pass.bins_, t, view.camera);
      TileBlend<tile, Depth, R> blend(view, at);
      blend.draw(pass.splats_, pass.bins_.of(t));
      blend.write(out, pass.kept_[t]);
    });
    pass.has_drawn_ = true;
    pass.colour_ = draws<channel::Colour, R>;
    pass.depth_ = draws<channel::Depth, R>;
    pass.normal_ = draws<channel::Normal, R>;
  }
  template <class Make>
  static void sweep(const RasterView& view, Pass& pass, Make&& make) {
    parallel_for(pass.bins_.tiles(), [&](std::size_t t) {
      const TilePixels<tile> at(pass.bins_, t, view.camera);
      auto pixels = make(t, at);
      sweep_tile(pass.splats_, pass.bins_.of(t), at, pixels);
    });
  }
};

}  // namespace vantage
