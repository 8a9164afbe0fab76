// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include <Eigen/Core>

#include <vantage/core/error.hpp>
#include <vantage/geometry/box.hpp>
#include <vantage/geometry/scene.hpp>
#include <vantage/geometry/triangle_mesh.hpp>

// The only file that knows Embree: version 3.13; another version is another branch here.
namespace vantage {

/// A ray in the world frame. The direction may have any length > 0; distances are in metres.
struct Ray {
  Eigen::Vector3d origin, direction;
  double near_m = 0, far_m = std::numeric_limits<double>::infinity();
};

/// What a ray meets first.
struct Hit {
  double distance_m;
  std::uint32_t triangle;
  double u, v;             ///< the point is (1 - u - v) a + u b + v c of the triangle's corners
  Eigen::Vector3d normal;  ///< unit; the side from which the corners are counter-clockwise
};

/// Sixteen rays from one eye, and what they meet: a structure of arrays. Fastest if they are neighbouring pixels.
struct RayPacket {
  static constexpr int size = 16;
  static constexpr std::uint32_t none = RTC_INVALID_GEOMETRY_ID;
  using Lanes = Eigen::Array<float, size, 1>;

  Eigen::Vector3f origin;
  Lanes direction_x, direction_y, direction_z;
  Lanes distance;                            ///< in lengths of the direction; infinite where nothing is met
  std::array<std::uint32_t, size> triangle;  ///< `none` where nothing is met
  Lanes u, v;                                ///< as in Hit; 0 where nothing is met
  Lanes normal_x, normal_y, normal_z;        ///< as in Hit, but of twice the triangle's area in length; or 0
};

struct RaySceneConfig {
  /// No ray passes between two triangles that share an edge; costs a fifth of the speed. Off, one pixel in about a
  /// million does.
  bool watertight = true;
  /// Spends twice the time on a hierarchy that is up to a tenth faster. Has no effect on watertight scenes.
  bool high_quality = false;
};

/// Triangles that rays can be shot at: Embree's bounding volume hierarchy (Wald et al., "Embree: a kernel framework for
/// efficient CPU ray tracing", ACM TOG 2014), built on all threads. Owns a copy of the triangles; does not change, so
/// that const members run concurrently and copies share it.
class RayScene {
 public:
  using Config = RaySceneConfig;

  /// Throws Error for a mesh without triangles, with a vertex that is not finite (Embree would drop its triangles
  /// without a word), with an index out of range, and for what Embree refuses. O(n log n).
  explicit RayScene(const TriangleMesh& mesh, const Config& config = {});
  explicit RayScene(const Scene& scene, const Config& config = {}) : RayScene(scene.mesh, config) {}

  /// What the ray meets first between near and far, if anything. Throws Error for a ray that is not finite (Embree
  /// would abort the process) or has no direction.
  [[nodiscard]] std::optional<Hit> cast(const Ray& ray) const;
  /// Whether anything lies on the ray between near and far; faster than `cast`. Throws as `cast` does.
  [[nodiscard]] bool occluded(const Ray& ray) const;
  /// Sixteen rays at once, in as many steps as the machine's vectors are wide (AVX-512: one). Throws as `cast` does.
  void cast(RayPacket& packet) const;

  [[nodiscard]] std::size_t triangles() const { return triangles_; }
  /// Of the vertices that triangles use [m].
  [[nodiscard]] const Box3& bounds() const { return bounds_; }

 private:
  // Handles of Embree are counted references; what it complains about reaches `complain`.
  template <class Handle>
  using Owned = std::shared_ptr<std::remove_pointer_t<Handle>>;
  static void complain(void* text, RTCError, const char* message) { static_cast<std::string*>(text)->assign(message); }
  /// Throws Error if Embree has complained.
  static void check(RTCDevice device, const std::string& complaint) {
    if (const RTCError code = rtcGetDeviceError(device); code != RTC_ERROR_NONE)
      throw Error("RayScene", concat("Embree's error ", static_cast<int>(code), " ", complaint));
  }
  static RTCRayHit embree(const Ray& ray);

  Owned<RTCScene> scene_;
  std::size_t triangles_;
  Box3 bounds_;
};

inline RayScene::RayScene(const TriangleMesh& mesh, const Config& config) : triangles_(mesh.triangles.size()) {
  mesh.validate("RayScene");
  if (mesh.empty()) throw Error("RayScene", "the mesh has no triangle", "at least one");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) bounds_.extend(mesh.vertices[v].cast<double>());
  if (bounds_.min().cwiseAbs().cwiseMax(bounds_.max().cwiseAbs()).maxCoeff() > 1e9)
    throw Error("RayScene", "a vertex lies farther than 1e9 m from the origin", "a scene in metres");

