// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include <vantage/concepts/channels.hpp>
#include <vantage/core/error.hpp>
#include <vantage/core/parallel.hpp>
#include <vantage/geometry/camera.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/geometry/view.hpp>
#include <vantage/sim/lighting.hpp>
#include <vantage/sim/ray_scene.hpp>
#include <vantage/sim/texture_atlas.hpp>

namespace vantage {

struct SceneRendererConfig {
  Lighting lighting = {};
  Eigen::Vector3f background = Eigen::Vector3f::Zero();  ///< RGB in [0, 1], where no surface is
  RaySceneConfig rays = {};
};

/// Draws a scene without noise, one ray through the centre of each pixel.
///
/// Light is constant over a side of a flat triangle, so that it is multiplied into the triangle's colour beforehand.
/// What is left for a pixel: a texture's colour, from the mipmap that fits the pixel's footprint on the surface (exact
/// for its area). Pixels are taken 8 x 2 at a time through ray, hit and colour, as structures of arrays; sixteen such
/// packets take each of these steps together, so that memory has time to bring what the next one reads. Owns copies of
/// all it needs and does not change: const members run concurrently, copies share.
class SceneRenderer {
 public:
  using Config = SceneRendererConfig;

  /// Throws Error for a scene that is empty or does not fit together (Scene::validate), for texture coordinates beyond
  /// 1e6, and for a bad configuration. O(n log n) for n triangles.
  explicit SceneRenderer(const Scene& scene, const Config& config = {});

  /// Any of the channels Colour, Depth (NaN where nothing is), Normal (unit, on the viewer's side; NaN where nothing
  /// is) and Labels (0 where nothing is). Throws Error for a bad view or camera. O(pixels log triangles), on all
  /// threads; the same bits whatever their number.
  template <class... Channels>
  void render(const View& view, const Camera& camera, Rendering<Channels...>& out) const;

  [[nodiscard]] const RayScene& rays() const { return rays_; }

 private:
  using Lanes = RayPacket::Lanes;
  static constexpr Eigen::Index packet_width = 8, packet_height = 2, tile_width = 128, tile_height = 8;

  /// One cache line a triangle; the last one is the background.
  struct alignas(64) Surface {
    std::array<float, 6> colour = {};                        ///< times light: RGB of the front, of the back
    float u = 0, v = 0, u_1 = 0, v_1 = 0, u_2 = 0, v_2 = 0;  ///< at the first corner; along both edges
    float texels = 0;                                        ///< of the full texture, in twice the triangle
    TextureAtlas::Levels texture = TextureAtlas::plain;
  };
  struct Appearance {
    std::vector<Surface> surfaces;
    std::vector<std::uint16_t> labels;                           ///< of each surface
    std::vector<std::array<Eigen::Vector3f, 3>> corner_colours;  ///< of each triangle, or none
    TextureAtlas textures;
  };
  static std::shared_ptr<const Appearance> appearance(const Scene& scene, const Config& config);
  static void set_texture(const Scene& scene, std::size_t triangle, std::uint32_t texture, Surface& surface);

  /// What a packet's rays meet.
  struct Met {
    using Indices = std::array<std::uint32_t, static_cast<std::size_t>(RayPacket::size)>;
    std::array<Lanes, 3> colour = {Lanes::Zero(), Lanes::Zero(), Lanes::Zero()};
    Lanes u = Lanes::Zero(), v = u, u_1 = u, v_1 = u, u_2 = u, v_2 = u, texels = u, first = u, last = u;
    Lanes along = u;  ///< of the ray, the normal
    alignas(64) Indices surface = {};
    bool textured = false;
    TextureAtlas::Samples samples;  ///< if textured

    /// For the lanes that meet surface `i`, as `lane` does.
    void read(const Surface& s, std::uint32_t i, std::size_t lane);
  };
  void meet(const RayPacket& packet, Met& met) const;
  /// Finds the texels of a packet's pixels, each of which is `pixel_area` at depth 1.
  void find_texels(const RayPacket& packet, float pixel_area, Met& met) const;
  void shade(const RayPacket& packet, const Met& met, std::array<Lanes, 3>& rgb) const;
  /// The part of a packet that lies inside of the image.
  template <class T, class From>
  static void store(Image<T>& image, Eigen::Index row, Eigen::Index column, const From& lanes) {
    const bool whole = column + packet_width <= image.cols();
    const auto columns = static_cast<std::size_t>(std::min(packet_width, image.cols() - column));
    for (Eigen::Index y = 0; y < std::min(packet_height, image.rows() - row); ++y) {
      const T* const from = lanes.data() + y * packet_width;
      T* const to = &image(row + y, column);
      if (whole)
        std::memcpy(to, from, packet_width * sizeof(T));  // a number of bytes that the compiler knows
      else
        std::memcpy(to, from, columns * sizeof(T));
    }
  }

