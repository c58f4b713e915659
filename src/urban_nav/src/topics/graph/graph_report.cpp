// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/graph_report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "base/plot.hpp"
#include "pose_graph/selection_warnings.hpp"
#include "topics/graph/closure_tables.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr double kOverconfident = 1.5;  // ratio of actual to stated standard deviation above which it is reported
constexpr std::array<const char*, 4> kColours = {"a", "c", "d", "b"};

std::string count(std::size_t n, const char* noun) { return std::to_string(n) + " " + noun + (n == 1 ? "" : "s"); }

std::vector<PlotPoint> seenFromAbove(const Trajectory& trajectory) {
  std::vector<PlotPoint> points;
  for (const auto& pose : trajectory) points.push_back({pose.pose.t().x(), pose.pose.t().y()});
  return points;
}

/// Returns lines between the poses of closures with this verdict.
Series makeLinks(const GraphRun& graph, urban_nav_core::ClosureVerdict verdict, const std::string& name,
                 const std::string& colour) {
  Series series;
  series.name = name;
  series.colour = colour;
  series.kind = Series::Kind::Faint;
  const double gap = std::numeric_limits<double>::quiet_NaN();
  std::map<std::string, Trajectory> trajectories;
  for (std::size_t s = 0; s < graph.sessions.size(); ++s) trajectories[graph.sessions[s]] = graph.trajectory(s);
  const auto place = [&](const pose_graph::NodeRef& ref) -> PlotPoint {
    const Trajectory& trajectory = trajectories.at(ref.session);
    const auto& t = trajectory[trajectory.nearest(ref.stamp)].pose.t();
    return {t.x(), t.y()};
  };
  for (const auto& [id, closure] : graph.graph.closures()) {
    if (closure.verdict != verdict || closure.kind == pose_graph::EdgeKind::Plane) continue;
    series.points.push_back(place(closure.a));
    series.points.push_back(place(closure.b));
    series.points.push_back({gap, gap});
  }
  return series;
}

Plot pathsPlot(const GraphRun& graph, const std::vector<const SessionOdometry*>& runs) {
  Plot plot;
  plot.equal_axes = true;
  plot.height = 420;
  plot.x_label = "x, forward at the start (m)";
  plot.y_label = "y, left (m)";
  // Drawn below the paths, since there may be a thousand.
  plot.series.push_back(makeLinks(graph, urban_nav_core::ClosureVerdict::Rejected, "rejected", "bad"));
  plot.series.push_back(makeLinks(graph, urban_nav_core::ClosureVerdict::Waiting, "waiting", "fair"));
  plot.series.push_back(makeLinks(graph, urban_nav_core::ClosureVerdict::Accepted, "closures", "good"));
  for (std::size_t s = 0; s < runs.size(); ++s) {
    Series before, after;
    before.kind = Series::Kind::Dashed;
    before.colour = after.colour = kColours[s % kColours.size()];
    const std::string name = runs.size() > 1 ? ", " + graph.sessions[s] : "";
    before.name = "odometry" + name;
    after.name = "relaxed" + name;
    before.points = seenFromAbove(smoothedTrajectory(*runs[s]));
    after.points = seenFromAbove(graph.trajectory(s));
    plot.series.push_back(before);
    plot.series.push_back(after);
  }
  return plot;
}

Plot costPlot(const GraphRun& graph) {
  Plot plot;
  plot.x_label = "iteration";
  plot.y_label = "log10 of the cost";
  Series series;
  series.points.push_back({0.0, std::log10(std::max(graph.relaxed.cost_before, 1e-12))});
  for (std::size_t i = 0; i < graph.relaxed.iterations.size(); ++i)
    series.points.push_back(
        {static_cast<double>(i + 1), std::log10(std::max(graph.relaxed.iterations[i].cost, 1e-12))});
  plot.series.push_back(series);
  return plot;
}

