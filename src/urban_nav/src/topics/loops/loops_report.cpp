// SPDX-License-Identifier: BSD-3-Clause
#include "topics/loops/loops_report.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "base/plot.hpp"
#include "map/session_odometry.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::MetricClosure;
using urban_nav_core::Trajectory;

namespace {

constexpr double kOpposite = 1.5707963267948966;  // rad: larger rotations are the opposite direction of travel

using Trajectories = std::map<std::string, Trajectory>;

bool isOpposite(const MetricClosure& closure) {
  return urban_nav_core::angleBetween(
             closure.measured.T_a_b,
             urban_nav_core::Pose(urban_nav_core::Quaterniond::Identity(), closure.measured.T_a_b.t())) > kOpposite;
}

/// Returns kind and direction of travel as text; empty without a transform.
std::string classify(const MetricClosure& closure) {
  if (closure.verdict != ClosureVerdict::Accepted) return {};
  return std::string(closure.method == ClosureMethod::Stereo ? "stereo" : "ICP") +
         (isOpposite(closure) ? ", opposite direction" : ", same direction");
}

std::optional<PlotPoint> findPlace(const Trajectories& trajectories, const urban_nav_core::PoseRef& at) {
  const auto trajectory = trajectories.find(at.session);
  if (trajectory == trajectories.end() || trajectory->second.empty()) return std::nullopt;
  const auto& t = trajectory->second[trajectory->second.nearest(at.stamp)].pose.t();
  return PlotPoint{t.x(), t.y()};
}

Trajectories byName(const std::vector<std::string>& names, const std::vector<Trajectory>& trajectories) {
  Trajectories made;
  for (std::size_t s = 0; s < names.size(); ++s) made[names[s]] = trajectories[s];
  return made;
}

void addPaths(Plot& plot, const Trajectories& trajectories, const std::string& name, const std::string& colour,
              Series::Kind kind) {
  Series path;
  path.kind = kind;
  path.name = name;
  path.colour = colour;
  const double gap = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [session, trajectory] : trajectories) {
    for (const auto& pose : trajectory) path.points.push_back({pose.pose.t().x(), pose.pose.t().y()});
    path.points.push_back({gap, gap});
  }
  plot.series.push_back(path);
}

Plot emptyMap() {
  Plot plot;
  plot.equal_axes = true;
  plot.height = 420;
  plot.x_label = "x, forward at the start (m)";
  plot.y_label = "y, left (m)";
  return plot;
}

/// Plots closures by kind: a dot at the later pose, a line to the earlier one.
Plot closuresPlot(const LoopsRun& run, const Trajectories& trajectories) {
  Plot plot = emptyMap();
  addPaths(plot, trajectories, "", "a", Series::Kind::Faint);
  const std::array<std::pair<const char*, const char*>, 5> kinds = {{{"stereo, same direction", "good"},
                                                                     {"stereo, opposite direction", "d"},
                                                                     {"ICP, same direction", "c"},
                                                                     {"ICP, opposite direction", "b"},
                                                                     {"", "bad"}}};
  const double gap = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [kind, colour] : kinds) {
    Series dots, lines;
    dots.kind = Series::Kind::Dots;
    lines.kind = Series::Kind::Faint;
    dots.name = *kind == '\0' ? "rejected" : kind;
    dots.colour = lines.colour = colour;
    for (const MetricClosure& closure : run.closures) {
      if (classify(closure) != kind) continue;
      const auto a = findPlace(trajectories, closure.a), b = findPlace(trajectories, closure.b);
      if (!a || !b) continue;
      dots.points.push_back(*b);
      if (*kind == '\0') continue;  // no line to a wrong place
      lines.points.insert(lines.points.end(), {*a, *b, {gap, gap}});
    }
    if (dots.points.empty()) continue;
    plot.series.push_back(lines);
    plot.series.push_back(dots);
  }
  return plot;
}

PageTable kindsTable(const LoopsRun& run) {
  std::map<std::string, int> counts;
  for (const MetricClosure& closure : run.closures)
    ++counts[closure.verdict == ClosureVerdict::Accepted ? classify(closure) : "rejected: " + closure.reason_name];
  PageTable table{"Results of the candidates",
                  {"", "candidates"},
                  {},
                  "Each candidate with its reason is listed below and in closures.csv."};
  for (const auto& [name, number] : counts) table.rows.push_back({name, std::to_string(number)});
  return table;
}

}  // namespace

Section loopsSection(const LoopsRun& run, const MapContext& context) {
  Section section{"loops",
                  "Loop closures",
                  "Candidates for revisited places, and the transform between them: from two views if they can be "
                  "registered, else from the laser points around both moments.",
                  {},
                  run.pictures,
                  {kindsTable(run)}};
  std::vector<Trajectory> in_map;
  for (const SessionTrajectory& session : context.trajectories) in_map.push_back(session.T_map_base);
  const Trajectories trajectories = byName(context.names, in_map);
  section.figures.push_back({"By kind and direction of travel", renderSvg(closuresPlot(run, trajectories)),
                             "A dot at the later pose of each candidate, a line to the earlier one.", true});
  if (!context.stereo_only.empty()) {
    Plot plot = emptyMap();
    addPaths(plot, byName(context.names, context.stereo_only), "stereo only", "c", Series::Kind::Dashed);
    addPaths(plot, trajectories, "stereo and ICP", "a", Series::Kind::Line);
    section.figures.push_back({"Without and with ICP", renderSvg(plot),
                               "Dashed: relaxed with the stereo closures only. Solid: with the ICP closures too.",
                               true});
  }
  return section;
}

std::vector<Verdict> loopsVerdicts(const LoopsRun& run) {
  if (run.candidates == 0) return {};
  const std::size_t accepted = run.accepted_stereo + run.accepted_icp;
  const std::string sentence = std::to_string(run.accepted_stereo) + " by stereo, " + std::to_string(run.accepted_icp) +
                               " by ICP, " + std::to_string(run.rejected) + " rejected; " +
                               urban_nav_core::formatNumber(run.ms_median, 3) + " ms each.";
  return {{accepted > 0 ? Grade::Good : Grade::Fair,
           std::to_string(accepted) + " of " + std::to_string(run.candidates) + " candidates have a transform.",
           sentence}};
}

Json toJson(const LoopsRun& run) {
  Json json = Json::object();
  json["candidates"] = run.candidates;
  json["accepted_stereo"] = run.accepted_stereo;
  json["accepted_icp"] = run.accepted_icp;
  json["rejected"] = run.rejected;
  json["ms_median"] = run.ms_median;
  json["ms_p99"] = run.ms_p99;
  json["ms_all"] = run.ms;
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : run.warnings) warnings.append(warning);
  return json;
}

}  // namespace urban_nav
