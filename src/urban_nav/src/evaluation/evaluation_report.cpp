// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation_report.hpp"
#include "urban_nav_core/io/format_number.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

namespace {

constexpr double kDegrees = 180.0 / M_PI;
constexpr double kExpectedNees = 6.0;
constexpr double kTooLarge = 0.2, kTooSmall = 2.0, kFarTooSmall = 5.0;  // measured over expected NEES

Grade gradeOfNees(double nees) {
  const double ratio = nees / kExpectedNees;
  if (ratio > kFarTooSmall) return Grade::Bad;
  return ratio > kTooSmall || ratio < kTooLarge ? Grade::Fair : Grade::Good;
}

/// Returns poses relative to the first one, in its axes.
std::vector<Pose> fromFirst(const std::vector<Pose>& poses) {
  std::vector<Pose> relative;
  relative.reserve(poses.size());
  for (const Pose& pose : poses) relative.push_back(poses.front().inverse() * pose);
  return relative;
}

std::vector<double> distances(const std::vector<Pose>& poses) {
  std::vector<double> way;
  for (std::size_t i = 0; i < poses.size(); ++i)
    way.push_back(i == 0 ? 0.0 : way.back() + urban_nav_core::distanceBetween(poses[i - 1], poses[i]));
  return way;
}

Series line(const std::string& name, const std::string& colour, Series::Kind kind, std::vector<PlotPoint> points) {
  Series series;
  series.kind = kind;
  series.name = name;
  series.colour = colour;
  series.points = std::move(points);
  return series;
}

std::vector<PlotPoint> projected(const std::vector<Pose>& poses, int a, int b) {
  std::vector<PlotPoint> points;
  points.reserve(poses.size());
  for (const Pose& pose : poses) points.push_back({pose.t()(a), pose.t()(b)});
  return points;
}

std::string percentText(const urban_nav_core::RelativeError& error) {
  return urban_nav_core::formatNumber(error.percent, 3) + " %, " + urban_nav_core::formatNumber(error.deg_per_m, 3) +
         " deg/m";
}

/// Unit of a length.
struct Length {
  const char* name;
  double per_m;
};
Length lengthFor(double m) { return m < 0.01 ? Length{"mm", 1000.0} : Length{"m", 1.0}; }

std::string lengthText(double m) {
  const Length unit = lengthFor(m);
  return urban_nav_core::formatNumber(unit.per_m * m, 2) + " " + unit.name;
}

/// Returns rows of name and value.
std::vector<std::vector<std::string>> formatFigures(const Evaluation& e) {
  std::vector<std::vector<std::string>> rows;
  rows.push_back({"poses", std::to_string(e.matched.truth.size()) + " matched, " + std::to_string(e.frames_estimate) +
                               " estimated, " + std::to_string(e.frames_truth) + " true"});
  rows.push_back({"length of the true path", urban_nav_core::formatNumber(e.length_m, 5) + " m"});
  if (e.offset)
    rows.push_back({e.offset_applied ? "offset that was applied to the stamps" : "offset of the stamps that would help",
                    urban_nav_core::formatNumber(1e-9 * static_cast<double>(e.offset->offset), 6) + " s"});
  const auto absolute = [&](const char* name, const urban_nav_core::ErrorStatistics& s) {
    const Length unit = lengthFor(s.rmse);
    rows.push_back({name, urban_nav_core::formatNumber(unit.per_m * s.rmse, 4) + " " + unit.name + " (median " +
                              urban_nav_core::formatNumber(unit.per_m * s.median, 3) + ", largest " +
                              urban_nav_core::formatNumber(unit.per_m * s.max, 3) + ")"});
  };
  absolute("absolute error, first poses aligned", e.first);
  absolute("absolute error, after a rigid motion", e.se3);
  absolute("absolute error, after a similarity", e.sim3);
  if (e.ten_frames)
    rows.push_back({"relative error over 10 frames", percentText(*e.ten_frames) + ", step ratio " +
                                                         urban_nav_core::formatNumber(e.ten_frames->step_ratio, 5)});
  for (const SpanError& span : e.spans)
    rows.push_back({"relative error over " + printSpan(span.span),
                    percentText(span.error) + " (" + std::to_string(span.error.count) + " spans)"});
  if (e.nees)
    rows.push_back({"NEES, 6 degrees of freedom",
                    urban_nav_core::formatNumber(e.nees->mean, 3) + " (translation " +
                        urban_nav_core::formatNumber(e.nees->mean_translation, 3) + " of 3, rotation " +
                        urban_nav_core::formatNumber(e.nees->mean_rotation, 3) + " of 3)"});
  rows.push_back({"at the end", urban_nav_core::formatNumber(e.end.m, 3) + " m, " +
                                    urban_nav_core::formatNumber(e.end.deg, 3) + " deg" +
                                    (e.end.nees ? ", NEES " + urban_nav_core::formatNumber(*e.end.nees, 3) : "")});
  return rows;
}

}  // namespace

