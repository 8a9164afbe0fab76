// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <vantage/core/error.hpp>
#include <vantage/io/json.hpp>
#include <vantage/mission/plot.hpp>
#include <vantage/mission/record.hpp>
#include <vantage/mission/text.hpp>

// A mission as one page: no script, nothing fetched, light or dark as the reader prefers.
namespace vantage {

/// A figure that sums the mission up.
struct KeyFigure {
  std::string name, value, unit = {}, note = {};
};

/// What the colours of a picture mean, from low to high.
struct ColourScale {
  std::vector<std::array<std::uint8_t, 3>> colours = {};  ///< evenly spread
  double low = 0, high = 1;
  std::string unit = {};
};

struct ReportPicture {
  std::string title, caption;
  std::vector<std::byte> png;
  ColourScale scale = {};  ///< no colours: none shown
};

struct Report {
  std::string title;
  std::string lead = {};  ///< what was done, in a sentence or two
  std::vector<KeyFigure> figures = {};
  std::vector<ReportPicture> pictures = {};
  std::vector<Plot> plots = {};
  std::string command = {};  ///< what to type to get this page again
};

namespace detail {

inline constexpr std::string_view report_css =
    R"(:root{color-scheme:light dark;--paper:#fff;--card:#f6f7f9;--ink:#1d2329;--soft:#6a737d;--line:#d9dee3;--a:#0072b2;--b:#e69f00;--c:#009e73}
@media (prefers-color-scheme:dark){:root{--paper:#14181c;--card:#1c2228;--ink:#e6e9ec;--soft:#98a2ad;--line:#333b43;--a:#4ea8de;--b:#e6b34d;--c:#2ec4a0}}
*{box-sizing:border-box}body{margin:0;background:var(--paper);color:var(--ink);font:15px/1.55 system-ui,sans-serif}
main{max-width:1180px;margin:0 auto;padding:40px 24px 64px}h1{font-size:27px;line-height:1.2;margin:0 0 8px;font-weight:650;letter-spacing:-.01em}
h2{font-size:16px;margin:44px 0 14px;font-weight:650}p{margin:0 0 8px;max-width:75ch}.soft{color:var(--soft)}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(148px,1fr));gap:1px;margin:26px 0 0;background:var(--line);border:1px solid var(--line);border-radius:8px;overflow:hidden}
.figures div{background:var(--paper);padding:13px 16px}.figures b{display:block;font-size:23px;line-height:1.3;font-weight:600;font-variant-numeric:tabular-nums}
.figures b small{font-size:14px;font-weight:400;color:var(--soft)}.figures span{color:var(--soft);font-size:13px;display:block}
.pictures{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,320px),1fr));gap:28px 24px}
figure{margin:0}figure img{display:block;width:100%;border-radius:4px}figcaption{margin-top:9px;font-size:13px;color:var(--soft)}figcaption b{color:var(--ink);font-weight:600}
.scale{display:grid;grid-template-columns:auto 1fr auto;gap:8px;align-items:center;margin-top:8px;font-size:12px;color:var(--soft);font-variant-numeric:tabular-nums}.scale i{height:8px;border-radius:4px}
.plots{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,440px),1fr));gap:30px 34px}.plot{width:100%;height:auto;overflow:visible}
.bar{display:flex;height:14px;border-radius:7px;overflow:hidden;background:var(--line)}.bar i{display:block}.key{font-size:13px;color:var(--soft);margin-top:8px}.key i{display:inline-block;width:10px;height:10px;border-radius:3px;margin:0 6px 0 0}.key span{margin-right:22px;white-space:nowrap}
.p{background:var(--a)}.m{background:var(--b)}.f{background:var(--c)}
.wide{overflow-x:auto;border:1px solid var(--line);border-radius:8px}table{border-collapse:collapse;width:100%;font-size:13px;font-variant-numeric:tabular-nums}
th,td{padding:5px 10px;text-align:right;white-space:nowrap}th{font-weight:600;color:var(--soft);border-bottom:1px solid var(--line)}tr:nth-child(even) td{background:var(--card)}
.steps{max-height:560px;overflow:auto}.steps th{position:sticky;top:0;background:var(--paper)}
.config td,.config th{text-align:left}.config td{white-space:normal;overflow-wrap:anywhere}.config td:first-child{color:var(--soft);width:13em}pre{background:var(--card);padding:12px 16px;border-radius:8px;overflow-x:auto;font:13px/1.5 ui-monospace,monospace;margin:0 0 14px}
@media print{.steps{max-height:none}}
)";

inline std::string html_of(const KeyFigure& f) {
  return "<div><span>" + escaped(f.name) + "</span><b>" + escaped(f.value) +
         (f.unit.empty() ? "" : " <small>" + escaped(f.unit) + "</small>") + "</b>" +
         (f.note.empty() ? "" : "<span>" + escaped(f.note) + "</span>") + "</div>\n";
}

inline std::string html_of(const ReportPicture& p) {
  std::string s = "<figure><img alt=\"" + escaped(p.title) + "\" src=\"data:image/png;base64," + base64(p.png) + "\">";
  if (!p.scale.colours.empty()) {
    std::string stops;
    for (const auto& c : p.scale.colours)
      stops += concat(stops.empty() ? "" : ",", "rgb(", int{c[0]}, " ", int{c[1]}, " ", int{c[2]}, ")");
    s += "<div class=\"scale\"><span>" + short_number(p.scale.low) +
         "</span><i style=\"background:linear-gradient(90deg," + stops + ")\"></i><span>" +
         escaped(short_number(p.scale.high) + (p.scale.unit.empty() ? "" : " " + p.scale.unit)) + "</span></div>";
  }
  return s + "<figcaption><b>" + escaped(p.title) + ".</b> " + escaped(p.caption) + "</figcaption></figure>\n";
}