  RayScene rays_;
  std::shared_ptr<const Appearance> appearance_;
};

inline SceneRenderer::SceneRenderer(const Scene& scene, const Config& config)
    : rays_((scene.validate("SceneRenderer"), scene.mesh), config.rays), appearance_(appearance(scene, config)) {}

inline std::shared_ptr<const SceneRenderer::Appearance> SceneRenderer::appearance(const Scene& scene,
                                                                                  const Config& config) {
  config.lighting.validate();
  const Eigen::Vector3f& background = config.background;
  Check check("SceneRendererConfig");
  check((background.array() >= 0).all() && (background.array() <= 1).all(), "background", background.transpose(),
        "in [0, 1]");
  check.done();

  auto a = std::make_shared<Appearance>();
  a->textures = TextureAtlas(scene.textures);
  const std::size_t n = scene.mesh.triangles.size();
  a->surfaces.resize(n + 1);
  a->labels.resize(n + 1);
  for (std::size_t c = 0; c < 6; ++c) a->surfaces[n].colour[c] = background[static_cast<Eigen::Index>(c % 3)];
  if (!scene.mesh.colours.empty())
    a->corner_colours.resize(n + 1, {Eigen::Vector3f::Ones(), Eigen::Vector3f::Ones(), Eigen::Vector3f::Ones()});
  parallel_for_blocks(n, 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Surface& s = a->surfaces[i];
      const Material& material = scene.materials[scene.material.empty() ? 0 : scene.material[i]];
      const Eigen::Vector3d normal = scene.mesh.area_normal(i).stableNormalized();
      const Eigen::Vector3f front = material.colour.cwiseProduct(config.lighting.shade(normal));
      const Eigen::Vector3f back = material.colour.cwiseProduct(config.lighting.shade(-normal));
      s.colour = {front.x(), front.y(), front.z(), back.x(), back.y(), back.z()};
      if (!scene.label.empty()) a->labels[i] = scene.label[i];
      if (material.texture && !scene.uv.empty()) {
        set_texture(scene, i, *material.texture, s);
        s.texture = a->textures.levels(*material.texture);
      }
      if (!scene.mesh.colours.empty())
        for (std::size_t k = 0; k < 3; ++k) a->corner_colours[i][k] = scene.mesh.colours[scene.mesh.triangles[i][k]];
    }
  });
  return a;
}

inline void SceneRenderer::set_texture(const Scene& scene, std::size_t triangle, std::uint32_t texture, Surface& s) {
  const auto& [p, q, r] = scene.uv[triangle];
  for (const Eigen::Vector2f& corner : {p, q, r})
    if (!(corner.cwiseAbs().maxCoeff() <= 1e6F))
      throw Error("SceneRenderer", concat("triangle ", triangle, " has texture coordinates (", corner.transpose(), ")"),
                  "at most 1e6 repetitions");
  const Eigen::Vector2f origin(p.x() - std::floor(p.x()), p.y() - std::floor(p.y()));  // near 0: textures repeat
  const Eigen::Vector2f along_1 = q - p, along_2 = r - p;
  s.u = origin.x();
  s.v = origin.y();
  s.u_1 = along_1.x();
  s.v_1 = along_1.y();
  s.u_2 = along_2.x();
  s.v_2 = along_2.y();
  s.texels = std::abs(along_1.x() * along_2.y() - along_1.y() * along_2.x()) *
             static_cast<float>(scene.textures[texture].width) * static_cast<float>(scene.textures[texture].height);
}

// Out of line, for g++ unrolls these loops over lanes where they stand within another one, before it can vectorise
// them.
[[gnu::noinline]] inline void SceneRenderer::Met::read(const Surface& s, std::uint32_t i, std::size_t lane) {
  const Indices is = surface;
  const auto set = [&](auto& to, auto value) {
    for (std::size_t k = 0; k < is.size(); ++k) to.data()[k] = is[k] == i ? value : to.data()[k];
  };
  const std::size_t side = along[static_cast<Eigen::Index>(lane)] > 0 ? 3 : 0;  // one for all lanes of a triangle
  for (std::size_t c = 0; c < 3; ++c) set(colour[c], s.colour[side + c]);
  set(u, s.u);
  set(v, s.v);
  set(u_1, s.u_1);
  set(v_1, s.v_1);
  set(u_2, s.u_2);
  set(v_2, s.v_2);
  set(texels, s.texels);
  set(first, s.texture.first);
  set(last, s.texture.last);
  textured |= s.texture.first > 0;
}

