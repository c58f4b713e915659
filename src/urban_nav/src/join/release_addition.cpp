// SPDX-License-Identifier: BSD-3-Clause
#include "join/release_addition.hpp"

#include <algorithm>

#include "inspect/stores_command.hpp"
#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/parameters.hpp"
#include "map/session_order.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_store/merge.hpp"

namespace urban_nav {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_store::Access;
using urban_nav_store::RelaxedPose;
using urban_nav_store::SessionId;
using urban_nav_store::Store;

namespace {

// Poses of a release are fixed: their edges have these standard deviations, far below those of closures.
constexpr double kRigidSigma = 1e-4;       // m, of the position of one pose relative to another
constexpr double kRigidSigmaAngle = 1e-5;  // rad
constexpr const char* kReleaseEdge = "release";

Matrix6d rigidCovariance() {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal().head<3>().setConstant(kRigidSigma * kRigidSigma);
  covariance.diagonal().tail<3>().setConstant(kRigidSigmaAngle * kRigidSigmaAngle);
  return covariance;
}

/// The release and the sessions to add, in one store.
class Addition {
 public:
  Addition(const std::string& release, JoinOptions options, AllStages stages, Console& console)
      : release_(release),
        sources_(std::move(options.stores)),
        out_(std::move(options.out)),
        stages_(std::move(stages)),
        workplace_(out_ + ".onto"),  // that of the release has its own
        map_options_{{}, workplace_.folder(),           stagesOfJoin(), "", "", "",
                     {}, std::move(options.parameters), options.threads},
        context_(map_options_, console) {
    if (!urban_nav_store::isRelease(release))
      throw urban_nav_core::UserError(release, "is not a release", "a file written by urban_nav release");
    for (const std::string& store : sources_) requireFinished(store);
    for (const std::unique_ptr<Stage>& stage : stages_) stage->select(map_options_);  // reports bad files first
    collect();
  }

  ReleaseAddition run() {
    {
      Store store(workplace_.store(), Access::Write);
      context_.store = &store;
      prepare(store);
      for (const char* stage : {"places", "loops", "graph"})
        runStage(stages_, stage, context_, result_.release.warnings);
      place(store);
      renderScans(store);
      select(store);
      store.commit();
      store.close();
    }
    std::vector<std::string> warnings = std::move(result_.release.warnings);
    ++head_.version;
    head_.parents.insert(head_.parents.begin(), head_.digest);
    head_.digest.clear();
    result_.release = writeRelease(workplace_.store(), kept_, first_, head_, out_);
    result_.release.warnings = std::move(warnings);
    return std::move(result_);
  }

 private:
  /// Writes the release and the sessions that are new to it into one store.
  void collect() {
    const std::string offered = workplace_.folder() + "/offered.db", known = workplace_.folder() + "/release.db";
    urban_nav_store::copyRows(release_, known, [](const auto&, const auto&) { return true; });
    urban_nav_store::merge(sources_, offered, urban_nav_store::MergeContent::Sessions);
    {
      Store store(known, Access::Snapshot), other(offered, Access::Write);
      head_ = readReleaseHead(store);
      for (const urban_nav_store::Session& session : store.sessions().all()) {
        if (const auto anchor = store.sessions().anchor(session.id)) first_ = anchor->map;
        if (store.graph().nodes(session.id) > 0) in_release_.insert(session.id);
        if (!other.sessions().find(session.id)) continue;
        result_.added.push_back({session.id, true, false, 0, 0, "the release holds this session"});
        other.sessions().remove(session.id);
      }
      other.commit();
      other.close();
    }
    urban_nav_store::merge({known, offered}, workplace_.store());
  }

  /// Reads all sessions, those of the release as one rigid body.
  void prepare(Store& store) {
    context_.joins = true;
    context_.previous = readPreviousSessions(store, {});
    context_.names = context_.previous.names;
    const std::vector<SessionId>& ids = context_.previous.ids;
    for (std::size_t s = 0; s < ids.size(); ++s) {
      context_.is_frozen.push_back(in_release_.count(ids[s]) != 0);
      if (!context_.is_frozen[s]) continue;
      std::vector<RelaxedPose>& poses = poses_[ids[s]];
      store.graph().forEachRelaxed(ids[s], [&](const RelaxedPose& pose) { poses.push_back(pose); });
      if (const auto anchor = store.sessions().anchor(ids[s])) anchors_.push_back(*anchor);
      stiffen(context_.previous.runs[s], poses);
      if (!poses.empty()) tie(store, ids[s]);
    }
    if (reference_.empty())
      throw urban_nav_core::DataError(release_, "is damaged: it has no poses", "a file written by urban_nav release");
    context_.trajectories = odometryTrajectories(context_.runs(), 0);
  }

  /// Replaces the steps of a session's odometry by those between its poses in the map.
  static void stiffen(SessionOdometry& run, const std::vector<RelaxedPose>& poses) {
    std::map<StampNs, Pose> at;
    for (const RelaxedPose& pose : poses) at[pose.stamp] = pose.T_map_base;
    run.settled.erase(std::remove_if(run.settled.begin(), run.settled.end(),
                                     [&](const SmoothedFrame& frame) { return at.count(frame.stamp) == 0; }),
                      run.settled.end());
    for (std::size_t i = 0; i < run.settled.size(); ++i) {
      SmoothedFrame& frame = run.settled[i];
      frame.T_odom_base.pose = at.at(frame.stamp);
      urban_nav_core::RelativePose& step = frame.from_previous;
      step.from = i == 0 ? frame.stamp : run.settled[i - 1].stamp;
      step.to = frame.stamp;
      if (i > 0) step.T_from_to = run.settled[i - 1].T_odom_base.pose.inverse() * frame.T_odom_base.pose;
      step.covariance = step.drift_covariance = rigidCovariance();
      step.constants = {};
    }
  }