std::optional<PageTable> errorsTable(const GraphRun& graph, const std::vector<SessionEvaluations>& evaluations) {
  PageTable table{"Errors against the truth",
                  {"session", "length (m)", "odometry, first poses aligned (m)", "relaxed (m)", "odometry, aligned (m)",
                   "relaxed (m)", "NEES before", "after"},
                  {},
                  "Root mean squares over all poses; NEES is 6 for consistent covariances."};
  for (std::size_t s = 0; s < evaluations.size(); ++s) {
    const std::optional<Evaluation>&before = evaluations[s].odometry, &after = evaluations[s].map;
    if (!before || !after) continue;
    table.rows.push_back(
        {graph.sessions[s], urban_nav_core::formatNumber(after->length_m, 4),
         urban_nav_core::formatNumber(before->first.rmse, 3), urban_nav_core::formatNumber(after->first.rmse, 3),
         urban_nav_core::formatNumber(before->se3.rmse, 3), urban_nav_core::formatNumber(after->se3.rmse, 3),
         before->nees ? urban_nav_core::formatNumber(before->nees->mean, 3) : "",
         after->nees ? urban_nav_core::formatNumber(after->nees->mean, 3) : ""});
  }
  if (table.rows.empty()) return std::nullopt;
  return table;
}

constexpr double kGraphDegrees = 180.0 / 3.14159265358979323846;

/// Returns the tilt of the first pose, deg.
double tiltDeg(const pose_graph::Level& level) { return kGraphDegrees * std::acos(std::min(1.0, level.up.z())); }

constexpr double kSureLevelDeg = 0.5;  // largest standard deviation of a map reported as level

Verdict levelVerdict(const pose_graph::Level& level) {
  if (!level.known())
    return {Grade::Plain, "The map is not aligned with gravity.",
            "Its z axis is that of the first pose: " + level.sentence + "."};
  const bool is_sure = kGraphDegrees * level.sigma < kSureLevelDeg;
  return {is_sure ? Grade::Good : Grade::Fair,
          is_sure ? "The map is level." : "The map is level within its uncertainty.",
          "The first pose is tilted by " + urban_nav_core::formatNumber(tiltDeg(level), 2) +
              " deg (standard deviation " + urban_nav_core::formatNumber(kGraphDegrees * level.sigma, 2) +
              " deg), measured by " + (pose_graph::isFromGround(level) ? "the plane of the ground." : "gravity.")};
}

Json toJson(const pose_graph::Level& level) {
  Json json = Json::object();
  json["known"] = level.known();
  if (level.known()) {
    json["lean_deg"] = tiltDeg(level);
    json["sigma_deg"] = kGraphDegrees * level.sigma;
    json["source"] = pose_graph::isFromGround(level) ? "ground" : "accelerometer";
    json["gravity"] = level.gravity;
    Json& up = json["up"] = Json::array();
    for (int i = 0; i < 3; ++i) up.append(level.up(i));
  } else {
    json["reason"] = level.sentence;
  }
  return json;
}

Json sessionsJson(const GraphRun& graph, const std::vector<SessionEvaluations>& evaluations) {
  Json sessions = Json::array();
  for (std::size_t i = 0; i < graph.sessions.size(); ++i) {
    Json session = Json::object();
    session["name"] = graph.sessions[i];
    session["map"] = graph.sessions[graph.findMap(i)];
    const urban_nav_core::Trajectory trajectory = graph.trajectory(i);
    session["frames"] = trajectory.size();
    session["length_m"] = trajectory.length();
    const SessionEvaluations compared = i < evaluations.size() ? evaluations[i] : SessionEvaluations();
    if (compared.odometry && compared.map) {
      const Evaluation &before = *compared.odometry, &after = *compared.map;
      session["ate_m_odometry"] = before.first.rmse;
      session["ate_m"] = after.first.rmse;
      session["ate_se3_m_odometry"] = before.se3.rmse;
      session["ate_se3_m"] = after.se3.rmse;
      if (before.nees) session["nees_odometry"] = before.nees->mean;
      if (after.nees) session["nees"] = after.nees->mean;
    }
    sessions.append(session);
  }
  return sessions;
}

