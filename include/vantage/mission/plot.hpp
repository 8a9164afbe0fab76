// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/mission/text.hpp>

// Line plots as SVG. Written by hand rather than by gnuplot, for a page needs what gnuplot's terminal does not give:
// colours that follow the reader's light or dark scheme, the page's own font, values under the pointer, no ids that
// collide when several plots share a page, and the same bytes everywhere.
namespace vantage {

/// One line: y over x, as many of each; NaN leaves a gap. `low` and `high`, if given, shade a band around it.
struct Curve {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> low = {}, high = {};
};

struct Plot {
  std::string title, x_label, y_label;
  std::vector<Curve> curves;
  bool from_zero = true;                ///< the y axis starts at 0 if nothing is negative
  double y_least_top = 0;               ///< the y axis reaches this at least, such as 1 for a share
  int width_px = 560, height_px = 300;  ///< 200 to 4000; 120 to 4000
};

/// The style of every plot: up to eight colours that the colour-blind can tell apart (Okabe and Ito), and black on
/// white or white on black as the reader prefers. Without variables, which only browsers know.
inline constexpr std::string_view plot_css =
    R"(.plot{font:12px system-ui,sans-serif}
.plot .c0{color:#0072b2}.plot .c1{color:#d55e00}.plot .c2{color:#009e73}.plot .c3{color:#cc79a7}
.plot .c4{color:#e69f00}.plot .c5{color:#56b4e9}.plot .c6{color:#8b6d2f}.plot .c7{color:#7f7f7f}
.plot text{fill:#6a737d}.plot .key{fill:#1d2329}.plot .title{fill:#1d2329;font-weight:600;font-size:14px}
.plot .grid{stroke:#d9dee3;stroke-width:1}.plot .axis{stroke:#6a737d;stroke-width:1}
.plot .curve{fill:none;stroke:currentColor;stroke-width:2;stroke-linejoin:round;stroke-linecap:round}
.plot .band{fill:currentColor;opacity:.16;stroke:none}.plot .dot{fill:currentColor;stroke:none}
@media (prefers-color-scheme:dark){
.plot .c0{color:#4ea8de}.plot .c1{color:#ff8c42}.plot .c2{color:#2ec4a0}.plot .c3{color:#e39cc6}
.plot text{fill:#98a2ad}.plot .key,.plot .title{fill:#e6e9ec}.plot .grid{stroke:#333b43}.plot .axis{stroke:#98a2ad}}
)";

namespace detail {

/// Round numbers that cover [low, high]: about `wanted` steps of 1, 2 or 5 times a power of ten.
struct Ticks {
  double low, high, step;
  Ticks(double from, double to, int wanted) {
    if (!(to - from > 1e-9 * std::max(std::abs(from), std::abs(to)))) {  // as good as a single value, or none at all
      if (!std::isfinite(from) || !std::isfinite(to))
        from = 0, to = 1;
      else {
        const double pad = from == 0 ? 1 : 0.1 * std::abs(from);
        from -= pad, to += pad;
      }
    }
    const double raw = (to - from) / wanted, power = std::pow(10, std::floor(std::log10(raw)));
    step = power * (raw <= 1.001 * power ? 1 : raw <= 2.001 * power ? 2 : raw <= 5.001 * power ? 5 : 10);
    low = std::floor(from / step + 1e-9) * step;
    high = std::ceil(to / step - 1e-9) * step;
  }
  [[nodiscard]] int count() const { return static_cast<int>(std::lround((high - low) / step)) + 1; }
  [[nodiscard]] double operator[](int i) const {
    const double v = low + i * step;
    return std::abs(v) < 1e-9 * step ? 0 : v;
  }
};

inline std::string px(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", x);
  return text;
}

}  // namespace detail

/// The plot as an <svg> element that takes its style from a page holding plot_css. Throws Error if a curve's lengths
/// differ, if a number is infinite, or if a size is out of range.
inline std::string svg_element(const Plot& plot) {
  Check check("Plot");
  check(plot.width_px >= 200 && plot.width_px <= 4000, "width_px", plot.width_px, "200 to 4000");
  check(plot.height_px >= 120 && plot.height_px <= 4000, "height_px", plot.height_px, "120 to 4000");
  check.finite("y_least_top", plot.y_least_top);
  double x0 = std::numeric_limits<double>::infinity(), x1 = -x0, y0 = x0, y1 = -x0;
  for (const Curve& c : plot.curves) {
    check(c.x.size() == c.y.size(), c.name + ".y", c.y.size(), concat(c.x.size(), " values"));
    check(c.low.size() == c.high.size() && (c.low.empty() || c.low.size() == c.x.size()), c.name + ".low, high",
          c.low.size(), concat("none or ", c.x.size(), " values each"));
    for (const std::vector<double>* values : {&c.x, &c.y, &c.low, &c.high})
      for (const double v : *values) {
        check(!std::isinf(v), c.name, v, "a finite number or NaN");
        if (!std::isfinite(v)) continue;
        (values == &c.x ? x0 : y0) = std::min(values == &c.x ? x0 : y0, v);
        (values == &c.x ? x1 : y1) = std::max(values == &c.x ? x1 : y1, v);
      }
  }
  check.done();
  if (plot.from_zero && y0 > 0 && std::isfinite(y0)) y0 = 0;
  y1 = std::max(y1, plot.y_least_top);
  const detail::Ticks ys(y0, y1, std::max(2, plot.height_px / 60)), xs(x0, x1, std::max(3, plot.width_px / 90));
  const double x_first = x1 > x0 ? x0 : xs.low, x_last = x1 > x0 ? x1 : xs.high;  // lines end at the frame's edge

  std::size_t widest = 0;
  for (int i = 0; i < ys.count(); ++i) widest = std::max(widest, short_number(ys[i]).size());
  const double left = 18 + 7 * static_cast<double>(widest), right = plot.width_px - 14,
               top = plot.curves.size() > 1 ? 54 : 36, bottom = plot.height_px - 40;
  const auto px_x = [&](double x) { return left + (x - x_first) / (x_last - x_first) * (right - left); };
  const auto px_y = [&](double y) { return bottom - (y - ys.low) / (ys.high - ys.low) * (bottom - top); };
  using detail::px;

  std::string s = concat("<svg class=\"plot\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 ", plot.width_px, " ",
                         plot.height_px, "\" role=\"img\" aria-label=\"", escaped(plot.title), "\">\n");
  s += concat("<text class=\"title\" x=\"0\" y=\"14\">", escaped(plot.title), "</text>");
  if (!plot.y_label.empty())
    s += concat("<text x=\"", px(plot.width_px), "\" y=\"14\" text-anchor=\"end\">", escaped(plot.y_label), "</text>");
  s += "\n";
  for (int i = 0; i < ys.count(); ++i) {
    const std::string y = px(px_y(ys[i]));
    s += concat("<line class=\"", i == 0 ? "axis" : "grid", "\" x1=\"", px(left), "\" x2=\"", px(right), "\" y1=\"", y,
                "\" y2=\"", y, "\"/>");
    s += concat("<text x=\"", px(left - 8), "\" y=\"", px(px_y(ys[i]) + 4), "\" text-anchor=\"end\">",
                short_number(ys[i]), "</text>\n");
  }
  for (int i = 0; i < xs.count(); ++i) {
    if (xs[i] < x_first - 1e-9 * xs.step || xs[i] > x_last + 1e-9 * xs.step) continue;
    s += concat("<text x=\"", px(px_x(xs[i])), "\" y=\"", px(bottom + 17), "\" text-anchor=\"middle\">",
                short_number(xs[i]), "</text>");
  }
  s += concat("\n<text x=\"", px(right), "\" y=\"", px(plot.height_px - 5), "\" text-anchor=\"end\">",
              escaped(plot.x_label), "</text>\n");

  double key = 0;
  for (std::size_t k = 0; k < plot.curves.size(); ++k) {
    const Curve& c = plot.curves[k];
    s += concat("<g class=\"c", k % 8, "\">");
    if (!c.low.empty()) {
      std::string there, back;
      for (std::size_t i = 0; i < c.x.size(); ++i)
        if (std::isfinite(c.x[i]) && std::isfinite(c.low[i]) && std::isfinite(c.high[i])) {
          there += concat(px(px_x(c.x[i])), ",", px(px_y(c.high[i])), " ");
          back = concat(px(px_x(c.x[i])), ",", px(px_y(c.low[i])), " ", back);
        }
      s += concat("<polygon class=\"band\" points=\"", there, back, "\"/>");
    }
    std::string path, dots;
    bool pen_down = false;
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      const bool known = std::isfinite(c.x[i]) && std::isfinite(c.y[i]);
      if (known) {
        const std::string x = px(px_x(c.x[i])), y = px(px_y(c.y[i]));
        path += concat((pen_down ? "L" : "M"), x, " ", y);
        dots += concat("<circle class=\"dot\" cx=\"", x, "\" cy=\"", y, "\" r=\"", (c.x.size() > 60 ? "1.5" : "2.6"),
                       "\"><title>", escaped(concat(c.name, ": ", short_number(c.y[i]), " at ", short_number(c.x[i]))),
                       "</title></circle>");
      }
      pen_down = known;
    }
    s += concat("<path class=\"curve\" d=\"", path, "\"/>", dots);
    if (plot.curves.size() > 1) {
      s += concat("<line class=\"curve\" x1=\"", px(key), "\" x2=\"", px(key + 16), "\" y1=\"31\" y2=\"31\"/>");
      s += concat("<text class=\"key\" x=\"", px(key + 22), "\" y=\"35\">", escaped(c.name), "</text>");
      key += 44 + 6.6 * static_cast<double>(c.name.size());
    }
    s += "</g>\n";
  }
  return s + "</svg>\n";
}

/// The plot as a file of its own.
inline std::string svg_document(const Plot& plot) {
  std::string s = svg_element(plot);
  s.insert(s.find('\n') + 1, "<style>" + std::string(plot_css) + "</style>\n");
  return s;
}

}  // namespace vantage