// Neighbours meet few surfaces: each is read once, for all lanes that meet it.
inline void SceneRenderer::meet(const RayPacket& packet, Met& met) const {
  constexpr std::size_t size = RayPacket::size, width = packet_width;
  const std::vector<Surface>& surfaces = appearance_->surfaces;
  alignas(64) std::array<std::uint32_t, width + size> id;
  for (std::size_t k = 0; k < width; ++k) id[k] = RayPacket::none;  // above the packet: none of them
  for (std::size_t k = 0; k < size; ++k) id[width + k] = met.surface[k];
  met.along = packet.direction_x * packet.normal_x + packet.direction_y * packet.normal_y +
              packet.direction_z * packet.normal_z;
  met.textured = false;
  std::uint32_t differ = 0;  // from the lane before and from the one above
  for (std::size_t k = 0; k < size; ++k)
    differ |= (id[width + k] != id[width + k - 1] && id[width + k] != id[k] ? 1U : 0U) << k;
  for (; differ != 0; differ &= differ - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(differ));
    met.read(surfaces[met.surface[lane]], met.surface[lane], lane);
  }
}

inline void SceneRenderer::find_texels(const RayPacket& packet, float pixel_area, Met& met) const {
  // A pixel covers pixel_area z^2 of a plane at depth z, and 1 / |n . d| as much of the surface (d_z = 1, |n| = 1).
  const Lanes depth = packet.distance.min(1e15F);  // what meets nothing is no NaN, either
  appearance_->textures.find({.first = met.first,
                              .last = met.last,
                              .u = met.u + packet.u * met.u_1 + packet.v * met.u_2,
                              .v = met.v + packet.u * met.v_1 + packet.v * met.v_2,
                              .texels = pixel_area * depth.square() * met.texels / met.along.abs().max(1e-30F)},
                             met.samples);
}

inline void SceneRenderer::shade(const RayPacket& packet, const Met& met, std::array<Lanes, 3>& rgb) const {
  const Appearance& a = *appearance_;
  rgb = met.colour;
  if (met.textured) {
    std::array<Lanes, 3> sample;
    a.textures.colours(met.samples, sample);
    for (std::size_t c = 0; c < 3; ++c) rgb[c] *= sample[c];
  }
  if (!a.corner_colours.empty())
    for (std::size_t k = 0; k < met.surface.size(); ++k) {
      const auto lane = static_cast<Eigen::Index>(k);
      const auto& [p, q, r] = a.corner_colours[met.surface[k]];
      const Eigen::Vector3f colour = p + packet.u[lane] * (q - p) + packet.v[lane] * (r - p);
      for (std::size_t c = 0; c < 3; ++c) rgb[c][lane] *= colour[static_cast<Eigen::Index>(c)];
    }
  for (Lanes& c : rgb) c = c.max(0.F).min(1.F);
}

