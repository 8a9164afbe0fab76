// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <map>

#include "kernels/surfel_input.hpp"

#include <vantage/maps/surfel/surfel_map.hpp>
#include <vantage/maps/surfel/tile_rasteriser.hpp>

namespace bench {

inline constexpr int frame_pixels = 512;

/// What a camera sees of the surfels, as a frame.
inline vantage::Frame surfel_frame(const vantage::Surfels& s, const vantage::View& view) {
  using namespace vantage;
  Frame f;
  f.camera = Camera::from_fov(frame_pixels, frame_pixels, deg(60));
  f.view = view;
  TileRasteriser<>::Pass pass;
  Rendering<channel::Colour, channel::Depth> drawn;
  TileRasteriser<>().forward(s, {.view = f.view, .camera = f.camera}, pass, drawn);
  Rng rng(7);
  f.depth = drawn.depth;
  for (Eigen::Index i = 0; i < f.depth.size(); ++i) f.depth.data()[i] *= static_cast<float>(1 + 0.01 * rng.normal());
  for (auto plane : {&ColourImage::r, &ColourImage::g, &ColourImage::b}) {
    f.colour.*plane = (static_cast<const ColourImage&>(drawn).*plane).max(0.0F).min(1.0F);
  }
  return f;
}
/// The same from the middle of the room, in direction k of so many.
inline vantage::Frame surfel_frame(const vantage::Surfels& s, int k, int of) {
  const double heading = 6.2831853 * k / of;
  const Eigen::Vector3d eye(2.2, 2.4, 1.5), ahead(std::cos(heading), std::sin(heading), 0.8 * std::sin(1.7 * k));
  return surfel_frame(s, vantage::look_at(eye, eye + ahead));
}

/// What all of the room lies in.
inline vantage::Box3 room_bounds() { return {Eigen::Vector3d(-0.1, -0.1, -0.1), Eigen::Vector3d(6.1, 5.1, 2.7)}; }

/// A map of about 300 k surfels that has seen so many frames of the room, not trained; made once.
inline const vantage::SurfelMap<>& map_after(int frames) {
  using namespace vantage;
  static std::map<int, SurfelMap<>> made;
  if (const auto it = made.find(frames); it != made.end()) return it->second;
  SurfelMap<>::Config c;
  c.voxels.bounds = room_bounds();
  c.iterations = 0;
  c.prune.every_frames = 1000;
  c.densify.spacing_m = 0.03;  // untrained surfels are spawned again by every frame: about 300 k in the end
  SurfelMap<> untrained(c);
  const Surfels truth = room_surfels(300000, 0.01, 2);
  Rng rng(1);
  for (int k = 0; k < frames; ++k) untrained.integrate(surfel_frame(truth, k, 10), rng);
  Sink sink;
  untrained.save(sink);
  c.iterations = 10;
  c.prune.every_frames = 5;
  c.densify.spacing_m = 0.02;
  SurfelMap<>& map = made.try_emplace(frames, c).first->second;
  Source source(sink.bytes());
  map.load(source);
  return map;
}

}  // namespace bench