Plot pathPlot(const Evaluation& evaluation, int a, int b) {
  static const std::array<const char*, 3> names = {"x, forward at the start (m)", "y, left (m)", "z, up (m)"};
  Plot plot;
  plot.equal_axes = true;
  plot.height = 400;
  plot.x_label = names[static_cast<std::size_t>(a)];
  plot.y_label = names[static_cast<std::size_t>(b)];
  plot.series.push_back(
      line("estimate", "a", Series::Kind::Line, projected(fromFirst(evaluation.matched.estimate), a, b)));
  plot.series.push_back(line("truth", "b", Series::Kind::Dashed, projected(fromFirst(evaluation.matched.truth), a, b)));
  return plot;
}

Plot errorPlot(const Evaluation& evaluation) {
  const std::vector<double> way = distances(evaluation.matched.truth);
  const std::vector<double> errors = urban_nav_core::absoluteErrors(
      evaluation.matched.truth, evaluation.matched.estimate, urban_nav_core::TrajectoryAlignment::First);
  std::vector<PlotPoint> points, percent;
  for (std::size_t i = 0; i < way.size(); ++i) {
    points.push_back({way[i], errors[i]});
    percent.push_back({way[i], 0.01 * way[i]});
  }
  Plot plot;
  plot.x_label = "distance travelled (m)";
  plot.y_label = "position error (m)";
  plot.width = 1100;
  plot.y_from_zero = true;
  plot.series.push_back(line("error, first poses aligned", "a", Series::Kind::Line, points));
  if (!way.empty() && way.back() > 1.0)
    plot.series.push_back(line("1 % of distance", "plain", Series::Kind::Dashed, percent));
  return plot;
}

Plot trustPlot(const Evaluation& evaluation, int coordinate) {
  static const std::array<const char*, 6> names = {"x (m)",         "y (m)",         "z (m)",
                                                   "about x (deg)", "about y (deg)", "about z (deg)"};
  const std::vector<double> way = distances(evaluation.matched.truth);
  const std::vector<Pose> truth = fromFirst(evaluation.matched.truth),
                          estimate = fromFirst(evaluation.matched.estimate);
  const double unit = coordinate < 3 ? 1.0 : kDegrees;
  Series band = line("3 standard deviations", "c", Series::Kind::Band, {});
  std::vector<PlotPoint> errors;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Vector6d error = urban_nav_core::boxMinus(truth[i], estimate[i]);
    errors.push_back({way[i], unit * error(coordinate)});
    if (evaluation.covariances.empty()) continue;
    const double three_sigma = 3.0 * unit * std::sqrt(std::max(0.0, evaluation.covariances[i](coordinate, coordinate)));
    band.points.push_back({way[i], three_sigma});
    band.lower.push_back(-three_sigma);
  }
  Plot plot;
  plot.height = 240;
  plot.x_label = "distance travelled (m)";
  plot.y_label = names[static_cast<std::size_t>(coordinate)];
  if (!band.points.empty()) plot.series.push_back(band);
  plot.series.push_back(line("error", "b", Series::Kind::Line, errors));
  return plot;
}

Section evaluationSection(const Evaluation& evaluation) {
  Section section{
      "truth", "Against the truth", "Truth: " + evaluation.truth + ". It is not used by the estimate.", {}, {}, {}};
  section.figures.push_back(
      {"From above", renderSvg(pathPlot(evaluation, 0, 1)), "Aligned at the first pose only.", false});
  section.figures.push_back({"From the side", renderSvg(pathPlot(evaluation, 0, 2)), "", false});
  section.figures.push_back({"Error over distance", renderSvg(errorPlot(evaluation)), "", true});
  static const std::array<const char*, 6> titles = {"Error along x", "Error along y",  "Error along z",
                                                    "Error of roll", "Error of pitch", "Error of heading"};
  for (int i = 0; i < 6; ++i) {
    section.figures.push_back({titles[static_cast<std::size_t>(i)], renderSvg(trustPlot(evaluation, i)),
                               evaluation.covariances.empty()
                                   ? ""
                                   : "A consistent estimate keeps the error within the band 99.7 % of the time.",
                               false});
  }
  section.tables.push_back({"Figures",
                            {"what", "value"},
                            formatFigures(evaluation),
                            "Relative errors: of the motion over a span, in per cent and degrees of its true length. "
                            "NEES: 6 for a consistent covariance, larger if it is too small."});
  return section;
}

