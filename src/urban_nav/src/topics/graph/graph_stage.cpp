// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/graph.hpp"

#include <algorithm>

#include "base/plot.hpp"
#include "laser_mapper/parameters.hpp"
#include "map/closure_notes.hpp"
#include "map/learnt_links.hpp"
#include "map/map_base.hpp"
#include "map/map_division.hpp"
#include "map/session_fixes.hpp"
#include "pose_graph/ground_views.hpp"
#include "pose_graph/stored_edits.hpp"
#include "topics/graph/graph_g2o.hpp"
#include "topics/graph/graph_report.hpp"
#include "topics/graph/graph_run.hpp"
#include "topics/graph/graph_store_export.hpp"
#include "topics/graph/graph_trajectories.hpp"
#include "topics/graph/plane_closures.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_store/merge.hpp"
#include "urban_nav_store/stored_fixes.hpp"

namespace urban_nav {

namespace {

constexpr double kDegreesPerRadian = 57.29577951308232;
constexpr double kLevelDeg = 5.0;  // largest standard deviation of a map reported as aligned

/// Removes the closures of earlier runs that this run finds again. Keeps those of a file and asserted ones.
void dropRecomputed(PreviousClosures& closures) {
  PreviousClosures others;
  for (std::size_t i = 0; i < closures.in_graph.size(); ++i) {
    if (urban_nav_store::isFoundAnew(closures.in_graph[i].kind, closures.in_graph[i].source)) continue;
    others.offered.push_back(closures.offered[i]);
    others.in_graph.push_back(closures.in_graph[i]);
  }
  closures = std::move(others);
}

/// Returns the stored closures between previous and continued sessions that this run does not find again.
PreviousClosures previousClosures(const MapContext& context) {
  const std::vector<urban_nav_store::SessionId> all = context.ids();
  std::vector<bool> has_closures(all.size());
  for (std::size_t s = 0; s < all.size(); ++s) has_closures[s] = context.isPrevious(s);
  for (std::size_t i = 0; i < context.sessions.size(); ++i)
    if (context.sessions[i].continued) has_closures[context.number(i)] = true;
  std::vector<urban_nav_store::SessionId> ids;
  std::vector<std::string> names;
  for (std::size_t s = 0; s < all.size(); ++s) {
    if (!has_closures[s]) continue;
    ids.push_back(all[s]);
    names.push_back(context.names[s]);
  }
  PreviousClosures closures = closuresBetween(*context.store, ids, names);
  if (context.joins) dropRecomputed(closures);
  return closures;
}

/// Returns whether stage loops accepted the closure by ICP.
bool isMeasuredByIcp(const urban_nav_core::MetricClosure& closure) {
  return isMeasured(closure) && closure.verdict == urban_nav_core::ClosureVerdict::Accepted &&
         closure.method == urban_nav_core::ClosureMethod::Icp;
}

/// Returns the stored ground normals of dense stereo, over all sessions.
SessionGrounds readGrounds(const MapContext& context) {
  SessionGrounds grounds;
  for (const urban_nav_store::SessionId& id : context.ids())
    grounds.push_back(pose_graph::readGround(*context.store, id));
  return grounds;
}

/// Returns the stored GPS fixes of all sessions.
SessionFixes readFixes(const MapContext& context) {
  SessionFixes fixes;
  for (const urban_nav_store::SessionId& id : context.ids())
    fixes.push_back(urban_nav_store::readFixes(*context.store, id));
  return fixes;
}

/// Returns whether places have to be recognised again, within these groups.
bool isDivided(const MapContext& context, const std::vector<std::size_t>& groups) {
  const std::vector<std::size_t> one(groups.size(), 0);
  return context.divides && groups != (context.groups.empty() ? one : context.groups);
}

/// Returns the verdicts of the last relaxation on the closures of a run, also before it is complete.
std::vector<ClosureAssessment> verdictsSoFar(const GraphRun& run) {
  std::vector<ClosureAssessment> verdicts = run.assessments;
  for (ClosureAssessment& each : verdicts)
    if (each.id > 0) each.verdict = run.graph.closures().at(each.id).verdict;
  return verdicts;
}

/// Returns whether no stage has to run again after this run, by its relaxation without planes.
bool isFinalRun(const MapContext& context, const GraphRun& run) {
  return !isDivided(context, dividedGroups(context, run.maps())) &&
         !linksToLearn(context, linksOfGraph(context, run.closures, verdictsSoFar(run)));
}

class GraphStage final : public Stage {
 public:
  Description describe() const override { return {"graph", "pose_graph", true, true, true, {"graph#.g2o"}}; }
  void addTables(ParameterSet& parameters) const override {
    parameters.add(pose_graph::table());
    parameters.add(urban_nav_registration::table());
    parameters.add(laser_mapper::table());
  }
  Selection select(const MapOptions& options) const override {
    if (!options.localise.empty()) return {false, "not with --localise", {}};
    if (!isRequested(options, "graph")) return {false, "not in --stages", {}};
    const bool measured = isRequested(options, "loops");  // which then describes them
    return {true, "", measured ? std::vector<std::string>() : closureNotes(options, false)};
  }

