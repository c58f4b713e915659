// SPDX-License-Identifier: BSD-3-Clause
#include "topics/vo/vo_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/plot.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav {

using urban_nav_core::Health;

namespace {

constexpr std::size_t kBins = 40;
constexpr double kBriefLoss = 0.005;                               // share of the frames up to which a loss is brief
constexpr double kGap = std::numeric_limits<double>::quiet_NaN();  // ends a line

double toSeconds(const VoRun& run, urban_nav_core::StampNs stamp) {
  return urban_nav_core::secondsBetween(run.frames.front().stamp, stamp);
}

Series line(const std::string& name, const std::string& colour, std::vector<PlotPoint> points) {
  Series series;
  series.name = name;
  series.colour = colour;
  series.points = std::move(points);
  return series;
}

const char* toColour(Health health) {
  switch (health) {
    case Health::Ok: return "good";
    case Health::Degraded: return "fair";
    case Health::Lost: return "bad";
    case Health::Recovered: return "c";
  }
  return "plain";
}

/// Returns the time intervals in which the status was not OK.
std::vector<Span> troubles(const VoRun& run) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    if (run.frames[i].status.health == Health::Ok) continue;
    const double from = toSeconds(run, run.frames[i].stamp);
    const double to = i + 1 < run.frames.size() ? toSeconds(run, run.frames[i + 1].stamp) : from;
    const char* colour = toColour(run.frames[i].status.health);
    if (!spans.empty() && spans.back().colour == colour && std::abs(spans.back().to - from) < 1e-9) {
      spans.back().to = to;
    } else {
      spans.push_back({from, to, colour});
    }
  }
  return spans;
}

template <typename Value>
std::vector<PlotPoint> overTime(const VoRun& run, Value value) {
  std::vector<PlotPoint> points;
  for (std::size_t i = 0; i < run.frames.size(); ++i)
    points.push_back({toSeconds(run, run.frames[i].stamp), value(run.figures[i].statistics)});
  return points;
}

Figure pathFigure(const VoRun& run, int a, int b, const std::string& title, const std::string& x_label,
                  const std::string& y_label) {
  Plot plot;
  plot.x_label = x_label;
  plot.y_label = y_label;
  plot.equal_axes = true;
  plot.height = 400;
  std::vector<PlotPoint> settled;
  for (const SmoothedFrame& s : run.settled) settled.push_back({s.T_odom_base.pose.t()(a), s.T_odom_base.pose.t()(b)});
  plot.series.push_back(line("estimate", "a", settled));
  if (!settled.empty()) {
    Series ends = line("start", "good", {settled.front()});
    ends.kind = Series::Kind::Dots;
    plot.series.push_back(ends);
  }
  return {title, renderSvg(plot), "", false};
}

/// Plots the estimated standard deviations of three coordinates from index `first`.
Figure deviationFigure(const VoRun& run, int first, const std::string& title, const std::string& y_label, double unit) {
  static const std::array<const char*, 6> names = {"x", "y", "z", "roll", "pitch", "heading"};
  static const std::array<const char*, 3> colours = {"a", "b", "c"};
  Plot plot;
  plot.x_label = "time (s)";
  plot.y_label = y_label;
  plot.y_from_zero = true;
  plot.spans = troubles(run);
  for (int i = 0; i < 3; ++i) {
    std::vector<PlotPoint> points;
    for (const SmoothedFrame& s : run.settled)
      points.push_back(
          {toSeconds(run, s.stamp), unit * std::sqrt(std::max(0.0, s.T_odom_base.covariance(first + i, first + i)))});
    plot.series.push_back(
        line(names[static_cast<std::size_t>(first + i)], colours[static_cast<std::size_t>(i)], points));
  }
  return {title, renderSvg(plot), "Estimated, relative to the first pose. Shaded: the status was not OK.", false};
}

Figure featuresFigure(const VoRun& run) {
  Plot plot;
  plot.x_label = "time (s)";
  plot.y_label = "features";
  plot.y_from_zero = true;
  plot.spans = troubles(run);
  plot.series.push_back(line("in the frame", "a", overTime(run, [](const swf_vo::Statistics& of) {
                               return static_cast<double>(of.features);
                             })));
  plot.series.push_back(line("tracked and accepted", "c", overTime(run, [](const swf_vo::Statistics& of) {
                               return static_cast<double>(of.tracked);
                             })));
  return {"Features", renderSvg(plot), "Features that determine the motion. Shaded: the status was not OK.", false};
}

/// Plots the status of each frame as a stripe over time.
Figure statusFigure(const VoRun& run) {
  Plot plot;
  plot.x_label = "time (s)";
  plot.width = 1100;
  plot.height = 84;
  plot.spans = troubles(run);
  Series ok = line("", "good", {{0.0, 0.0}});
  for (const Span& trouble : plot.spans) {
    if (trouble.from - ok.points.back().x > 1e-9) ok.points.push_back({trouble.from, 0.0});
    else ok.points.pop_back();
    ok.points.insert(ok.points.end(), {{trouble.from, kGap}, {trouble.to, 0.0}});
  }
  ok.points.push_back({toSeconds(run, run.frames.back().stamp), 0.0});
  plot.series.push_back(ok);
  for (const Health health : {Health::Ok, Health::Degraded, Health::Lost, Health::Recovered}) {
    Series key = line(toString(health), toColour(health), {});
    key.kind = Series::Kind::Band;
    plot.series.push_back(key);
  }
  return {"Status", renderSvg(plot),
          "Degraded: too few features. Lost: the pose is predicted, and its covariance grows.", true};
}

