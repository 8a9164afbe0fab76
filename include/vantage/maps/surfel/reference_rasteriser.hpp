// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <vantage/core/parallel.hpp>
#include <vantage/maps/surfel/projection.hpp>
#include <vantage/maps/surfel/raster_images.hpp>

namespace vantage {

/// A splat reaches wherever its alpha is at least 1/255.
struct WholeEllipse {
  template <class S>
  static bool reaches(const Splat<S>&, const Camera&, int, int) {
    return true;
  }
};

/// The published cut: a splat reaches the 16 x 16 tiles that the square about a circle of three standard deviations
/// touches, rounded up, and nothing outside of them.
struct PublishedTiles {
  /// First and last tile + 1 along x, then along y.
  template <class S>
  static std::array<int, 4> tiles(const Splat<S>& s, const Camera& camera) {
    const S radius = radius_px(s);
    const auto tile = [](S px, int pixels) {
      return static_cast<int>(std::clamp<S>(std::trunc(px / 16), 0, static_cast<S>((pixels + 15) / 16)));
    };
    return {tile(s.centre[0] - radius, camera.width), tile(s.centre[0] + radius + 15, camera.width),
            tile(s.centre[1] - radius, camera.height), tile(s.centre[1] + radius + 15, camera.height)};
  }
  template <class S>
  static S radius_px(const Splat<S>& s) {
    const auto& [xx, xy, yy] = s.covariance;
    const S middle = (xx + yy) / 2;
    return std::ceil(3 * std::sqrt(middle + std::sqrt(std::max(S(0.1), middle * middle - (xx * yy - xy * xy)))));
  }
  template <class S>
  static bool reaches(const Splat<S>& s, const Camera& camera, int u, int v) {
    const auto [x0, x1, y0, y1] = tiles(s, camera);
    return u >= 16 * x0 && u < 16 * x1 && v >= 16 * y0 && v < 16 * y1;
  }
};

/// The rasteriser that is read rather than used: every pixel looks at every splat, sorted by depth. Models
/// SurfelRasteriser; Scalar is float or double. Forward O(pixels x visible surfels).
template <class Scalar = double, class Depth = LinearDepth, class Extent = WholeEllipse>
class ReferenceRasteriser {
 public:
  /// What a pixel draws of one surfel.
  struct Contribution {
    std::size_t splat;
    Scalar dx, dy, gauss, alpha, weight, transmittance;  ///< transmittance: before it
    bool clamped;                                        ///< alpha was held at 0.99
  };
  struct Pass {
    std::vector<std::uint32_t> surfel;   ///< near to far
    std::vector<Splat<Scalar>> splat;    ///< alike
    std::array<Image<Scalar>, 9> image;  ///< red, green, blue, depth, normal x, y, z, opacity, confidence
    Image<Scalar> transmittance;
    Image<int> blended;  ///< surfels a pixel
  };

  template <class... Channels>
  void forward(const Surfels& s, const RasterView& view, Pass& pass, Rendering<Channels...>& out) const {
    prepare(s, view, pass);
    for (auto& image : pass.image) image.setZero(view.camera.height, view.camera.width);
    pass.transmittance.setOnes(view.camera.height, view.camera.width);
    pass.blended.setZero(view.camera.height, view.camera.width);
    parallel_for(static_cast<std::size_t>(view.camera.height), [&](std::size_t row) {
      std::vector<Contribution> list;
      const int v = static_cast<int>(row);
      for (int u = 0; u < view.camera.width; ++u) draw(s, view, pass, u, v, list);
    });
    write(pass, out);
  }

