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
/// for its area). Pixels are taken 8 x 2 at a time through ray, hit and colour, as structures of arrays. Owns copies of
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
  using Indices = TextureAtlas::Indices;
  using Floats = TextureAtlas::Floats;
  static constexpr Eigen::Index packet_width = 8, packet_height = 2, tile = 32;
  static constexpr std::uint32_t no_texture = ~0U;

  /// One cache line a triangle; the last one is the background.
  struct alignas(64) Surface {
    std::array<float, 6> colour = {};                        ///< times light: RGB of the front, of the back
    float u = 0, v = 0, u_1 = 0, v_1 = 0, u_2 = 0, v_2 = 0;  ///< at the first corner; along both edges
    float texels = 0;                                        ///< of the full texture, in twice the triangle
    std::uint32_t texture = no_texture, label = 0;
  };
  struct Appearance {
    std::vector<Surface> surfaces;
    std::vector<std::array<Eigen::Vector3f, 3>> corner_colours;  ///< of each triangle, or none
    TextureAtlas textures;
  };
  static std::shared_ptr<const Appearance> appearance(const Scene& scene, const Config& config);
  static void set_texture(const Scene& scene, std::size_t triangle, std::uint32_t texture, Surface& surface);

  /// The surfaces that a packet's rays meet; mostly it is one.
  struct Met {
    alignas(64) Indices surface;
    bool one = false;
  };
  [[nodiscard]] Met met(const RayPacket& packet) const;
  /// f(surface, lane) for all lanes; where all meet one surface they are on the same side of it, so that one lane says
  /// it for all.
  template <class To, class F>
  void gather(const Met& met, To& to, F&& f) const {
    const std::vector<Surface>& surfaces = appearance_->surfaces;
    if (met.one)
      to.fill(f(surfaces[met.surface[0]], 0));
    else
      for (std::size_t k = 0; k < to.size(); ++k) to[k] = f(surfaces[met.surface[k]], k);
  }
  /// Colours of a packet's pixels, each of which is `pixel_area` at depth 1.
  void shade(const RayPacket& packet, const Met& met, float pixel_area, std::array<Lanes, 3>& rgb) const;
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
      s.label = scene.label.empty() ? 0 : scene.label[i];
      if (material.texture && !scene.uv.empty()) set_texture(scene, i, *material.texture, s);
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
  s.texture = texture;
  s.u = origin.x();
  s.v = origin.y();
  s.u_1 = along_1.x();
  s.v_1 = along_1.y();
  s.u_2 = along_2.x();
  s.v_2 = along_2.y();
  s.texels = std::abs(along_1.x() * along_2.y() - along_1.y() * along_2.x()) *
             static_cast<float>(scene.textures[texture].width) * static_cast<float>(scene.textures[texture].height);
}

