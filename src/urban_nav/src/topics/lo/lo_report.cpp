// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lo/lo_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/plot.hpp"
#include "map/motion_summary.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using urban_nav_core::formatNumber;
using urban_nav_core::Health;

namespace {

constexpr std::size_t kPointsDrawn = 12'000;  // more would slow down the page

double sinceStart(const LoRun& run, urban_nav_core::StampNs stamp) {
  return urban_nav_core::secondsBetween(run.frames.front().stamp, stamp);
}

Series makeSeries(const std::string& name, const std::string& colour, Series::Kind kind = Series::Kind::Line) {
  Series series;
  series.kind = kind;
  series.name = name;
  series.colour = colour;
  return series;
}

/// Returns the time intervals in which sweeps were not OK.
std::vector<Span> findTroubles(const LoRun& run) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const Health health = run.frames[i].status.health;
    if (health == Health::Ok) continue;
    const double from = sinceStart(run, run.frames[i].stamp);
    const double to = i + 1 < run.frames.size() ? sinceStart(run, run.frames[i + 1].stamp) : from;
    const std::string colour = health == Health::Lost ? "bad" : "fair";
    if (!spans.empty() && spans.back().colour == colour && std::abs(spans.back().to - from) < 1e-9)
      spans.back().to = to;
    else spans.push_back({from, to, colour});
  }
  return spans;
}

Figure mapFigure(const LoRun& run) {
  Plot plot;
  plot.x_label = "x, forward at the start (m)";
  plot.y_label = "y, left (m)";
  plot.equal_axes = true;
  plot.height = 460;
  Series surface = makeSeries("surfaces", "c", Series::Kind::Dots);
  const std::size_t step = run.surface.size() / kPointsDrawn + 1;
  for (std::size_t i = 0; i < run.surface.size(); i += step)
    surface.points.push_back({static_cast<double>(run.surface[i].x()), static_cast<double>(run.surface[i].y())});
  Series path = makeSeries("path", "a");
  for (const SmoothedFrame& pose : run.settled)
    path.points.push_back({pose.T_odom_base.pose.t().x(), pose.T_odom_base.pose.t().y()});
  // A short line along each free direction.
  Series free = makeSeries("free direction", "bad");
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    if (run.frames[i].status.health == Health::Lost) continue;
    const urban_nav_core::Pose& T = run.frames[i].T_odom_base;
    for (const urban_nav_core::Vector6d& direction : run.figures[i].free_directions) {
      const urban_nav_core::Vector3d d = T.R() * direction.head<3>();
      if (d.head<2>().norm() < 0.5) continue;
      for (const double end : {-1.0, 1.0}) free.points.push_back({T.t().x() + end * d.x(), T.t().y() + end * d.y()});
      free.points.push_back({kNan, kNan});
    }
  }
  plot.series = {surface, path, free};
  return {"Map from above", renderSvg(plot),
          "Planes of the local map along the path. Red lines: directions that the surroundings do not constrain.",
          true};
}

Figure sigmaFigure(const LoRun& run, int first, const std::string& title, const std::string& y_label, double unit) {
  static const std::array<const char*, 6> kNames = {"x", "y", "z", "roll", "pitch", "heading"};
  static const std::array<const char*, 3> kColours = {"a", "b", "c"};
  Plot plot;
  plot.x_label = "time (s)";
  plot.y_label = y_label;
  plot.y_from_zero = true;
  plot.spans = findTroubles(run);
  for (int i = 0; i < 3; ++i) {
    Series series = makeSeries(kNames[static_cast<std::size_t>(first + i)], kColours[static_cast<std::size_t>(i)]);
    for (const SmoothedFrame& pose : run.settled)
      series.points.push_back({sinceStart(run, pose.stamp),
                               unit * std::sqrt(std::max(0.0, pose.T_odom_base.covariance(first + i, first + i)))});
    plot.series.push_back(series);
  }
  return {title, renderSvg(plot), "One standard deviation, relative to the first pose. Shaded: the status was not OK.",
          false};
}

template <typename Value>
Series overSweeps(const LoRun& run, const std::string& name, const std::string& colour, Value value) {
  Series series = makeSeries(name, colour);
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    series.points.push_back({sinceStart(run, run.frames[i].stamp), value(run.figures[i])});
  return series;
}