  void backward(const Surfels& s, const RasterView& view, Pass& pass, const ImageGradient& d,
                SurfelGradient& gradient) const {
    PoseGradient pose = PoseGradient::Zero();
    backward(s, view, pass, d, gradient, pose);
  }
  void backward(const Surfels& s, const RasterView& view, Pass& pass, const ImageGradient& d, SurfelGradient& gradient,
                PoseGradient& pose) const {
    check_gradient_sizes(d, view.camera, "ReferenceRasteriser::backward");
    if (pass.transmittance.rows() != view.camera.height || pass.transmittance.cols() != view.camera.width)
      throw Error("ReferenceRasteriser::backward", "the pass holds no forward of this view", "forward first");
    if (gradient.is_touched.size() != s.size()) gradient.reset(s.size());
    std::vector<SplatGradient<Scalar>> splat(pass.splat.size(), SplatGradient<Scalar>{});
    std::vector<std::array<Scalar, 3>> colour(pass.splat.size(), std::array<Scalar, 3>{});
    std::vector<Contribution> list;
    for (int v = 0; v < view.camera.height; ++v)
      for (int u = 0; u < view.camera.width; ++u) {
        contributions(view, pass, u, v, list);
        const std::array<Scalar, 8> g = at(d, pass, u, v);
        Scalar behind = pass.transmittance(v, u) *
                        (g[0] * view.background[0] + g[1] * view.background[1] + g[2] * view.background[2]);
        for (std::size_t i = list.size(); i-- > 0;) {
          const Contribution& c = list[i];
          const std::size_t k = c.splat;
          const DepthAt<Scalar> depth = depth_at(pass.splat[k], c);
          Scalar drawn = g[3] * depth.depth + g[7];
          for (std::size_t p = 0; p < 3; ++p) {
            drawn += g[p] * Scalar(s.parameter[surfel::red + p][pass.surfel[k]]) + g[4 + p] * pass.splat[k].axis[2][p];
            colour[k][p] += c.weight * g[p];
            splat[k].normal[p] += c.weight * g[4 + p];
          }
          add_depth(pass.splat[k], c, depth, c.weight * g[3], splat[k]);
          if (!c.clamped) add_alpha(pass.splat[k], c, c.transmittance * drawn - behind / (1 - c.alpha), splat[k]);
          behind += c.weight * drawn;
        }
      }
    const Projector<Scalar> camera(view, s.scale);
    for (std::size_t k = 0; k < pass.splat.size(); ++k) {
      const std::uint32_t i = pass.surfel[k];
      const auto by = chain<Depth>(camera, parameters(s, i), pass.splat[k], splat[k]);
      const auto add = [&](std::size_t p, Scalar value) { gradient.parameter[p][i] += static_cast<float>(value); };
      for (std::size_t p = 0; p < 3; ++p) add(surfel::x + p, by.position[p]);
      for (std::size_t p = 0; p < 4; ++p) add(surfel::qw + p, by.quaternion[p]);
      for (std::size_t p = 0; p < 2; ++p) add(surfel::log_scale_x + p, by.log_scale[p]);
      for (std::size_t p = 0; p < 3; ++p) add(surfel::red + p, colour[k][p]);
      add(surfel::logit, by.logit);
      for (std::size_t p = 0; p < 6; ++p) pose[static_cast<Eigen::Index>(p)] += static_cast<double>(by.pose[p]);
      if (!std::exchange(gradient.is_touched[i], std::uint8_t{1})) gradient.touched.push_back(i);
    }
    std::sort(gradient.touched.begin(), gradient.touched.end());
  }

  void visibility(const Surfels& s, const RasterView& view, Pass& pass, const Image<float>& measured,
                  std::span<float> weight) const {
    check_image_size(measured, view.camera, "ReferenceRasteriser::visibility", "the measured depth");
    check_length(weight.size(), s.size(), "ReferenceRasteriser::visibility", "weight");
    prepare(s, view, pass);
    std::vector<Contribution> list;
    for (int v = 0; v < measured.rows(); ++v)
      for (int u = 0; u < measured.cols(); ++u) {
        if (!(measured(v, u) > 0)) continue;
        contributions(view, pass, u, v, list);
        for (const Contribution& c : list) {
          float& largest = weight[pass.surfel[c.splat]];
          largest = std::max(largest, static_cast<float>(c.weight));
        }
      }
  }

