// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/console.hpp"
#include "evaluation/evaluation.hpp"
#include "map/closure_rows.hpp"
#include "map/map_options.hpp"
#include "map/previous_sessions.hpp"
#include "map/session_trajectory.hpp"
#include "urban_nav_input/session/sessions.hpp"
#include "urban_nav_registration/keyframe/mounted_camera.hpp"
#include "urban_nav_store/store.hpp"
#include "urban_nav_store/tables/place_link.hpp"

namespace urban_nav {

/// A session of this run.
struct MapSession {
  urban_nav_input::InputSession input;
  urban_nav_input::SourceInfo info;  ///< set when its source is open
  urban_nav_store::SessionId id;
  bool continued = false;  ///< its bags continue a session of the store given by --store
  std::shared_ptr<SessionOdometry> odometry = std::make_shared<SessionOdometry>();  ///< so far, while it is read
  std::shared_ptr<const SessionOdometry> by_laser;  ///< if both sources are used; else null
};

/// Comparison of a session with ground truth; nullopt where there is none.
struct SessionEvaluations {
  std::optional<Evaluation> odometry;  ///< only in a run that relaxes
  std::optional<Evaluation> map;       ///< of the poses that are written
};

/// Shared data of the stages of a run: options, sessions, store, and results passed from earlier to later stages. Not
/// thread-safe.
///
/// Vectors "over all sessions" hold the sessions in the order of their numbers: the previous ones first, then those of
/// this run; all of them in the order of their start where the run joins them.
struct MapContext {
  MapContext(const MapOptions& of_run, Console& of_user) : options(of_run), console(of_user) {}

  const MapOptions& options;
  Console& console;
  urban_nav_store::Store* store = nullptr;  ///< session.db of the run; set before the first session
  std::vector<MapSession> sessions;
  PreviousSessions previous;       ///< of the store given by --store, if a stage uses them
  bool joins = false;              ///< recognises places and measures closures of previous sessions again
  std::vector<std::string> names;  ///< over all sessions, as closures.csv names them

  std::vector<urban_nav_core::MetricClosure> closures;  ///< candidates, then with transforms; those of previous runs
                                                        ///< before them when the pose graph is relaxed
  std::vector<ClosureAssessment> assessments;           ///< one for each closure; empty until the pose graph is relaxed
  std::vector<SessionTrajectory> trajectories;  ///< over all sessions; by stage vo, then by graph and localization
  bool relaxed = false;                         ///< the trajectories are those of the pose graph
  std::vector<urban_nav_core::Trajectory>
      stereo_only;                              ///< over all sessions, relaxed without ICP; empty: no difference
  std::vector<SessionEvaluations> evaluations;  ///< over all sessions; empty until all stages have run
  std::vector<std::size_t> numbers;  ///< over all sessions, of those of this run; empty: they follow the previous ones
  /// Over all sessions: part of a release, whose places are known and whose poses are fixed. Empty: none.
  std::vector<bool> is_frozen;
  /// Closures measured before, by pieces of a join or for larger groups, by their poses: not measured again.
  std::map<std::pair<urban_nav_core::PoseRef, urban_nav_core::PoseRef>, urban_nav_core::MetricClosure> measured;
  std::vector<urban_nav_core::MetricClosure> given;  ///< closures of a file, before places are recognised
  /// Whether places are recognised again within each map, until no map divides further (map_division.hpp).
  bool divides = false;
  /// Over all sessions: number of the group within which its places are recognised. Empty: one group.
  std::vector<std::size_t> groups;
  bool is_divided = false;  ///< by the last run of the pose graph, which is therefore not final
  /// Accepted links between places, with which places are recognised again (learnt_links.hpp). nullopt: not yet.
  std::optional<std::vector<urban_nav_store::PlaceLink>> learnt;
  bool learns = false;  ///< from the last run of the pose graph, which is therefore not final
  std::vector<urban_nav_core::MetricClosure> between_groups;  ///< rejected candidates, with the reason

  /// Returns the number of a session of this run over all sessions. Requires session < sessions.size().
  std::size_t number(std::size_t session) const;
  /// Returns whether the session with this number is one of the previous ones.
  bool isPrevious(std::size_t number) const;
  /// Returns whether the last run of the pose graph is final; otherwise places are recognised again.
  bool isFinal() const { return !is_divided && !learns; }
  /// Returns the number of first sessions whose files of an earlier run are kept.
  std::size_t sessionsKept() const { return joins ? 0 : previous.runs.size(); }
  /// Return odometry and store keys over all sessions.
  std::vector<const SessionOdometry*> runs() const;
  std::vector<urban_nav_store::SessionId> ids() const;
  /// Returns the camera of the last session with images; for a stored session, the camera of the run that stored it.
  /// nullopt if no session has images.
  std::optional<urban_nav_registration::MountedCamera> lastCamera() const;
};

}  // namespace urban_nav