  std::unique_ptr<SessionPass> beginSession(MapContext& context, const SessionStart& start) override {
    if (usesGps(context)) storeFixes(context, start.session);
    return nullptr;
  }

  Messages run(MapContext& context) override {
    const pose_graph::Parameters& parameters = context.options.parameters.get(pose_graph::table());
    const std::vector<const SessionOdometry*> runs = context.runs();
    PreviousClosures previous = previousClosures(context);
    const PlaneFinder find_planes = makePlaneFinder(context);
    std::vector<urban_nav_core::MetricClosure> closures = context.closures;
    closures.insert(closures.end(), context.between_groups.begin(), context.between_groups.end());
    if (isRequested(context.options, "lasers")) previous.planes.clear();
    const SessionGrounds grounds = readGrounds(context);
    const SessionFixes fixes = usesGps(context) ? readFixes(context) : SessionFixes();
    const std::vector<pose_graph::Edit> edits = pose_graph::readEdits(*context.store, context.ids(), context.names);
    run_ = runGraph(parameters, runs, context.names, closures, previous, grounds, fixes, find_planes, edits);
    const std::vector<urban_nav_store::PlaceLink> links = linksOfGraph(context, run_->closures, verdictsSoFar(*run_));
    auto to_learn = linksToLearn(context, links);
    context.learns = to_learn.has_value();
    if (context.learns) {
      context.learnt = std::move(to_learn);
      return {{"graph: places are recognised again with what " + std::to_string(context.learnt->size()) +
               " accepted closures show"},
              {}};
    }
    const std::vector<std::size_t> groups = dividedGroups(context, run_->maps());
    context.is_divided = isDivided(context, groups);
    if (context.is_divided) {
      divideGroups(groups, run_->closures, run_->assessments, context);
      return {{"graph: " + std::to_string(sessionsOfGroups(context).size()) +
               " separate maps: places are recognised again within each"},
              {}};
    }
    storeLinks(*context.store, links);
    std::vector<urban_nav_core::MetricClosure> by_stereo = closures;
    by_stereo.erase(std::remove_if(by_stereo.begin(), by_stereo.end(), isMeasuredByIcp), by_stereo.end());
    if (by_stereo.size() < closures.size()) {
      previous.planes.clear();
      const GraphRun without_icp =
          runGraph(parameters, runs, context.names, by_stereo, previous, grounds, fixes, {}, edits);
      for (std::size_t s = 0; s < runs.size(); ++s) context.stereo_only.push_back(without_icp.trajectory(s));
    }
    exportGraph(*context.store, context.ids(), *run_, context.previous.revision);
    run_->numbers = readClosureNumbers(*context.store, context.ids(), *run_);
    forgetBase(*context.store);
    context.closures = run_->closures;
    context.assessments = run_->assessments;
    context.trajectories = relaxedTrajectories(*run_, std::move(context.trajectories));
    context.relaxed = true;
    return {describeRun(), run_->warnings};
  }

