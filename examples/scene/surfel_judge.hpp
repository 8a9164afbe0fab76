// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <vantage/eval/image_metrics.hpp>
#include <vantage/io/colour_map.hpp>
#include <vantage/io/picture.hpp>
#include <vantage/loop/nbv_loop.hpp>
#include <vantage/maps/surfel/surfel_mesh.hpp>
#include <vantage/mission/record.hpp>
#include <vantage/sim/scene_renderer.hpp>

#include "input.hpp"
#include "missions.hpp"
#include "truth.hpp"

namespace scene {

/// The surface of a surfel map, with the truncation of our other volumes.
template <class M>
TriangleMesh surface_of(const M& map, const Box3& bounds, double voxel_m) {
  return surfel_mesh(map, bounds, {.voxel_m = voxel_m, .truncation_m = 5 * voxel_m});
}

/// Observer that knows the truth: every so many seconds of mission time, how like the scene the map's renderings are,
/// and how complete its surface is (section 6.2.2). What it does is not counted as mission time. Persistent.
class SurfelJudge {
 public:
  SurfelJudge(const Input& input, const Options& o)
      : input_(input),
        options_(o),
        truth_(*input.scene),
        camera_(Camera::from_fov(o.pixels, o.pixels, deg(o.field_of_view_deg))) {
    const std::size_t n = std::min<std::size_t>(static_cast<std::size_t>(o.test_views), input.views.size());
    for (std::size_t i = 0; i < n; ++i) views_.push_back(input.views[i * input.views.size() / n]);
  }

  template <class M, class Z>
  void measured(const M& map, const Situation& q, const Step<Z>&) {
    last_.reset();
    if (q.elapsed_s < next_s_) return;
    last_ = judge(map, q.elapsed_s);
    scores_.push_back(*last_);
    while (next_s_ <= q.elapsed_s) next_s_ += options_.judge_every_s;
  }
  /// For the recorder, after `measured`; NaN where it was not due.
  template <class M>
  [[nodiscard]] std::vector<Metric> metrics(const M& map) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    return {{"psnr", last_ ? last_->psnr_db : none},
            {"completeness", last_ ? last_->completeness : none},
            {"surfels", static_cast<double>(map.surfels().size())}};
  }
  template <class M>
  [[nodiscard]] Score judge(const M& map, double elapsed_s) const {
    double sum_db = 0;
    for (const View& view : views_) {
      Rendering<channel::Colour> drawn, seen;
      map.render(view, camera_, drawn);
      truth_.render(view, camera_, seen);
      sum_db += psnr(static_cast<const ColourImage&>(drawn), static_cast<const ColourImage&>(seen));
    }
    const TriangleMesh mesh = surface_of(map, input_.bounds, options_.voxel_m);
    const double complete = mesh.empty() ? 0 : against_truth(mesh, input_, options_.threshold_m).completeness;
    return {elapsed_s, sum_db / static_cast<double>(views_.size()), complete};
  }
  [[nodiscard]] const std::vector<Score>& scores() const { return scores_; }

  /// What the map draws from a test view beside the truth: colour, truth, confidence, normals.
  template <class M>
  [[nodiscard]] Picture compare(const M& map, std::size_t view, int width = 360) const {
    Rendering<channel::Colour, channel::Confidence, channel::Normal> drawn;
    Rendering<channel::Colour> seen;
    const Camera camera = Camera::from_fov(width, width, deg(options_.field_of_view_deg));
    map.render(views_[view], camera, drawn);
    truth_.render(views_[view], camera, seen);
    Picture picture(4 * width, width);
    const auto rgb = [](double r, double g, double b) {
      return Rgb{to_byte(static_cast<float>(r)), to_byte(static_cast<float>(g)), to_byte(static_cast<float>(b))};
    };
    for (int y = 0; y < width; ++y)
      for (int x = 0; x < width; ++x) {
        picture(y, x) =
            rgb(drawn.channel::Colour::r(y, x), drawn.channel::Colour::g(y, x), drawn.channel::Colour::b(y, x));
        picture(y, x + width) = rgb(seen.r(y, x), seen.g(y, x), seen.b(y, x));
        picture(y, x + 2 * width) = viridis(static_cast<double>(drawn.confidence(y, x)));
        const channel::Normal& n = drawn;
        picture(y, x + 3 * width) = rgb(0.5 + 0.5 * n.x(y, x), 0.5 + 0.5 * n.y(y, x), 0.5 + 0.5 * n.z(y, x));
      }
    return picture;
  }
  [[nodiscard]] std::size_t test_views() const { return views_.size(); }

  void save(Sink& sink) const {
    sink.put(next_s_);
    sink.put(static_cast<std::uint64_t>(scores_.size()));
    for (const Score& s : scores_)
      for (const double x : {s.elapsed_s, s.psnr_db, s.completeness}) sink.put(x);
  }
  void load(Source& source) {
    const auto next_s = source.get<double>();
    std::vector<Score> scores;
    for (auto n = source.get<std::uint64_t>(); n > 0; --n) {
      Score& s = scores.emplace_back();
      for (double* x : {&s.elapsed_s, &s.psnr_db, &s.completeness}) source.get(*x);
    }
    next_s_ = next_s;
    scores_ = std::move(scores);
  }

 private:
  const Input& input_;
  const Options& options_;
  SceneRenderer truth_;
  Camera camera_;
  std::vector<View> views_;
  double next_s_ = 0;
  std::optional<Score> last_;
  std::vector<Score> scores_;
};

}  // namespace scene