// Eigen's arrays where there is arithmetic; loops over lanes, which compilers vectorise, for the rest.
inline void SceneRenderer::shade(const RayPacket& packet, const Met& met, float pixel_area,
                                 std::array<Lanes, 3>& rgb) const {
  const Appearance& a = *appearance_;
  const Lanes along = packet.direction_x * packet.normal_x + packet.direction_y * packet.normal_y +
                      packet.direction_z * packet.normal_z;
  alignas(64) Indices side, texture;
  for (std::size_t k = 0; k < side.size(); ++k) side[k] = along[static_cast<Eigen::Index>(k)] > 0 ? 3 : 0;
  gather(met, texture, [](const Surface& s, std::size_t) { return s.texture; });
  alignas(64) Floats value;
  const Eigen::Map<const Lanes, Eigen::Aligned64> values(value.data());
  for (std::size_t c = 0; c < 3; ++c) {
    gather(met, value, [&](const Surface& s, std::size_t k) { return s.colour[side[k] + c]; });
    rgb[c] = values;
  }

  bool textured = false;
  for (const std::uint32_t t : texture) textured |= t != no_texture;
  if (textured) {
    const auto along_edges = [&](auto&& first, auto&& edge_1, auto&& edge_2) -> Lanes {
      const auto all = [&](auto&& member) -> Lanes {
        gather(met, value, [&](const Surface& s, std::size_t) { return s.*member; });
        return values;
      };
      return all(first) + packet.u * all(edge_1) + packet.v * all(edge_2);
    };
    const Lanes u = along_edges(&Surface::u, &Surface::u_1, &Surface::u_2);
    const Lanes v = along_edges(&Surface::v, &Surface::v_1, &Surface::v_2);
    // A pixel covers pixel_area z^2 of a plane at depth z, and 1 / |n . d| as much of the surface (d_z = 1, |n| = 1).
    gather(met, value, [](const Surface& s, std::size_t) { return s.texels; });
    const Lanes depth = packet.distance.min(1e15F);  // what meets nothing is no NaN, either
    const Lanes texels = pixel_area * depth.square() * values / along.abs().max(1e-30F);
    alignas(64) Floats is_textured;
    for (std::size_t k = 0; k < texture.size(); ++k) {
      is_textured[k] = texture[k] == no_texture ? 0.F : 1.F;
      texture[k] = texture[k] == no_texture ? 0 : texture[k];
    }
    const Eigen::Map<const Lanes, Eigen::Aligned64> mask(is_textured.data());
    std::array<Lanes, 3> sample;
    a.textures.sample(texture, u, v, texels, sample);
    for (std::size_t c = 0; c < 3; ++c) rgb[c] *= 1 + mask * (sample[c] - 1);
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

inline SceneRenderer::Met SceneRenderer::met(const RayPacket& packet) const {
  const auto background = static_cast<std::uint32_t>(appearance_->surfaces.size() - 1);
  Met m;
  std::uint32_t differ = 0;
  for (std::size_t k = 0; k < m.surface.size(); ++k) {
    m.surface[k] = std::min(packet.triangle[k], background);
    differ |= packet.triangle[k] ^ packet.triangle[0];
  }
  m.one = differ == 0;
  return m;
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
  const Eigen::Index columns = (width + tile - 1) / tile, rows = (height + tile - 1) / tile;
  parallel_for(static_cast<std::size_t>(rows * columns), [&](std::size_t i) {
    const Eigen::Index top = static_cast<Eigen::Index>(i) / columns * tile,
                       left = static_cast<Eigen::Index>(i) % columns * tile;
    Lanes lane_x, lane_y;  // pixel centres
    for (Eigen::Index k = 0; k < RayPacket::size; ++k) {
      const Eigen::Index row = k / packet_width;
      lane_x[k] = static_cast<float>(k % packet_width) + 0.5F;
      lane_y[k] = static_cast<float>(row) + 0.5F;
    }
    RayPacket packet;
    packet.origin = view.position().cast<float>();
    for (Eigen::Index row = top; row < std::min(top + tile, height); row += packet_height)
      for (Eigen::Index column = left; column < std::min(left + tile, width); column += packet_width) {
        const Lanes x = static_cast<float>(static_cast<double>(column) - camera.cx) + lane_x;
        const Lanes y = static_cast<float>(static_cast<double>(row) - camera.cy) + lane_y;
        packet.direction_x = forward.x() + x * right.x() + y * down.x();
        packet.direction_y = forward.y() + x * right.y() + y * down.y();
        packet.direction_z = forward.z() + x * right.z() + y * down.z();
        rays_.cast(packet);
        const Met surfaces = met(packet);
        if constexpr (colour) {
          std::array<Lanes, 3> rgb;
          shade(packet, surfaces, pixel_area, rgb);
          store(out.r, row, column, rgb[0]);
          store(out.g, row, column, rgb[1]);
          store(out.b, row, column, rgb[2]);
        }
        if constexpr (depth) {
          const Lanes z = packet.distance.isFinite().select(packet.distance, std::numeric_limits<float>::quiet_NaN());
          store(out.depth, row, column, z);
        }
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
          gather(surfaces, label, [](const Surface& s, std::size_t) { return static_cast<std::uint16_t>(s.label); });
          store(out.labels, row, column, label);
        }
      }
  });
}

}  // namespace vantage
