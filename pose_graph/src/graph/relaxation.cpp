// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "graph/correction_reason.hpp"
#include "graph/jump_gate.hpp"
#include "pose_graph/graph_file.hpp"
#include "pose_graph/pose_graph.hpp"
#include "solve/normal_equations.hpp"

namespace pose_graph {

namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;
constexpr double kMovedDistance = 0.01, kMovedAngle = 0.02 * kDegree;  // docs/architecture.md

/// Writes poses in ascending order and collects the ranges of those that moved.
class Moves {
 public:
  void put(std::size_t track, std::size_t index, const Pose& now, Pose& pose) {
    const bool far = distanceBetween(now, pose) > kMovedDistance || angleBetween(now, pose) > kMovedAngle;
    pose = now;
    if (!far) return;
    if (!runs.empty() && runs.back().track == track && runs.back().last + 1 == index) ++runs.back().last;
    else runs.push_back({track, index, index});
  }

  std::vector<Relaxed::Run> runs;
};

/// Merges overlapping and adjacent ranges.
std::vector<Relaxed::Run> merged(std::vector<Relaxed::Run> runs) {
  std::sort(runs.begin(), runs.end(), [](const Relaxed::Run& a, const Relaxed::Run& b) {
    return std::tie(a.track, a.first) < std::tie(b.track, b.first);
  });
  std::vector<Relaxed::Run> made;
  for (const Relaxed::Run& run : runs) {
    if (!made.empty() && made.back().track == run.track && run.first <= made.back().last + 1)
      made.back().last = std::max(made.back().last, run.last);
    else made.push_back(run);
  }
  return made;
}

}  // namespace

class PoseGraph::TrackView : public GraphView {
 public:
  explicit TrackView(PoseGraph& graph) : graph_(graph) {}

  std::size_t tracks() const override { return graph_.tracks_.size(); }
  const ChainStep* steps(std::size_t track) const override { return graph_.steps_[track].data(); }
  Rigid<3> pose(const NodeIndex& place) const override {
    return toRigid<3>(graph_.tracks_[place.first].map[place.second]);
  }
  std::pair<std::size_t, std::size_t> run(const NodeIndex& place) const override {
    const Run& run = graph_.runs_[place.first][graph_.findRun(place)];
    return {run.first, run.last};
  }
  void write(const NodeIndex& place, const Rigid<3>& T_map_pose) override {
    moves.put(place.first, place.second, toPose(T_map_pose), graph_.tracks_[place.first].map[place.second]);
  }

  Moves moves;

 private:
  PoseGraph& graph_;
};

std::size_t PoseGraph::findRun(const NodeIndex& place) const {
  const std::vector<Run>& runs = runs_[place.first];
  const auto after = std::upper_bound(runs.begin(), runs.end(), place.second,
                                      [](std::size_t index, const Run& run) { return index < run.first; });
  return static_cast<std::size_t>(after - runs.begin()) - 1;
}

std::vector<ClosureId> PoseGraph::accepted() const {
  std::vector<ClosureId> made;
  for (const auto& [id, closure] : closures_)
    if (closure.verdict == ClosureVerdict::Accepted) made.push_back(id);
  return made;
}

std::optional<Pose> PoseGraph::newest() const {
  if (tracks_.empty() || tracks_[running_].map.empty()) return std::nullopt;
  return tracks_[running_].map.back();
}

Relaxed PoseGraph::relax(const SolveOptions& options, const ReferenceSolvers& references) {
  Batch batch = this->batch();
  run(batch, options, references);
  return take(batch);
}

Relaxed PoseGraph::update() {
  const Before before = this->before();
  if (std::all_of(tracks_.begin(), tracks_.end(), [](const Track& track) { return track.map.empty(); })) return {};
  Relaxed made;
  std::vector<Relaxed::Run> moved = evaluateNew(made);
  const std::vector<Relaxed::Run> renumbered = numberParts();
  moved.insert(moved.end(), renumbered.begin(), renumbered.end());
  ending_warning_ = endingWarning(made.ending, made.iterations.size(), made.gradient);
  reportCorrection(made, std::move(moved), before);
  return made;
}

