// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#include "flight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <vantage/io/file.hpp>
#include <vantage/mission/canvas.hpp>

#include "truth.hpp"

namespace scene {
namespace {

constexpr Rgb ink = {20, 20, 20}, blue = {0, 114, 178};

// After a step of the mission.
Picture from_above(const Referee::Growth& growth, const Referee& referee, const MissionRecord& record, int longer_px) {
  Canvas canvas(referee.growth().back().plan.known(), longer_px);
  growth.plan.fill(canvas);
  const double scale = longer_px / 1000.0;
  std::size_t flown = 0;
  for (const StepRecord& r : record.steps) {
    if (r.index > growth.step || !r.planned) continue;
    const std::vector<View>& path = referee.paths()[flown++];
    for (std::size_t k = 1; k < path.size(); ++k)
      canvas.line(path[k - 1].position().head<2>(), path[k].position().head<2>(), 3 * scale, blue, 0.8);
  }
  for (const StepRecord& r : record.steps) {
    if (r.index > growth.step) continue;
    const Eigen::Vector2d spot = r.view.position().head<2>(), ahead = r.view.forward().head<2>();
    canvas.line(spot, spot + 20 * scale / canvas.px_per_m() * ahead, 2.4 * scale, ink, 0.9);
    canvas.dot(spot, (r.planned ? 4.5 : 8) * scale, r.planned ? blue : ink);
  }
  return canvas.picture();
}

// Four moments of the mission side by side.
Picture growth_strip(const Referee& referee, const MissionRecord& record) {
  constexpr int gap = 12;
  std::vector<Picture> parts;
  for (int k = 1; k <= 4; ++k) {
    std::uint64_t step = record.steps.front().index;  // the last until then
    for (const StepRecord& r : record.steps)
      if (r.elapsed_s <= record.steps.back().elapsed_s * k / 4) step = r.index;
    parts.push_back(
        from_above(*std::ranges::find(referee.growth(), step, &Referee::Growth::step), referee, record, 480));
  }
  Picture all(4 * parts[0].width() + 3 * gap, parts[0].height());
  for (int y = 0; y < all.height(); ++y)
    for (int x = 0; x < all.width(); ++x) all(y, x) = {255, 255, 255};
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (int y = 0; y < parts[k].height(); ++y)
      for (int x = 0; x < parts[k].width(); ++x)
        all(y, x + static_cast<int>(k) * (parts[k].width() + gap)) = parts[k](y, x);
  return all;
}

Picture seen_surface(const Input& input, const Referee& referee) {
  Canvas canvas(Box2(input.bounds.min().head<2>(), input.bounds.max().head<2>()), 1000);
  canvas.fill([](const Eigen::Vector2d&) { return Rgb{250, 250, 248}; });
  draw_seen(canvas, *referee.fused().truth(), input.bounds);
  return canvas.picture();
}

std::string path_csv(const Referee& referee) {
  std::string csv = "leg,x_m,y_m,z_m,yaw_rad\n";
  for (std::size_t leg = 0; leg < referee.paths().size(); ++leg)
    for (const View& v : referee.paths()[leg]) {
      const Eigen::Vector3d p = v.position(), f = v.forward();
      csv += concat(leg + 1, ',', p.x(), ',', p.y(), ',', p.z(), ',', std::atan2(f.y(), f.x()), '\n');
    }
  return csv;
}

}  // namespace

void add_flight(Page& page, const Input& input, const Referee& referee, const MissionRecord& record) {
  page.add("map.png", "The map from above",
           "White is free, dark occupied at some height, grey unknown; the way in blue, above furniture too, a dot for "
           "each view and the way it looks, black where it started.",
           from_above(referee.growth().back(), referee, record, 1000));
  page.add("growth.png", "How the map grew", "After a quarter, half, three quarters and all of the time.",
           growth_strip(referee, record));
  page.add("coverage.png", "Surface seen", "Grey surface was seen, red was not, though it can be.",
           seen_surface(input, referee));
  write_file(page.options.out / "path.csv", path_csv(referee));
}

std::string of_the_body(const Options& o, const MissionRecord& record) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const StepRecord& r : record.steps)
    if (const double c = r.metric("clearance_m"); c < least_m) least_m = c;
  const auto cm = [](double m) { return concat(short_number(std::round(100 * m)), " cm"); };
  return concat(
      "a ball of ", cm(o.body_radius_m),
      std::isfinite(least_m) ? concat("; the nearest surface was ", cm(least_m), " from it") : "; nothing was flown");
}

}  // namespace scene