std::vector<Verdict> evaluationVerdicts(const Evaluation& e) {
  std::vector<Verdict> verdicts;
  if (e.ten_frames) {
    const Grade grade = e.ten_frames->percent < 1.0   ? Grade::Good
                        : e.ten_frames->percent < 3.0 ? Grade::Fair
                                                      : Grade::Bad;
    verdicts.push_back({grade, "Drift of " + urban_nav_core::formatNumber(e.ten_frames->percent, 2) + " % of distance",
                        "and " + urban_nav_core::formatNumber(e.ten_frames->deg_per_m, 2) +
                            " deg per metre, over spans of ten frames. Over " +
                            urban_nav_core::formatNumber(e.length_m, 3) + " m the position error is at most " +
                            lengthText(e.first.max) + "."});
  } else {
    const Grade grade = e.first.rmse < 0.01 ? Grade::Good : e.first.rmse < 0.1 ? Grade::Fair : Grade::Bad;
    verdicts.push_back(
        {grade, "Position error of " + lengthText(e.first.rmse) + " at standstill,", "root mean square."});
  }
  if (e.nees) {
    const double ratio = e.nees->mean / kExpectedNees;
    const Grade grade = gradeOfNees(e.nees->mean);
    if (ratio > kTooSmall) {
      verdicts.push_back({grade, "The covariance is too small.",
                          "Errors are " + urban_nav_core::formatNumber(std::sqrt(ratio), 2) +
                              " times their standard deviations (NEES " +
                              urban_nav_core::formatNumber(e.nees->mean, 3) + ", expected 6)."});
    } else if (ratio < kTooLarge) {
      verdicts.push_back({grade, "The covariance is too large.",
                          "Errors are " + urban_nav_core::formatNumber(std::sqrt(ratio), 2) +
                              " times their standard deviations (NEES " +
                              urban_nav_core::formatNumber(e.nees->mean, 3) + ", expected 6)."});
    } else {
      verdicts.push_back(
          {grade, "The covariance is consistent.",
           "NEES " + urban_nav_core::formatNumber(e.nees->mean, 3) +
               ", expected 6; errors along one path are correlated, so a factor of two is not significant."});
    }
  }
  if (e.offset && !e.offset_applied) {
    verdicts.push_back({Grade::Fair, "Few stamps match those of the truth.",
                        "Only " + std::to_string(e.matched.truth.size()) + " poses; with " +
                            urban_nav_core::formatNumber(1e-9 * static_cast<double>(e.offset->offset), 6) +
                            " s added to the stamps of the estimate " + std::to_string(e.offset->matched) +
                            " match (evaluate --find-offset)."});
  }
  return verdicts;
}

std::vector<Tile> evaluationTiles(const Evaluation& e) {
  const Length unit = lengthFor(e.first.rmse);
  std::vector<Tile> tiles = {{urban_nav_core::formatNumber(unit.per_m * e.first.rmse, 3), unit.name,
                              "absolute error (root mean square)", Grade::Plain}};
  if (e.ten_frames)
    tiles.push_back({urban_nav_core::formatNumber(e.ten_frames->percent, 3), "%", "relative error over ten frames",
                     e.ten_frames->percent < 1.0 ? Grade::Good : Grade::Fair});
  if (e.nees)
    tiles.push_back(
        {urban_nav_core::formatNumber(e.nees->mean, 3), "", "NEES (expected 6)", gradeOfNees(e.nees->mean)});
  return tiles;
}

std::string evaluationText(const Evaluation& evaluation) {
  std::string text;
  for (const std::vector<std::string>& row : formatFigures(evaluation))
    text += row[0] + std::string(row[0].size() < 44 ? 44 - row[0].size() : 1, ' ') + row[1] + "\n";
  return text;
}

}  // namespace urban_nav
