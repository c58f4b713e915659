// SPDX-License-Identifier: BSD-3-Clause
#include "topics/graph/closure_import.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

using pose_graph::Closure;
using pose_graph::EdgeKind;
using urban_nav_core::ClosureMethod;
using urban_nav_core::ClosureVerdict;
using urban_nav_core::Matrix6d;
using urban_nav_core::MetricClosure;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;

namespace {

/// Identity of a closure in the graph, and its numbers; sessions by their index.
using Place = std::tuple<std::size_t, StampNs, std::size_t, StampNs, EdgeKind>;
using Numbers = std::array<double, 8>;

Numbers toNumbers(const Closure& closure) {
  const Pose& T = closure.measured.T_a_b;
  return {T.t().x(), T.t().y(), T.t().z(), T.q().x(),
          T.q().y(), T.q().z(), T.q().w(), closure.measured.information.trace()};
}

/// Returns the closure of an edit for a row of closures.csv.
MetricClosure toEditedClosure(const pose_graph::Edit& edit) {
  MetricClosure closure;
  closure.a = {edit.a.session, edit.a.stamp};
  closure.b = {edit.b.session, edit.b.stamp};
  closure.measured = edit.measured;
  closure.probability = 1.0;
  if (edit.kind == EdgeKind::Stereo) closure.method = ClosureMethod::Stereo;
  if (edit.kind == EdgeKind::Icp) closure.method = ClosureMethod::Icp;
  closure.verdict = ClosureVerdict::Accepted;
  closure.evidence = edit.evidence;
  closure.source = edit.source;
  return closure;
}

class ClosureImport {
 public:
  ClosureImport(const std::vector<std::string>& sessions, const std::vector<const SessionOdometry*>& runs)
      : sessions_(sessions) {
    for (const SessionOdometry* one : runs) odometry_.push_back(odometryChain(*one));
  }

  /// Adds a closure of this run. `index`: in GraphRun::closures. Returns the reason if it cannot be used, else empty.
  std::string add(std::size_t index, const MetricClosure& offered) {
    for (const std::string* name : {&offered.a.session, &offered.b.session})
      if (findPlace(*name) == sessions_.size())
        return "no session \"" + *name + "\" in this map; there are: " + listing();
    if (offered.verdict == ClosureVerdict::Rejected) return offered.reason_name + ": " + offered.sentence;
    if (offered.verdict == ClosureVerdict::Waiting) return "no transform in the file, and no stage that finds one";
    Closure closure;
    Matrix6d from_offered = Matrix6d::Identity();  // d_offered = from_offered d, of perturbations of T_a_b
    Pose T_a_b = offered.measured.T_a_b;
    for (const bool at_a : {true, false}) {
      const auto& [name, stamp] = at_a ? offered.a : offered.b;
      const auto moment = odometry_[findPlace(name)].nearestFrame(stamp);
      if (!moment) return "no frames around " + urban_nav_core::printStamp(stamp) + " s in " + name;
      (at_a ? closure.a : closure.b) = {name, moment->frame};
      const Pose& T_frame_pose = moment->T_frame_pose;
      const Pose T_pose_frame = T_frame_pose.inverse();
      from_offered *= at_a ? compose(T_pose_frame, T_frame_pose * T_a_b).J2
                           : Matrix6d(2.0 * Matrix6d::Identity() - compose(T_a_b, T_pose_frame).J1);
      T_a_b = at_a ? T_frame_pose * T_a_b : T_a_b * T_pose_frame;
    }
    closure.kind = offered.method == ClosureMethod::Icp ? EdgeKind::Icp : EdgeKind::Stereo;
    closure.source = offered.source;
    closure.odometry_gate = offered.odometry_gate;
    closure.measured = {T_a_b, offered.measured.information};
    // The information of a file is isotropic, hence unchanged at the nearest frames.
    if (isMeasured(offered))
      closure.measured.information = urban_nav_core::transformInformation(from_offered, offered.measured.information);
    closures_.emplace(toKey(closure), std::make_pair(index, closure));
    return {};
  }

  /// Adds previous closures, except those replaced by a closure of this run. Asserted ones are of another kind and
  /// kept.
  void add(const std::vector<Closure>& previous) {
    std::set<Place> replaced;
    for (const auto& [key, closure] : closures_) replaced.insert(key.first);
    for (std::size_t i = 0; i < previous.size(); ++i) {
      const Key key = toKey(previous[i]);
      if (replaced.count(key.first) == 0) closures_.emplace(key, std::make_pair(i, previous[i]));
    }
  }

  void addTo(pose_graph::EditedGraph& edited, GraphRun& run) const {
    for (const auto& [key, indexed] : closures_) {
      const auto& [index, closure] = indexed;
      try {
        const std::optional<pose_graph::ClosureId> id = edited.addClosure(closure);
        run.assessments[index].id = id ? *id : -static_cast<std::int64_t>(edited.rejected().size());
      } catch (const urban_nav_core::UserError& error) {
        run.assessments[index].reason = error.what();
      }
    }
  }

 private:
  using Key = std::pair<Place, Numbers>;

  std::size_t findPlace(const std::string& session) const {
    return static_cast<std::size_t>(std::find(sessions_.begin(), sessions_.end(), session) - sessions_.begin());
  }
  Key toKey(const Closure& closure) const {
    return {
        {findPlace(closure.a.session), closure.a.stamp, findPlace(closure.b.session), closure.b.stamp, closure.kind},
        toNumbers(closure)};
  }
  std::string listing() const {
    std::string text;
    for (const std::string& name : sessions_) text += (text.empty() ? "" : ", ") + name;
    return text;
  }

  const std::vector<std::string>& sessions_;
  std::vector<urban_nav_core::OdometryChain> odometry_;
  std::multimap<Key, std::pair<std::size_t, Closure>> closures_;  // with their indices; equal keys in order of addition
};

}  // namespace

void importClosures(GraphRun& run, pose_graph::EditedGraph& edited, const std::vector<const SessionOdometry*>& runs,
                    const std::vector<MetricClosure>& closures, const PreviousClosures& previous) {
  run.closures = previous.offered;
  run.closures.insert(run.closures.end(), closures.begin(), closures.end());
  run.assessments.resize(run.closures.size());
  ClosureImport import(run.sessions, runs);
  for (std::size_t i = previous.offered.size(); i < run.closures.size(); ++i)
    run.assessments[i].reason = import.add(i, run.closures[i]);
  import.add(previous.in_graph);
  import.addTo(edited, run);
  edited.addOwnClosures();
  run.rejected_by_hand = edited.rejected();
  for (const pose_graph::EditedGraph::OwnClosure& own : edited.ownClosures()) {
    run.closures.push_back(toEditedClosure(*own.edit));
    run.assessments.emplace_back();
    run.assessments.back().id = own.id;
  }
}

}  // namespace urban_nav