  /// Surfel-major, surfel::parameters numbers each; those of the rotation are left as they are (FisherRF).
  void fisher(const Surfels& s, const RasterView& view, Pass& pass, std::span<double> diagonal) const {
    check_length(diagonal.size(), surfel::parameters * s.size(), "ReferenceRasteriser::fisher", "diagonal");
    prepare(s, view, pass);
    const Projector<Scalar> camera(view, s.scale);
    std::vector<Contribution> list;
    for (int v = 0; v < view.camera.height; ++v)
      for (int u = 0; u < view.camera.width; ++u) {
        contributions(view, pass, u, v, list);
        Scalar left = 1, behind = 0;
        for (const Contribution& c : list) left -= c.weight;
        for (const float b : view.background) behind += left * Scalar(b);
        for (std::size_t i = list.size(); i-- > 0;) {
          const Contribution& c = list[i];
          const std::uint32_t k = pass.surfel[c.splat];
          Scalar drawn = 0;
          for (std::size_t p = 0; p < 3; ++p) drawn += Scalar(s.parameter[surfel::red + p][k]);
          SplatGradient<Scalar> g{};
          if (!c.clamped) add_alpha(pass.splat[c.splat], c, c.transmittance * drawn - behind / (1 - c.alpha), g);
          behind += c.weight * drawn;
          const auto by = chain<Depth>(camera, parameters(s, k), pass.splat[c.splat], g);
          const auto add = [&](std::size_t p, Scalar value) {
            diagonal[surfel::parameters * k + p] += static_cast<double>(value * value);
          };
          for (std::size_t p = 0; p < 3; ++p) add(surfel::x + p, by.position[p]);
          for (std::size_t p = 0; p < 2; ++p) add(surfel::log_scale_x + p, by.log_scale[p]);
          for (std::size_t p = 0; p < 3; ++p) add(surfel::red + p, c.weight);
          add(surfel::logit, by.logit);
        }
      }
  }

 private:
  static surfel::Parameters<Scalar> parameters(const Surfels& s, std::size_t i) {
    surfel::Parameters<Scalar> p;
    for (std::size_t k = 0; k < surfel::parameters; ++k) p[k] = static_cast<Scalar>(s.parameter[k][i]);
    return p;
  }
  static void prepare(const Surfels& s, const RasterView& view, Pass& pass) {
    check_raster_input(s, view, "ReferenceRasteriser");
    const Projector<Scalar> camera(view, s.scale);
    std::vector<std::pair<std::uint32_t, Splat<Scalar>>> drawn;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const auto in = parameters(s, i);
      const auto p = camera.to_camera(std::array<Scalar, 3>{in[surfel::x], in[surfel::y], in[surfel::z]});
      if (!camera.in_sight(p, camera.pixel(p))) continue;
      const Splat<Scalar> splat = project<Depth>(camera, in);
      if (is_drawn(camera, in, static_cast<Scalar>(s.confidence[i]), splat))
        drawn.emplace_back(static_cast<std::uint32_t>(i), splat);
    }
    std::stable_sort(drawn.begin(), drawn.end(),
                     [](const auto& a, const auto& b) { return a.second.p[2] < b.second.p[2]; });
    pass.surfel.clear();
    pass.splat.clear();
    for (const auto& [i, splat] : drawn) {
      pass.surfel.push_back(i);
      pass.splat.push_back(splat);
    }
  }

  // What pixel (u, v) draws, near to far.
  static void contributions(const RasterView& view, const Pass& pass, int u, int v, std::vector<Contribution>& list) {
    list.clear();
    Scalar left = 1;
    for (std::size_t k = 0; k < pass.splat.size(); ++k) {
      const Splat<Scalar>& s = pass.splat[k];
      const Scalar dx = Scalar(u) - s.centre[0], dy = Scalar(v) - s.centre[1];
      const Scalar gauss =
          std::exp(Scalar(-0.5) * (s.conic[0] * dx * dx + 2 * s.conic[1] * dx * dy + s.conic[2] * dy * dy));
      const Scalar alpha = std::min(Scalar(0.99), s.opacity * gauss);
      if (!(alpha >= Scalar(1) / 255) || !Extent::reaches(s, view.camera, u, v)) continue;
      if (left * (1 - alpha) < Scalar(1e-4)) break;
      list.push_back({k, dx, dy, gauss, alpha, left * alpha, left, s.opacity * gauss > Scalar(0.99)});
      left *= 1 - alpha;
    }
  }
  static DepthAt<Scalar> depth_at(const Splat<Scalar>& s, const Contribution& c) {
    return Depth::at(s.p[2], c.dx * s.slope[0] + c.dy * s.slope[1]);
  }