Figure sweepFigure(const LoRun& run, const std::string& title, const std::string& y_label, std::vector<Series> series,
                   const std::string& caption) {
  Plot plot;
  plot.x_label = "time (s)";
  plot.y_label = y_label;
  plot.y_from_zero = true;
  plot.spans = findTroubles(run);
  plot.series = std::move(series);
  return {title, renderSvg(plot), caption, false};
}

std::string percentText(std::int64_t count, std::int64_t all) {
  return formatNumber(100.0 * static_cast<double>(count) / static_cast<double>(std::max<std::int64_t>(1, all)), 3) +
         " %";
}

}  // namespace

std::vector<Section> loSections(const LoRun& run) {
  if (run.frames.empty()) return {};
  Section path{"laser-path", "Path by laser odometry", "Poses of base_link, relative to the first.", {}, {}, {}};
  path.figures.push_back(mapFigure(run));
  path.figures.push_back(sigmaFigure(run, 0, "Uncertainty of the position", "one standard deviation (m)", 1.0));
  path.figures.push_back(
      sigmaFigure(run, 3, "Uncertainty of the orientation", "one standard deviation (deg)", 180.0 / M_PI));
  if (const std::optional<PageTable> motion = motionTable(run.motion)) path.tables.push_back(*motion);
  Section work{"laser-work", "Registration of the sweeps", "", {}, {}, {}};
  work.figures.push_back(
      sweepFigure(run, "Residuals", "mm",
                  {overSweeps(run, "", "d", [](const LoFigures& of) { return 1e3 * of.statistics.residual_m; })},
                  "Robust standard deviation of the distances between patches and planes."));
  work.figures.push_back(sweepFigure(
      run, "Returns", "returns",
      {overSweeps(run, "valid", "a", [](const LoFigures& of) { return static_cast<double>(of.statistics.points); }),
       overSweeps(run, "on matched surfaces", "c",
                  [](const LoFigures& of) { return static_cast<double>(of.statistics.used); }),
       overSweeps(run, "contradict the map", "bad",
                  [](const LoFigures& of) { return static_cast<double>(of.statistics.moving); })},
      "Returns that contradict the map are on things that move, or on edges."));
  work.figures.push_back(sweepFigure(
      run, "Free directions", "directions",
      {overSweeps(run, "", "bad", [](const LoFigures& of) { return static_cast<double>(of.free_directions.size()); })},
      "Directions of the motion that the surroundings do not constrain; six where a sweep is LOST."));
  work.figures.push_back(sweepFigure(run, "Time per sweep", "ms",
                                     {overSweeps(run, "", "a", [](const LoFigures& of) { return of.process_ms; })},
                                     "Processing time on one core."));
  return {path, work};
}

std::vector<Verdict> loVerdicts(const LoSummary& summary) {
  if (summary.sweeps == 0) return {};
  const std::int64_t lost = summary.status_counts.at("LOST");
  std::string reasons;
  for (const auto& [reason, count] : summary.reason_counts)
    reasons += (reasons.empty() ? " Reasons: " : ", ") + reason + " (" + std::to_string(count) + ")";
  if (!reasons.empty()) reasons += ".";
  if (lost > 0)
    return {
        {Grade::Bad, "Some sweeps could not be registered.",
         percentText(lost, summary.sweeps) + " of the sweeps are predicted only; their covariance grows." + reasons}};
  if (summary.degenerate > 0)
    return {{Grade::Fair, "The surroundings did not constrain all directions.",
             percentText(summary.degenerate, summary.sweeps) +
                 " of the sweeps do not constrain every direction of the motion." + reasons}};
  const std::int64_t degraded = summary.status_counts.at("DEGRADED");
  if (degraded > 0)
    return {{Grade::Fair, "Registration held, with few returns at times.",
             percentText(degraded, summary.sweeps) + " of the sweeps are DEGRADED." + reasons}};
  return {{Grade::Good, "All sweeps were registered.",
           std::to_string(summary.sweeps) + " sweeps with " + formatNumber(summary.points_mean, 4) +
               " returns on average, residuals of " + formatNumber(1e3 * summary.residual_mean, 3) + " mm." + reasons}};
}

}  // namespace urban_nav
