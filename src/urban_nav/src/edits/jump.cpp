// SPDX-License-Identifier: BSD-3-Clause
#include "edits/jump.hpp"

#include <algorithm>
#include <map>

#include "edits/moments.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/stored_edits.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav {

using pose_graph::EdgeKind;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::Pose;

namespace {

constexpr double kJumpDegrees = 57.29577951308232;
constexpr std::size_t kMostTried = 300;  // relaxations without one edge, some ms each in a map of 10 000 poses
constexpr std::size_t kShownCauses = 20;

/// A relaxed graph that can be relaxed again without some of its edges.
class Trial {
 public:
  Trial(const GraphRun& run, int pose) : problem_(run.graph.problem()), weights_(run.graph.weights()), pose_(pose) {
    std::size_t number = 0;
    for (const pose_graph::Track& track : run.graph.tracks())
      for (const Pose& each : track.map) problem_.poses[number++] = pose_graph::toRigid<3>(each);
    options_.start = pose_graph::Start::Vertices;
    options_.iterations = 50;
    options_.untangle = false;
    components_ = pose_graph::solve(problem_, options_, weights_).components;
  }

  /// Sets the displacement of the pose without these edges.
  void without(const std::vector<std::size_t>& edges, JumpExplanation::Cause& cause) const {
    std::vector<double> weights = weights_;
    for (const std::size_t edge : edges) weights[edge] = 0.0;
    const pose_graph::Solution<3> solution = pose_graph::solve(problem_, options_, weights);
    const auto at = static_cast<std::size_t>(pose_);
    const Pose before = pose_graph::toPose(problem_.poses[at]), after = pose_graph::toPose(solution.poses[at]);
    cause.joins = solution.components > components_;
    cause.distance = distanceBetween(before, after);
    cause.angle = angleBetween(before, after);
  }

  double residual(std::size_t edge) const {
    pose_graph::Problem<3> alone = problem_.withoutEdges();
    alone.edges = {problem_.edges[edge]};
    return pose_graph::cost(alone, problem_.poses, pose_graph::Objective::Geodesic);
  }
  std::size_t chains(std::size_t closures) const { return problem_.edges.size() - closures; }

 private:
  pose_graph::Problem<3> problem_;
  std::vector<double> weights_;
  pose_graph::SolveOptions options_;
  int pose_;
  int components_ = 0;
};

std::string placeText(double distance, double angle) {
  return urban_nav_core::formatNumber(distance, 3) + " m and " + urban_nav_core::formatNumber(kJumpDegrees * angle, 3) +
         " deg";
}

std::string causeText(const JumpExplanation::Cause& cause) {
  return cause.text + ": " +
         (cause.joins ? "without it this pose or a part of the map is in another map"
                      : "without it this pose is " + placeText(cause.distance, cause.angle) + " away");
}

/// Compares the pose with odometry from the first pose of the map.
void compareWithOdometry(const GraphRun& run, std::size_t session, const urban_nav_store::NodeRef& at,
                         JumpExplanation& jump) {
  const pose_graph::Track& track = *run.graph.track(run.sessions[session]);
  jump.in_own_map = run.findMap(session) == session;
  const auto place = static_cast<std::size_t>(std::lower_bound(track.stamps.begin(), track.stamps.end(), at.stamp) -
                                              track.stamps.begin());
  const Pose T_odom = track.odom.front().inverse() * track.odom[place],
             T_map = track.map.front().inverse() * track.map[place];
  jump.distance = distanceBetween(T_odom, T_map);
  jump.angle = angleBetween(T_odom, T_map);
}

}  // namespace