template <class... Channels>
void SceneRenderer::render(const View& view, const Camera& camera, Rendering<Channels...>& out) const {
  constexpr auto wanted = []<class Channel>(Channel*) { return (std::is_same_v<Channels, Channel> || ...); };
  constexpr bool colour = wanted(static_cast<channel::Colour*>(nullptr));
  constexpr bool depth = wanted(static_cast<channel::Depth*>(nullptr));
  constexpr bool normal = wanted(static_cast<channel::Normal*>(nullptr));
  constexpr bool labels = wanted(static_cast<channel::Labels*>(nullptr));
  static_assert(colour + depth + normal + labels == sizeof...(Channels),
                "a scene has Colour, Depth, Normal and Labels");
  check_view(view, "SceneRenderer::render");
  camera.validate();
  const Eigen::Index width = camera.width, height = camera.height;
  if constexpr (colour) out.channel::Colour::resize(height, width);
  if constexpr (depth) out.depth.resize(height, width);
  if constexpr (labels) out.labels.resize(height, width);
  if constexpr (normal)
    for (Image<float>* plane : {&out.x, &out.y, &out.z}) plane->resize(height, width);

  // Direction of the pixel (x, y): forward + (x - cx) right + (y - cy) down, so that a distance is a depth.
  const Eigen::Matrix3d r = view.T_W_C.linear();
  const Eigen::Vector3f right = (r.col(0) / camera.fx).cast<float>(), down = (r.col(1) / camera.fy).cast<float>();
  const Eigen::Vector3f forward = r.col(2).cast<float>();
  const auto pixel_area = static_cast<float>(1 / (camera.fx * camera.fy));
  const Surface* const surfaces = appearance_->surfaces.data();
  const auto background = static_cast<std::uint32_t>(appearance_->surfaces.size() - 1);
  const Eigen::Index columns = (width + tile_width - 1) / tile_width, rows = (height + tile_height - 1) / tile_height;
  parallel_for(static_cast<std::size_t>(rows * columns), [&](std::size_t i) {
    const Eigen::Index top = static_cast<Eigen::Index>(i) / columns * tile_height,
                       left = static_cast<Eigen::Index>(i) % columns * tile_width;
    Lanes lane_x, lane_y;  // pixel centres
    for (Eigen::Index k = 0; k < RayPacket::size; ++k) {
      const Eigen::Index row = k / packet_width;
      lane_x[k] = static_cast<float>(k % packet_width) + 0.5F;
      lane_y[k] = static_cast<float>(row) + 0.5F;
    }
    std::array<RayPacket, tile_width / packet_width> packets;
    std::array<Met, tile_width / packet_width> mets;
    const auto n = static_cast<std::size_t>((std::min(tile_width, width - left) + packet_width - 1) / packet_width);
    for (RayPacket& packet : packets) packet.origin = view.position().cast<float>();
    for (Eigen::Index row = top; row < std::min(top + tile_height, height); row += packet_height) {
      for (std::size_t p = 0; p < n; ++p) {
        RayPacket& packet = packets[p];
        const Eigen::Index column = left + static_cast<Eigen::Index>(p) * packet_width;
        const Lanes x = static_cast<float>(static_cast<double>(column) - camera.cx) + lane_x;
        const Lanes y = static_cast<float>(static_cast<double>(row) - camera.cy) + lane_y;
        packet.direction_x = forward.x() + x * right.x() + y * down.x();
        packet.direction_y = forward.y() + x * right.y() + y * down.y();
        packet.direction_z = forward.z() + x * right.z() + y * down.z();
        rays_.cast(packet);
        for (std::size_t k = 0; k < mets[p].surface.size(); ++k) {
          mets[p].surface[k] = std::min(packet.triangle[k], background);
          if constexpr (colour) __builtin_prefetch(&surfaces[mets[p].surface[k]]);
        }
      }
      if constexpr (colour)
        for (std::size_t p = 0; p < n; ++p) {
          meet(packets[p], mets[p]);
          if (mets[p].textured) find_texels(packets[p], pixel_area, mets[p]);
        }
      for (std::size_t p = 0; p < n; ++p) {
        const RayPacket& packet = packets[p];
        const Met& met = mets[p];
        const Eigen::Index column = left + static_cast<Eigen::Index>(p) * packet_width;
        if constexpr (colour) {
          std::array<Lanes, 3> rgb;
          shade(packet, met, rgb);
          store(out.r, row, column, rgb[0]);
          store(out.g, row, column, rgb[1]);
          store(out.b, row, column, rgb[2]);
        }
        if constexpr (depth)  // infinity less itself is NaN
          store(out.depth, row, column, Lanes(packet.distance + (packet.distance - packet.distance)));
        if constexpr (normal) {
          const Lanes along = packet.direction_x * packet.normal_x + packet.direction_y * packet.normal_y +
                              packet.direction_z * packet.normal_z;
          const Lanes square = packet.normal_x.square() + packet.normal_y.square() + packet.normal_z.square();
          const Lanes unit = packet.distance.isFinite().select(
              (along > 0).select(-1.F / square.sqrt(), 1.F / square.sqrt()), std::numeric_limits<float>::quiet_NaN());
          store(out.x, row, column, Lanes(packet.normal_x * unit));
          store(out.y, row, column, Lanes(packet.normal_y * unit));
          store(out.z, row, column, Lanes(packet.normal_z * unit));
        }
        if constexpr (labels) {
          std::array<std::uint16_t, static_cast<std::size_t>(RayPacket::size)> label;
          for (std::size_t k = 0; k < label.size(); ++k) label[k] = appearance_->labels[met.surface[k]];
          store(out.labels, row, column, label);
        }
      }
    }
  });
}

}  // namespace vantage