Json planesJson(const GraphRun& graph) {
  const VerdictCounts planes = graph.planeVerdicts();
  Json json = Json::object();
  json["constraints"] = planes.all();
  json["accepted"] = planes.accepted;
  json["shared_with_icp"] = graph.planes.shared;
  json["rounds"] = graph.planes.rounds;
  json["moved_m"] = graph.planes.moved;
  json["ms"] = graph.planes.ms;
  return json;
}

}  // namespace

Section graphSection(const GraphRun& graph, const std::vector<const SessionOdometry*>& runs,
                     const std::vector<SessionEvaluations>& evaluations) {
  Section section{
      "graph",
      "Relaxation",
      "Odometry, corrected by the closures at revisited places; closures that contradict the others are rejected.",
      {},
      {},
      {}};
  section.figures.push_back({"From above", renderSvg(pathsPlot(graph, runs)),
                             "Dashed: odometry only. Thin lines: closures, by verdict.", true});
  if (graph.relaxed.accepted > 0)
    section.figures.push_back({"Cost over iterations", renderSvg(costPlot(graph), false),
                               "Sum of weighted squared residuals, from the initial guess.", false});
  if (const auto errors = errorsTable(graph, evaluations)) section.tables.push_back(*errors);
  if (!graph.closures.empty())
    for (PageTable& table : closureTables(graph)) section.tables.push_back(std::move(table));
  return section;
}

std::vector<Verdict> graphVerdicts(const GraphRun& graph) {
  const pose_graph::Relaxed& relaxed = graph.relaxed;
  std::vector<Verdict> made;
  const VerdictCounts closures = graph.closureVerdicts();
  const std::string of = std::to_string(closures.accepted) + " of " + count(graph.closures.size(), "closure") +
                         " accepted, " + std::to_string(closures.rejected) + " rejected, " +
                         std::to_string(closures.waiting) + " waiting for confirmation by a second one";
  const VerdictCounts planes = graph.planeVerdicts();
  const std::string besides = planes.accepted > 0 ? " and the planes" : "";
  if (graph.closures.empty()) {
    made.push_back({Grade::Plain, "No closures.", "The map follows odometry" + besides + "."});
  } else if (closures.accepted == 0) {
    made.push_back({Grade::Fair, "No closure was accepted.", of + "; the map follows odometry" + besides + "."});
  } else {
    made.push_back({Grade::Good, "Relaxed over " + count(closures.accepted, "closure") + ".",
                    of + "; the cost fell from " + urban_nav_core::formatNumber(relaxed.cost_before, 4) + " to " +
                        urban_nav_core::formatNumber(relaxed.cost_after, 4) + "."});
  }
  for (const std::string& warning :
       pose_graph::selectionWarnings(relaxed.selection, relaxed.rejected, relaxed.closures))
    made.push_back({Grade::Fair, "The selection of closures is uncertain:", warning + "."});
  for (const pose_graph::Relaxed::Slip& slip : relaxed.slips)
    made.push_back({Grade::Fair, "A step of odometry is rejected:", toSentence(slip) + "."});
  if (planes.all() > 0)
    made.push_back({planes.accepted > 0 ? Grade::Good : Grade::Fair,
                    planes.accepted > 0 ? "Planes measured by several passes constrain the map."
                                        : "No plane measured by several passes is consistent with the map.",
                    std::to_string(planes.accepted) + " of " + count(planes.all(), "constraint") +
                        " accepted; they moved poses by up to " + urban_nav_core::formatNumber(graph.planes.moved, 3) +
                        " m."});
  const double deviation_ratio = std::sqrt(graph.graph.odometryVariance());
  if (deviation_ratio > kOverconfident)
    made.push_back({Grade::Fair,
                    "Odometry errors are " + urban_nav_core::formatNumber(deviation_ratio, 2) +
                        " times their standard deviations,",
                    std::string("as estimated from the ") + (closures.accepted > 0 ? "closures" : "planes") +
                        "; the covariances of this map are scaled accordingly."});
  made.push_back(levelVerdict(graph.levels.front()));
  if (const double lean = kGraphDegrees * graph.graph.odometryLean(); lean > 0.0)
    made.push_back({Grade::Good, "Roll and pitch are corrected by the accelerometer.",
                    "The tilt drift of odometry was up to " + urban_nav_core::formatNumber(lean, 2) + " deg."});
  const std::size_t joined = graph.sessionsJoined();
  if (graph.sessions.size() > 1)
    made.push_back(
        {joined == graph.sessions.size() ? Grade::Good : Grade::Fair,
         joined == graph.sessions.size()
             ? "All sessions are in one map."
             : std::to_string(graph.sessions.size() - joined) + " sessions are separate maps.",
         std::to_string(joined) + " of " + std::to_string(graph.sessions.size()) + " sessions share one frame."});
  return made;
}