JumpExplanation explainJump(urban_nav_store::Store& store, const std::string& moment) {
  const StoredMeasurements measurements = readMeasurements(store);
  const PreviousSessions& sessions = measurements.sessions;
  const urban_nav_store::NodeRef at = findMoment(sessions, moment, "--jump");
  const GraphRun run = relaxEdited(measurements, pose_graph::readEdits(store, sessions.ids, sessions.names));
  const auto session =
      static_cast<std::size_t>(std::find(sessions.ids.begin(), sessions.ids.end(), at.session) - sessions.ids.begin());
  JumpExplanation jump;
  jump.moment = momentText(sessions, at);
  const std::optional<int> pose = run.graph.poseNumber({sessions.names[session], at.stamp});
  if (!pose) return jump;
  compareWithOdometry(run, session, at, jump);
  const Trial trial(run, *pose);
  const std::map<urban_nav_store::EdgeKey, std::int64_t> numbers = urban_nav_store::readEdgeNumbers(store);
  std::map<std::string, urban_nav_store::SessionId> id;
  for (std::size_t s = 0; s < sessions.ids.size(); ++s) id[sessions.names[s]] = sessions.ids[s];
  std::vector<std::pair<double, std::size_t>> tried;  // minus the residual, and the edge
  std::map<std::size_t, JumpExplanation::Cause> causes;
  std::vector<std::size_t> planes;
  std::size_t edge = trial.chains(run.graph.closures().size());
  for (const auto& [number, closure] : run.graph.closures()) {
    const std::size_t e = edge++;
    if (closure.verdict != ClosureVerdict::Accepted) continue;
    if (closure.kind == EdgeKind::Plane) {
      planes.push_back(e);
      continue;
    }
    const urban_nav_store::NodeRef a{id.at(closure.a.session), closure.a.stamp},
        b{id.at(closure.b.session), closure.b.stamp};
    const auto known = numbers.find({a.session, a.stamp, b.session, b.stamp, closure.kind, closure.source});
    JumpExplanation::Cause& cause = causes[e];
    cause.id = known == numbers.end() ? 0 : known->second;
    cause.text = "closure " + std::to_string(cause.id) + ", by " + toString(closure.kind) + ", " +
                 momentText(sessions, a) + " and " + momentText(sessions, b);
    tried.emplace_back(-trial.residual(e), e);
  }
  std::sort(tried.begin(), tried.end());
  jump.left_out = tried.size() > kMostTried ? tried.size() - kMostTried : 0;
  tried.resize(tried.size() - jump.left_out);
  for (const auto& [residual, e] : tried) {
    trial.without({e}, causes[e]);
    jump.causes.push_back(causes[e]);
  }
  if (!planes.empty()) {
    JumpExplanation::Cause cause;
    cause.text = "all " + std::to_string(planes.size()) + " constraints from planes";
    trial.without(planes, cause);
    jump.causes.push_back(std::move(cause));
  }
  std::stable_sort(jump.causes.begin(), jump.causes.end(),
                   [](const auto& a, const auto& b) { return a.joins != b.joins ? a.joins : a.distance > b.distance; });
  return jump;
}

std::string explain(const JumpExplanation& jump) {
  std::string text = jump.moment + ": " + placeText(jump.distance, jump.angle) +
                     " from its pose by odometry, relative to " +
                     (jump.in_own_map ? "the first pose of its map" : "the first pose of its session") + "\n";
  if (jump.causes.empty()) return text + "no accepted closure moves it\n";
  for (std::size_t i = 0; i < std::min(kShownCauses, jump.causes.size()); ++i)
    text += "  " + causeText(jump.causes[i]) + "\n";
  if (jump.causes.size() > kShownCauses)
    text += "  and " + std::to_string(jump.causes.size() - kShownCauses) + " others with a smaller effect\n";
  if (jump.left_out > 0)
    text += "  not tried: " + std::to_string(jump.left_out) + " closures with the smallest residuals\n";
  return text;
}

Page explainOnPage(const JumpExplanation& jump, const std::string& store) {
  Page page;
  page.title = "Why the pose at " + jump.moment + " is there";
  page.subtitle = store;
  PageTable table{"Closures that determine this pose",
                  {"closure", "effect (m)", "(deg)", ""},
                  {},
                  "Distance of the pose from its present place in the map relaxed without this closure."};
  for (const JumpExplanation::Cause& cause : jump.causes)
    table.rows.push_back({cause.text, urban_nav_core::formatNumber(cause.distance, 3),
                          urban_nav_core::formatNumber(kJumpDegrees * cause.angle, 3),
                          cause.joins ? "the only connection of its part" : ""});
  Section section;
  section.id = "jump";
  section.title = "Jump";
  section.tables.push_back(std::move(table));
  page.sections.push_back(std::move(section));
  return page;
}

Json explainAsJson(const JumpExplanation& jump) {
  Json json = Json::object({{"moment", jump.moment}, {"moved_m", jump.distance}, {"moved_rad", jump.angle}});
  Json& rows = json["causes"] = Json::array();
  for (const JumpExplanation::Cause& cause : jump.causes)
    rows.append(Json::object({{"id", cause.id > 0 ? Json(cause.id) : Json()},
                              {"text", cause.text},
                              {"moved_m", cause.distance},
                              {"moved_rad", cause.angle},
                              {"joins", cause.joins}}));
  json["left_out"] = jump.left_out;
  return json;
}

}  // namespace urban_nav