  // No options are passed on: once it has refused one, Embree 3.13.5 never returns from the next rtcNewDevice.
  std::string complaint;
  const Owned<RTCDevice> device(rtcNewDevice(nullptr), [](RTCDevice d) { d ? rtcReleaseDevice(d) : void(); });
  check(device.get(), "(no device)");
  rtcSetDeviceErrorFunction(device.get(), complain, &complaint);
  const Owned<RTCGeometry> geometry(rtcNewGeometry(device.get(), RTC_GEOMETRY_TYPE_TRIANGLE), rtcReleaseGeometry);
  const auto fill = [&](RTCBufferType type, RTCFormat format, const auto& items) {
    using Item = typename std::decay_t<decltype(items)>::value_type;
    static_assert(sizeof(Item) == 12);
    void* const buffer = rtcSetNewGeometryBuffer(geometry.get(), type, 0, format, sizeof(Item), items.size());
    check(device.get(), complaint);
    std::memcpy(buffer, static_cast<const void*>(items.data()), sizeof(Item) * items.size());
  };
  fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices);
  fill(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
  const RTCBuildQuality quality = config.high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
  rtcSetGeometryBuildQuality(geometry.get(), quality);
  rtcCommitGeometry(geometry.get());

  scene_ = Owned<RTCScene>(rtcNewScene(device.get()), rtcReleaseScene);
  rtcSetSceneFlags(scene_.get(), config.watertight ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
  rtcSetSceneBuildQuality(scene_.get(), quality);
  rtcAttachGeometry(scene_.get(), geometry.get());
  rtcCommitScene(scene_.get());
  check(device.get(), complaint);
  rtcSetDeviceErrorFunction(device.get(), nullptr, nullptr);
}

inline RTCRayHit RayScene::embree(const Ray& ray) {
  const Eigen::Vector3f origin = ray.origin.cast<float>();
  const double length = ray.direction.stableNorm();
  if (!origin.allFinite() || !std::isfinite(length) || !(length > 0) || !(ray.near_m >= 0) || std::isnan(ray.far_m))
    throw Error("RayScene::cast",
                concat("a ray from (", ray.origin.transpose(), ") along (", ray.direction.transpose(), "), ",
                       ray.near_m, " to ", ray.far_m, " m"),
                "finite numbers, a direction, and near >= 0");
  const Eigen::Vector3f direction = (ray.direction / length).cast<float>();
  RTCRayHit r = {};
  r.ray.org_x = origin.x();
  r.ray.org_y = origin.y();
  r.ray.org_z = origin.z();
  r.ray.dir_x = direction.x();
  r.ray.dir_y = direction.y();
  r.ray.dir_z = direction.z();
  r.ray.tnear = static_cast<float>(ray.near_m);
  r.ray.tfar = static_cast<float>(ray.far_m);
  r.ray.mask = ~0U;
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return r;
}

inline std::optional<Hit> RayScene::cast(const Ray& ray) const {
  RTCRayHit r = embree(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_.get(), &context, &r);
  if (r.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{r.ray.tfar, r.hit.primID, r.hit.u, r.hit.v,
             Eigen::Vector3d(r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z).stableNormalized()};
}

inline bool RayScene::occluded(const Ray& ray) const {
  RTCRay r = embree(ray).ray;
  if (r.tnear > r.tfar) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_.get(), &context, &r);
  return r.tfar < 0;  // Embree's sign for a hit: minus infinity
}

inline void RayScene::cast(RayPacket& p) const {
  using Lanes = RayPacket::Lanes;
  // Squares of what is not finite, too long or too short are not in here: NaN fails both comparisons.
  const Lanes square = p.direction_x.square() + p.direction_y.square() + p.direction_z.square();
  if (!(square > 1e-12F).all() || !(square < 1e12F).all() || !(p.origin.array().abs() < 1e18F).all())
    throw Error("RayScene::cast", "a ray of the packet is not finite or has no direction",
                "finite numbers, lengths of 1e-6 to 1e6");
  RTCRayHit16 r;
  const auto lanes = [](auto* to) { return Eigen::Map<Lanes, Eigen::Aligned64>(to); };
  lanes(r.ray.org_x) = p.origin.x();
  lanes(r.ray.org_y) = p.origin.y();
  lanes(r.ray.org_z) = p.origin.z();
  lanes(r.ray.dir_x) = p.direction_x;
  lanes(r.ray.dir_y) = p.direction_y;
  lanes(r.ray.dir_z) = p.direction_z;
  lanes(r.ray.tnear) = 0;
  lanes(r.ray.tfar) = std::numeric_limits<float>::infinity();
  lanes(r.ray.time) = 0;
  for (float* unless_met : {r.hit.u, r.hit.v, r.hit.Ng_x, r.hit.Ng_y, r.hit.Ng_z}) lanes(unless_met) = 0;
  alignas(64) int all[RayPacket::size];
  for (int k = 0; k < RayPacket::size; ++k) {
    all[k] = -1;
    r.ray.mask[k] = ~0U;
    r.ray.flags[k] = 0;
    r.hit.primID[k] = RayPacket::none;
    r.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
    r.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;  // one frustum for the packet: five times the speed
  rtcIntersect16(all, scene_.get(), &context, &r);
  p.distance = lanes(r.ray.tfar);
  p.u = lanes(r.hit.u);
  p.v = lanes(r.hit.v);
  p.normal_x = lanes(r.hit.Ng_x);
  p.normal_y = lanes(r.hit.Ng_y);
  p.normal_z = lanes(r.hit.Ng_z);
  for (std::size_t k = 0; k < p.triangle.size(); ++k) p.triangle[k] = r.hit.primID[k];
}

}  // namespace vantage