  static void draw(const Surfels& s, const RasterView& view, Pass& pass, int u, int v,
                   std::vector<Contribution>& list) {
    contributions(view, pass, u, v, list);
    Scalar left = 1;
    for (const Contribution& c : list) {
      const std::uint32_t i = pass.surfel[c.splat];
      for (std::size_t p = 0; p < 3; ++p) {
        pass.image[p](v, u) += c.weight * Scalar(s.parameter[surfel::red + p][i]);
        pass.image[4 + p](v, u) += c.weight * pass.splat[c.splat].axis[2][p];
      }
      pass.image[3](v, u) += c.weight * depth_at(pass.splat[c.splat], c).depth;
      pass.image[8](v, u) += c.weight * Scalar(s.confidence[i]);
      left = c.transmittance * (1 - c.alpha);
    }
    for (std::size_t p = 0; p < 3; ++p) pass.image[p](v, u) += left * Scalar(view.background[p]);
    pass.image[3](v, u) =
        1 - left > Scalar(1e-6) ? pass.image[3](v, u) / (1 - left) : std::numeric_limits<Scalar>::quiet_NaN();
    pass.image[7](v, u) = 1 - left;
    pass.transmittance(v, u) = left;
    pass.blended(v, u) = static_cast<int>(list.size());
  }
  template <class R>
  static void write(const Pass& pass, R& out) {
    if constexpr (draws<channel::Colour, R>) {
      channel::Colour& c = out;
      c.r = pass.image[0].template cast<float>();
      c.g = pass.image[1].template cast<float>();
      c.b = pass.image[2].template cast<float>();
    }
    if constexpr (draws<channel::Depth, R>) out.depth = pass.image[3].template cast<float>();
    if constexpr (draws<channel::Normal, R>) {
      channel::Normal& n = out;
      n.x = pass.image[4].template cast<float>();
      n.y = pass.image[5].template cast<float>();
      n.z = pass.image[6].template cast<float>();
    }
    if constexpr (draws<channel::Opacity, R>) out.opacity = pass.image[7].template cast<float>();
    if constexpr (draws<channel::Confidence, R>) out.confidence = pass.image[8].template cast<float>();
  }

  // By the sums over a pixel's surfels: colour, weighted depth, normal, and sum w, through which depth is divided.
  static std::array<Scalar, 8> at(const ImageGradient& d, const Pass& pass, int u, int v) {
    const auto value = [&](const Image<float>& image) {
      return image.size() == 0 ? Scalar(0) : static_cast<Scalar>(image(v, u));
    };
    std::array<Scalar, 8> g = {value(d.colour.r), value(d.colour.g), value(d.colour.b), 0,
                               value(d.normal_x), value(d.normal_y), value(d.normal_z), value(d.opacity)};
    if (const Scalar opacity = pass.image[7](v, u); opacity > Scalar(1e-6)) {
      g[3] = value(d.depth) / opacity;
      g[7] -= g[3] * pass.image[3](v, u);
    }
    return g;
  }
  static void add_depth(const Splat<Scalar>& s, const Contribution& c, const DepthAt<Scalar>& depth, Scalar d,
                        SplatGradient<Scalar>& g) {
    const Scalar by_slope = d * depth.by_slope;
    g.z += d * depth.by_z;
    g.slope[0] += by_slope * c.dx;
    g.slope[1] += by_slope * c.dy;
    g.centre[0] -= by_slope * s.slope[0];
    g.centre[1] -= by_slope * s.slope[1];
  }
  static void add_alpha(const Splat<Scalar>& s, const Contribution& c, Scalar d_alpha, SplatGradient<Scalar>& g) {
    const Scalar d = d_alpha * c.alpha;  // by log alpha
    g.log_opacity += d;
    g.conic[0] -= d * c.dx * c.dx / 2;
    g.conic[1] -= d * c.dx * c.dy;
    g.conic[2] -= d * c.dy * c.dy / 2;
    g.centre[0] += d * (s.conic[0] * c.dx + s.conic[1] * c.dy);
    g.centre[1] += d * (s.conic[1] * c.dx + s.conic[2] * c.dy);
  }
};

}  // namespace vantage