Figure reprojectionFigure(const VoRun& run) {
  Plot plot;
  plot.x_label = "time (s)";
  plot.y_label = "px";
  plot.y_from_zero = true;
  plot.series.push_back(line("root mean square", "d", overTime(run, [](const swf_vo::Statistics& of) {
                               return of.tracked > 0 ? of.reprojection_px : kGap;
                             })));
  return {"Reprojection error", renderSvg(plot),
          "Distance between measured and predicted positions of the landmarks in the left image.", false};
}

Figure offsetFigure(const VoRun& run) {
  Plot plot;
  plot.x_label = "time (s)";
  plot.y_label = "px";
  Series band = line("one standard deviation", "c", {});
  band.kind = Series::Kind::Band;
  Series estimate = line("estimate", "b", {});
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const swf_vo::Statistics& of = run.figures[i].statistics;
    const double x = toSeconds(run, run.frames[i].stamp), px = of.disparity_offset_px;
    estimate.points.push_back({x, px});
    band.points.push_back({x, px + of.disparity_offset_sigma_px});
    band.lower.push_back(px - of.disparity_offset_sigma_px);
  }
  plot.series = {band, estimate};
  return {"Disparity offset", renderSvg(plot),
          "Constant error of the disparity due to calibration. With this camera 0.1 px is " +
              urban_nav_core::formatNumber(100.0 * 0.1 * 10.0 / (run.camera.left.fx * run.camera.baseline), 2) +
              " % of a distance of 10 m.",
          false};
}

Figure timingFigure(const VoRun& run, const VoSummary& summary) {
  std::vector<double> ms;
  for (const VoFigures& each : run.figures) ms.push_back(each.process_ms);
  const double top = std::max(1e-3, 1.1 * urban_nav_core::quantile(ms, 0.995));
  std::vector<double> counts(kBins, 0.0);
  for (const double value : ms) ++counts[std::min(kBins - 1, static_cast<std::size_t>(value / top * kBins))];
  Series bars = line("", "a", {});
  bars.kind = Series::Kind::Bars;
  bars.bar_width = top / kBins;
  for (std::size_t i = 0; i < kBins; ++i)
    bars.points.push_back({(static_cast<double>(i) + 0.5) * bars.bar_width, counts[i]});
  Plot plot;
  plot.x_label = "ms per frame (last bar: this or more)";
  plot.y_label = "frames";
  plot.y_from_zero = true;
  plot.series.push_back(bars);
  return {"Time in the filter", renderSvg(plot),
          "Median " + urban_nav_core::formatNumber(summary.ms_median) + " ms, 99th percentile " +
              urban_nav_core::formatNumber(summary.ms_p99) + " ms.",
          false};
}

}  // namespace

std::vector<Section> voSections(const VoRun& run, bool with_path) {
  if (run.frames.empty()) return {};
  const VoSummary summary = summarise(run);
  Section path{
      "path", with_path ? "Path" : "Uncertainty", "Smoothed poses of base_link, relative to the first.", {}, {}, {}};
  if (with_path)
    path.figures.push_back(pathFigure(run, 0, 1, "From above", "x, forward at the start (m)", "y, left (m)"));
  if (with_path)
    path.figures.push_back(pathFigure(run, 0, 2, "From the side", "x, forward at the start (m)", "z, up (m)"));
  path.figures.push_back(deviationFigure(run, 0, "Uncertainty of the position", "one standard deviation (m)", 1.0));
  path.figures.push_back(
      deviationFigure(run, 3, "Uncertainty of the orientation", "one standard deviation (deg)", 180.0 / M_PI));
  Section work{"work", "Tracking", "", {}, {}, {}};
  work.figures = {statusFigure(run), featuresFigure(run), reprojectionFigure(run), offsetFigure(run),
                  timingFigure(run, summary)};
  Section views{"views",
                "Images",
                "Left images; the line at a feature is its track over the previous frames. Red is near, blue is "
                "far, grey is rejected, a ring is new.",
                {},
                {},
                {}};
  for (const VoPicture& picture : run.pictures) {
    views.pictures.push_back({urban_nav_core::formatNumber(toSeconds(run, picture.stamp), 4) + " s, frame " +
                                  std::to_string(picture.frame) + ": " + picture.caption,
                              picture.jpeg, picture.width, picture.height});
  }
  return {path, work, views};
}

std::vector<Verdict> voVerdicts(const VoSummary& summary) {
  std::vector<Verdict> verdicts;
  const std::int64_t ok = summary.status_counts.at("OK"), lost = summary.status_counts.at("LOST"), all = summary.frames;
  const auto percent = [&](std::int64_t count) {
    return urban_nav_core::formatNumber(
               100.0 * static_cast<double>(count) / static_cast<double>(std::max<std::int64_t>(1, all)), 3) +
           " %";
  };
  std::string reasons;
  for (const auto& [reason, count] : summary.reason_counts)
    reasons += (reasons.empty() ? " Reasons: " : ", ") + reason + " (" + std::to_string(count) + ")";
  if (lost > 0) {
    const bool is_long = static_cast<double>(lost) > kBriefLoss * static_cast<double>(all);
    verdicts.push_back({is_long ? Grade::Bad : Grade::Fair,
                        is_long ? "Tracking was lost." : "Tracking was lost for a moment.",
                        percent(lost) + " of the frames are predicted only; their covariance grows." + reasons + "."});
  } else if (ok < all) {
    verdicts.push_back({Grade::Fair, "Tracking held, with few features at times.",
                        percent(all - ok) + " of the frames are not OK." + reasons + "."});
  } else {
    verdicts.push_back({Grade::Good, "Tracking held throughout.",
                        "All " + std::to_string(all) + " frames are OK, with " +
                            urban_nav_core::formatNumber(summary.features_mean) + " features on average."});
  }
  return verdicts;
}

}  // namespace urban_nav