Json toJson(const GraphRun& graph, const std::vector<SessionEvaluations>& evaluations) {
  const pose_graph::Relaxed& relaxed = graph.relaxed;
  const std::size_t joined = graph.sessionsJoined();
  Json json = Json::object();
  json["poses"] = relaxed.poses;
  json["edges"] = relaxed.edges;
  json["edges_rejected"] = relaxed.rejected + relaxed.waiting;
  const VerdictCounts closures = graph.closureVerdicts();
  json["closures"] = closures.all();
  json["closures_accepted"] = closures.accepted;
  json["closures_waiting"] = closures.waiting;
  json["cost_before"] = relaxed.cost_before;
  json["cost_after"] = relaxed.cost_after;
  json["odometry_variance"] = graph.graph.odometryVariance();
  json["odometry_lean_deg"] = kGraphDegrees * graph.graph.odometryLean();
  json["iterations"] = relaxed.iterations.size();
  json["ending"] = toString(relaxed.ending);
  Json& selection = json["selection"] = Json::object();
  selection["undecided"] = relaxed.selection.undecided;
  selection["rival"] = relaxed.selection.has_rival;
  selection["unweighed"] = relaxed.selection.unweighed;
  selection["odometry_factor"] = relaxed.selection.odometry_factor;
  selection["closure_factor"] = relaxed.selection.closure_factor;
  selection["steps_slipped"] = relaxed.slips.size();
  json["ms_batch"] = graph.ms;
  json["ms_covariances"] = graph.ms_covariances;
  json["sessions"] = graph.sessions.size();
  json["sessions_joined"] = joined;
  json["level"] = toJson(graph.levels.front());
  const pose_graph::FixUse& fixes = graph.graph.fixUse();
  if (fixes.used + fixes.rejected + fixes.unplaced > 0) {
    Json& gps = json["gps"] = Json::object();
    gps["fixes_used"] = fixes.used;
    gps["fixes_rejected"] = fixes.rejected;
    gps["fixes_unplaced"] = fixes.unplaced;
    gps["sigma_factor"] = fixes.sigma_factor;
    gps["moved_m"] = fixes.moved;
  }
  if (graph.planes.searched) json["planes"] = planesJson(graph);
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : graph.warnings) warnings.append(warning);
  json["per_session"] = sessionsJson(graph, evaluations);
  for (const SessionEvaluations& compared : evaluations) {
    if (!compared.odometry || !compared.map) continue;
    json["ate_m_odometry"] = compared.odometry->first.rmse;
    json["ate_se3_m_odometry"] = compared.odometry->se3.rmse;
    break;
  }
  return json;
}

}  // namespace urban_nav