  StageResult result(const MapContext& context) const override {
    StageResult made;
    if (!run_) return made;
    if (run_->relaxed.accepted > 0) made.method = "relaxed";
    made.verdicts = graphVerdicts(*run_);
    if (!run_->closures.empty() || run_->sessions.size() > 1)  // else the section repeats that of odometry
      made.sections.push_back({report_place::kMap, graphSection(*run_, context.runs(), context.evaluations)});
    made.files.push_back({"graph.g2o", [this] { return graphG2o(*run_); }});
    for (std::size_t s = 1; s < context.names.size(); ++s) made.files.push_back({"graph" + fileSuffix(s) + ".g2o", {}});
    made.summary = toJson(*run_, context.evaluations);
    return made;
  }

 private:
  static bool usesGps(const MapContext& context) { return context.options.parameters.get(pose_graph::table()).gps; }

  /// Returns the function that finds constraints from planes in the scans; empty: no search.
  static PlaneFinder makePlaneFinder(MapContext& context) {
    const laser_mapper::Parameters& parameters = context.options.parameters.get(laser_mapper::table());
    if (!isRequested(context.options, "lasers") || !parameters.constraints) return {};
    const double half_length = context.options.parameters.get(urban_nav_registration::table()).cloud_half_length;
    std::optional<bool> is_final;  // decided once, or planes would be removed that earlier rounds added
    return [&parameters, &context, half_length, is_final](const GraphRun& run) mutable {
      if (!is_final) is_final = isFinalRun(context, run);
      if (!*is_final) return PlaneClosures();
      return findPlaneClosures(parameters, *context.store, context.ids(), run, half_length);
    };
  }

  static std::string describeLevel(const pose_graph::Level& level) {
    if (!level.known()) return "map not aligned with gravity: " + level.sentence;
    const std::string by = pose_graph::isFromGround(level) ? "the ground" : "gravity";
    const double sigma_deg = kDegreesPerRadian * level.sigma;
    const std::string sigma = urban_nav_core::formatNumber(sigma_deg, 2) + " deg";
    if (sigma_deg < kLevelDeg) return "map aligned with " + by + " (sigma " + sigma + ")";
    return "map aligned with " + by + " only to " + sigma + " (sigma)";
  }

  std::vector<std::string> describeRun() const {
    const pose_graph::Relaxed& relaxed = run_->relaxed;
    const VerdictCounts closures = run_->closureVerdicts(), planes = run_->planeVerdicts();
    const pose_graph::Level& level = run_->levels.front();
    const pose_graph::FixUse& fixes = run_->graph.fixUse();
    std::vector<std::string> lines = {"graph: " + std::to_string(relaxed.poses) + " poses, " +
                                          std::to_string(closures.all()) + " closures, " +
                                          std::to_string(closures.accepted) + " accepted; cost " +
                                          urban_nav_core::formatNumber(relaxed.cost_before, 5) + " -> " +
                                          urban_nav_core::formatNumber(relaxed.cost_after, 5) + " in " +
                                          urban_nav_core::formatNumber(run_->ms, 3) + " ms",
                                      describeLevel(level)};
    if (planes.all() + run_->planes.shared > 0)
      lines.push_back("planes of the lasers: " + std::to_string(planes.all()) + " constraints, " +
                      std::to_string(planes.accepted) + " accepted" +
                      (run_->planes.shared > 0 ? ", " + std::to_string(run_->planes.shared) +
                                                     " discounted since ICP closures use the same beams"
                                               : "") +
                      "; poses moved by up to " + urban_nav_core::formatNumber(run_->planes.moved, 3) + " m in " +
                      urban_nav_core::formatNumber(1e-3 * run_->planes.ms, 3) + " s");
    if (fixes.used > 0)
      lines.push_back("GPS: " + std::to_string(fixes.used) + " of " +
                      std::to_string(fixes.used + fixes.rejected + fixes.unplaced) +
                      " fixes used, poses moved by up to " + urban_nav_core::formatNumber(fixes.moved, 3) + " m");
    return lines;
  }

  std::optional<GraphRun> run_;
};

}  // namespace

std::unique_ptr<Stage> makeGraphStage() { return std::make_unique<GraphStage>(); }

}  // namespace urban_nav