std::vector<Relaxed::Run> PoseGraph::evaluateNew(Relaxed& made) {
  TrackView paper(*this);
  const auto renewed = [&] {
    std::vector<ClosureEdge> closure_edges;
    for (const auto& [id, closure] : closures_)
      if (closure.weight > 0.0) closure_edges.push_back(closure_edges_.at(id));
    return IncrementalSolver(paper, closure_edges, parameters_.iterations, odometry_variance_);
  };
  if (!live_.has_value()) live_ = renewed();
  IncrementalSolver& live = *std::any_cast<IncrementalSolver>(&live_);
  const Addition added = evaluateAddition(live, paper, parameters_, closure_edges_, closures_);
  if (added.others_wait) live = renewed();
  for (auto& [id, closure] : closures_) closure.judged = true;
  live.write(paper);
  made.cost_before = added.cost_before;
  made.cost_after = live.cost();
  made.iterations = live.iterations();
  made.ending = live.ending();
  made.needs_batch = added.disagreement || added.provisional;
  made.gradient = live.gradient();
  return std::move(paper.moves.runs);
}

std::vector<Relaxed::Run> PoseGraph::applyPoses(const PoseTable& pose_table) {
  Moves moves;
  for (std::size_t t = 0; t < tracks_.size(); ++t)
    for (std::size_t i = 0; i < pose_table[t].size(); ++i) moves.put(t, i, pose_table[t][i], tracks_[t].map[i]);
  return std::move(moves.runs);
}

std::vector<Relaxed::Run> PoseGraph::numberParts() {
  std::vector<Relaxed::Run> changed;
  const std::vector<int> parts = partNumbers();
  parts_ = parts.empty() ? 0 : 1 + *std::max_element(parts.begin(), parts.end());
  std::size_t number = 0;
  for (std::vector<Run>& runs : runs_)
    for (Run& run : runs) {
      const int part = parts[number++];
      if (part == run.part) continue;
      run.part = part;
      std::vector<int>& of_pose = tracks_[run.track].part;
      std::fill(of_pose.begin() + static_cast<std::ptrdiff_t>(run.first),
                of_pose.begin() + static_cast<std::ptrdiff_t>(run.last) + 1, part);
      changed.push_back({run.track, run.first, run.last});
    }
  return changed;
}

void PoseGraph::reportCorrection(Relaxed& made, std::vector<Relaxed::Run> moved, const Before& before, bool levelled) {
  made.revision = ++revision_;
  made.closures = closures_.size();
  made.selection = selection_;
  made.slips = slips_;
  for (const auto& [id, closure] : closures_) {
    made.accepted += closure.verdict == ClosureVerdict::Accepted;
    made.rejected += closure.verdict == ClosureVerdict::Rejected;
    made.waiting += closure.verdict == ClosureVerdict::Waiting;
  }
  made.parts = parts_;
  made.moved = merged(std::move(moved));
  made.edges = closures_.size();
  for (const Track& track : tracks_) {
    if (track.stamps.empty()) continue;
    made.poses += track.stamps.size();
    made.edges += track.stamps.size() - 1;
    made.sessions_joined += track.part.back() == 0;
  }
  const std::vector<Closure> removed = std::exchange(removed_, {});
  if (!before.newest) return;
  const Track& track = tracks_[running_];
  const double distance = distanceBetween(*before.newest, track.map.back()),
               angle = angleBetween(*before.newest, track.map.back());
  const bool is_small =
      distance <= parameters_.confirmation_distance && angle <= parameters_.confirmation_angle * kDegree;
  if (is_small && !levelled) return;
  Relaxed::Correction correction;
  correction.at = {track.session, track.stamps.back()};
  correction.before = *before.newest;
  correction.after = track.map.back();
  correction.distance = distance;
  correction.angle = angle;
  explain(correction, before.accepted, removed, closures_, levelled);
  made.correction = std::move(correction);
}

std::vector<int> PoseGraph::partNumbers() const {
  Problem<3> joined;  // one pose per run
  std::vector<std::size_t> first;
  for (const std::vector<Run>& runs : runs_) {
    first.push_back(joined.poses.size());
    joined.poses.resize(joined.poses.size() + runs.size());
  }
  const auto findNumber = [&](const NodeIndex& place) { return static_cast<int>(first[place.first] + findRun(place)); };
  for (const auto& [id, closure] : closures_) {
    if (closure.weight <= 0.0) continue;
    const ClosureEdge& closure_edge = closure_edges_.at(id);
    const int a = findNumber(closure_edge.a), b = findNumber(closure_edge.b);
    if (a == b) continue;
    joined.edges.emplace_back();
    joined.edges.back().from = a;
    joined.edges.back().to = b;
  }
  return makeUnknowns(joined).component;
}

}  // namespace pose_graph