  /// Adds an edge from the first pose of the release's first session to that of another one.
  void tie(Store& store, const SessionId& id) {
    if (reference_.empty()) reference_ = id;
    if (id == reference_) return;
    urban_nav_store::Edge edge;
    edge.a = {reference_, poses_[reference_].front().stamp};
    edge.b = {id, poses_[id].front().stamp};
    edge.kind = urban_nav_store::EdgeKind::Asserted;
    edge.source = kReleaseEdge;
    edge.measured.T_a_b = poses_[reference_].front().T_map_base.inverse() * poses_[id].front().T_map_base;
    edge.measured.information = rigidCovariance().inverse();
    store.graph().put(edge);
    ties_.push_back(edge);
  }

  /// Restores the poses of the release, and transforms those of joined sessions to its frame.
  void place(Store& store) {
    for (const urban_nav_store::Edge& edge : ties_) store.graph().remove(edge);
    const std::vector<SessionId>& ids = context_.previous.ids;
    const auto reference = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), reference_) - ids.begin());
    const SessionTrajectory& known = context_.trajectories[reference];
    const Pose T_release_map = poses_[reference_].front().T_map_base * known.T_map_base.front().pose.inverse();
    for (std::size_t s = 0; s < ids.size(); ++s) {
      if (context_.is_frozen[s]) {
        for (const RelaxedPose& pose : poses_[ids[s]]) store.graph().put(ids[s], pose);
        continue;
      }
      SessionTrajectory& session = context_.trajectories[s];
      AddedSession added{ids[s], session.map == known.map, false, 0, 0, ""};
      if (added.joined) moveInto(store, ids[s], T_release_map, session);
      else added.reason = "no closure joins it to the release";
      result_.added.push_back(std::move(added));
    }
    for (const urban_nav_store::Anchor& anchor : anchors_) store.sessions().put(anchor);
  }

  void moveInto(Store& store, const SessionId& id, const Pose& T_release_map, SessionTrajectory& session) {
    urban_nav_core::Trajectory moved;
    for (std::size_t i = 0; i < session.T_map_base.size(); ++i) {
      const urban_nav_core::StampedPose& pose = session.T_map_base[i];
      moved.append(pose.stamp, T_release_map * pose.pose);
      RelaxedPose relaxed{pose.stamp, moved.back().pose, 1};
      if (i < session.covariances.size()) relaxed.covariance = session.covariances[i];
      store.graph().put(id, relaxed);
    }
    session.T_map_base = std::move(moved);
    const auto node = store.graph().node({id, session.T_map_base.front().stamp});
    if (node)
      store.sessions().put(
          urban_nav_store::Anchor{id, first_, 1, session.T_map_base.front().pose * node->T_odom_base.inverse()});
  }

  /// Renders the scans of joined sessions along their poses.
  void renderScans(Store& store) {
    std::vector<laser_mapper::MappedSession> mapped;
    for (const AddedSession& added : result_.added) {
      const auto s = static_cast<std::size_t>(
          std::find(context_.previous.ids.begin(), context_.previous.ids.end(), added.session) -
          context_.previous.ids.begin());
      if (!added.joined || s >= context_.trajectories.size() || context_.is_frozen[s] ||
          store.scans().lasers(added.session).empty())
        continue;
      mapped.push_back({added.session, &context_.trajectories[s].T_map_base, &context_.trajectories[s].covariances});
    }
    if (mapped.empty()) return;
    laser_mapper::LaserMap(map_options_.parameters.get(laser_mapper::table()), store, mapped).render();
  }

  void select(Store& store) {
    ReleaseSelection selection(map_options_.parameters.get(urban_nav_registration::table()).cloud_half_length);
    for (const SessionId& id : in_release_)
      kept_.push_back(selection.addWhole(store, readTrajectory(store, *store.sessions().find(id))));
    for (AddedSession& added : result_.added) {
      if (!added.joined || in_release_.count(added.session) != 0) continue;
      KeptSession kept = selection.add(store, readTrajectory(store, *store.sessions().find(added.session)));
      added.kept = !kept.isEmpty();
      added.places = kept.places.size();
      added.keyframes = kept.keyframes.size();
      if (added.kept) kept_.push_back(std::move(kept));
      else added.reason = "it shows no place that is new to the release";
    }
  }

  const std::string release_;
  const std::vector<std::string> sources_;
  const std::string out_;
  const AllStages stages_;
  Workplace workplace_;
  const MapOptions map_options_;
  MapContext context_;
  urban_nav_store::ReleaseHead head_;
  SessionId first_;      // whose first pose is the origin of the map
  SessionId reference_;  // first session of the release with poses
  std::set<SessionId> in_release_;
  std::map<SessionId, std::vector<RelaxedPose>> poses_;  // of the release
  std::vector<urban_nav_store::Anchor> anchors_;         // of its sessions
  std::vector<urban_nav_store::Edge> ties_;
  std::vector<KeptSession> kept_;
  ReleaseAddition result_;
};

}  // namespace

ReleaseAddition addToRelease(const std::string& release, JoinOptions options, AllStages stages, Console& console) {
  return Addition(release, std::move(options), std::move(stages), console).run();
}

}  // namespace urban_nav