/// Where the mission's time went, as one bar.
inline std::string html_of_times(const MissionRecord& record) {
  double planning_s = 0, mapping_s = 0, action_s = 0;
  for (const StepRecord& r : record.steps) planning_s += r.planning_s, mapping_s += r.mapping_s, action_s += r.action_s;
  const double total_s = planning_s + mapping_s + action_s;
  if (!(total_s > 0)) return "";
  std::string bar, key;
  const auto add = [&](const char* name, const char* style, double s) {
    bar += concat("<i class=\"", style, "\" style=\"width:", px(100 * s / total_s), "%\"></i>");
    key += concat("<span><i class=\"", style, "\"></i>", name, " ", short_number(s), " s (",
                  short_number(std::round(1000 * s / total_s) / 10), " %)</span>");
  };
  add("planning", "p", planning_s);
  add("mapping", "m", mapping_s);
  add("travel", "f", action_s);
  return "<h2>Where the time went</h2>\n<div class=\"bar\">" + bar + "</div><div class=\"key\">" + key + "</div>\n";
}

inline std::string fixed(double x, int digits) {
  if (!std::isfinite(x)) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, x);
  return text;
}

inline std::string html_of_steps(const MissionRecord& record) {
  if (record.steps.empty()) return "";
  std::string s =
      "<h2>Steps</h2>\n<div class=\"wide steps\"><table><thead><tr><th>step<th>time [s]<th>position "
      "[m]<th>utility<th>candidates<th>planning [ms]<th>mapping [ms]<th>travel [s]";
  for (const Metric& m : record.steps.back().metrics) s += "<th>" + escaped(m.name);
  s += "</tr></thead><tbody>\n";
  for (const StepRecord& r : record.steps) {
    const Eigen::Vector3d p = r.view.position();
    s += concat("<tr><td>", r.index, "<td>", fixed(r.elapsed_s, 1), "<td>", fixed(p.x(), 2), ", ", fixed(p.y(), 2),
                ", ", fixed(p.z(), 2), "<td>", short_number(r.utility), "<td>",
                r.planned ? std::to_string(r.candidates) : "-", "<td>", fixed(1000 * r.planning_s, 1), "<td>",
                fixed(1000 * r.mapping_s, 1), "<td>", fixed(r.action_s, 1));
    for (const Metric& m : r.metrics) s += "<td>" + short_number(m.value);
    s += "\n";
  }
  return s + "</tbody></table></div>\n";
}

inline std::string html_of_config(const MissionRecord& record, const std::string& command) {
  std::string s = "<h2>How to get this again</h2>\n";
  if (!command.empty()) s += "<pre>" + escaped(command) + "</pre>\n";
  s += "<div class=\"wide\"><table class=\"config\"><tbody>\n";
  const auto row = [&](std::string_view key, const nlohmann::ordered_json& value) {
    s += "<tr><td>" + escaped(key) + "<td>" + escaped(value.is_string() ? value.get<std::string>() : json_text(value)) +
         "\n";
  };
  row("seed", record.seed);
  for (const auto& [key, value] : record.config.items()) row(key, value);
  const nlohmann::ordered_json libraries = versions();
  for (const auto& [key, value] : libraries.items()) row(key, value);
  return s + "</tbody></table></div>\n";
}

}  // namespace detail

/// The page, self-contained, as HTML 5. The same record gives the same bytes.
inline std::string report_html(const Report& report, const MissionRecord& record) {
  std::string s =
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width,initial-scale=1\"><title>" +
      escaped(report.title) + "</title>\n<style>" + std::string(detail::report_css) + std::string(plot_css) +
      "</style></head>\n<body><main>\n";
  s += "<h1>" + escaped(report.title) + "</h1>\n";
  if (!report.lead.empty()) s += "<p class=\"soft\">" + escaped(report.lead) + "</p>\n";
  if (!report.figures.empty()) {
    s += "<div class=\"figures\">\n";
    for (const KeyFigure& f : report.figures) s += detail::html_of(f);
    s += "</div>\n";
  }
  if (!report.pictures.empty()) {
    s += "<h2>The map</h2>\n<div class=\"pictures\">\n";
    for (const ReportPicture& p : report.pictures) s += detail::html_of(p);
    s += "</div>\n";
  }
  if (!report.plots.empty()) {
    s += "<h2>How it came about</h2>\n<div class=\"plots\">\n";
    for (const Plot& p : report.plots) s += "<div>" + svg_element(p) + "</div>\n";
    s += "</div>\n";
  }
  s += detail::html_of_times(record) + detail::html_of_steps(record) + detail::html_of_config(record, report.command);
  return s + "</main></body></html>\n";
}

/// The curves of one or several metrics over mission time, as far as they are finite.
inline Plot metric_plot(const MissionRecord& record, std::string title, std::string unit,
                        const std::vector<std::string>& metrics) {
  Plot plot{.title = std::move(title), .x_label = "mission time [s]", .y_label = std::move(unit), .curves = {}};
  for (const std::string& name : metrics) {
    Curve& c = plot.curves.emplace_back();
    c.name = name;
    for (const StepRecord& r : record.steps) {
      const double y = r.metric(name);
      c.x.push_back(r.elapsed_s);
      c.y.push_back(std::isfinite(y) ? y : std::numeric_limits<double>::quiet_NaN());
    }
  }
  return plot;
}

}  // namespace vantage
