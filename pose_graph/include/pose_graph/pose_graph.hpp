// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <any>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "pose_graph/common_error.hpp"
#include "pose_graph/fix_use.hpp"
#include "pose_graph/ground_level.hpp"
#include "pose_graph/node_index.hpp"
#include "pose_graph/parameters.hpp"
#include "pose_graph/reference_solver.hpp"
#include "pose_graph/robust.hpp"
#include "pose_graph/solution.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_core/types/status.hpp"
#include "urban_nav_store/graph_store.hpp"

namespace pose_graph {

using urban_nav_core::ClosureVerdict;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_store::EdgeKind;
using urban_nav_store::NodeRef;
using urban_nav_store::SessionId;
using ClosureId = std::int64_t;

/// Reason for a status other than OK: Status::reason of this stage.
enum class Trouble : int {
  None = 0,
  BrokenChain,  ///< a relative pose does not begin at the previous pose: the following poses are a separate part
  Separate,     ///< sessions, or parts of one, that are not joined by an accepted closure
  Waiting,      ///< a closure waits for a second one that is consistent with it
  NotStored,    ///< live only: data do not reach the store
  Undecided,    ///< no set of closures is more likely than chance: the map is that of odometry
  Guess,        ///< another set of closures is nearly as likely, or the graph is too large to compare sets
  Slipped,      ///< closures contradict a step of odometry
  Unconverged,  ///< the last relaxation ended before it reached the minimum
};
const char* toString(Trouble trouble);

/// Reason for a discontinuous correction of the newest pose, published on graph/correction.
enum class CorrectionReason : int {
  None = 0,
  ClosuresAccepted,  ///< newly accepted closures (causing_edges)
  ClosureAsserted,   ///< as ClosuresAccepted, at least one of them asserted manually
  ClosuresRejected,  ///< previously accepted closures were rejected (causing_edges)
  ClosuresRemoved,   ///< accepted closures were removed manually (causing_edges)
  Refined,           ///< no change of closures: the batch relaxation from the measurements gave other poses
  Levelled,          ///< the upward direction became known: the map was rotated about its first pose
};
const char* toString(CorrectionReason reason);

/// A closure with its measurement and the verdict of the last relaxation.
struct Closure {
  ClosureId id = 0;
  NodeRef a, b;
  EdgeKind kind = EdgeKind::Stereo;  ///< not Odometry
  std::string source;
  urban_nav_core::Constraint measured;  ///< T_a_b
  bool odometry_gate = false;           ///< odometry gate of its stage: consistent with odometry
  bool by_hand = false;                 ///< confirmed manually: never weighted down, as an asserted closure
  // Results of the last relaxation.
  bool judged = false;
  double weight = 0.0;
  ClosureVerdict verdict = ClosureVerdict::Waiting;
  std::string reason;
  double chi2 = 0.0;                       ///< with respect to all other accepted edges
  std::vector<ClosureId> contradicted_by;  ///< asserted closures: edges inconsistent with this one, the worst first
};

inline bool isVouchedFor(const Closure& closure) { return closure.kind == EdgeKind::Asserted || closure.by_hand; }

/// One session of the trajectory.
struct Track {
  SessionId session;
  std::vector<StampNs> stamps;  ///< ascending
  std::vector<Pose> odom;       ///< T_odom_base: odometry only, relative to the first pose
  std::vector<Pose> map;        ///< T_map_base; equal to `odom` without corrections by closures
  std::vector<int> part;        ///< map of each pose: 0 is the map of the first session's first pose
};

/// Result of one relaxation.
struct Relaxed {
  std::int64_t revision = 0;
  std::size_t poses = 0, edges = 0, closures = 0, accepted = 0, rejected = 0, waiting = 0;
  int parts = 0;            ///< number of maps that are not joined
  int sessions_joined = 0;  ///< sessions whose newest pose lies in map 0
  double cost_before = 0.0, cost_after = 0.0;
  std::vector<Iteration> iterations;
  Ending ending = Ending::Converged;
  double gradient = 0.0;  ///< as Solution::gradient
  /// Poses that moved by more than 1 cm or 0.02 deg, as index ranges [first, last] of a track.
  struct Run {
    std::size_t track = 0, first = 0, last = 0;
  };
  std::vector<Run> moved;
  /// Correction of the active session's newest pose if it exceeds these thresholds: for graph/correction.
  struct Correction {
    NodeRef at;
    Pose before, after;  ///< T_map_base
    double distance = 0.0, angle = 0.0;
    CorrectionReason reason = CorrectionReason::None;
    std::string sentence;
    std::vector<Closure> causing_edges;  ///< depends on `reason`
  };
  std::optional<Correction> correction;
  bool needs_batch = false;   ///< update() tested closures one by one; only relax() compares sets of closures
  SelectionReport selection;  ///< of the last batch
  /// A step of odometry that all closures contradict: its weight is almost zero, and it follows the closures.
  struct Slip {
    NodeRef from, to;
  };
  std::vector<Slip> slips;  ///< of the last batch
};

/// Returns a message such as "odometry slipped between kitchen at 12.3 s and ...".
std::string toSentence(const Relaxed::Slip& slip);

/// A batch relaxation of a snapshot of the graph. PoseGraph::batch() creates it, run() computes, possibly in another
/// thread while the graph grows, and PoseGraph::take() applies the result.
struct Batch {
  Parameters parameters;
  Problem<3> problem;  ///< as PoseGraph::problem() with odometry as measured; after run(), levelled and with the
                       ///< estimated covariances
  std::vector<std::vector<StampNs>> stamps;        ///< of each track
  std::vector<std::vector<SpecificForce>> forces;  ///< of each track; a caller with more measurements may replace them
  std::vector<std::vector<PositionFix>> fixes;     ///< of each track; a caller with more measurements may replace them
  std::map<ClosureId, Closure> closures;           ///< with verdicts after run()
  Solution<3> solution;
  SelectionReport selection;
  std::vector<int> slipped;  ///< indices of edges of `problem`
  double odometry_variance = 1.0;
  double odometry_lean = 0.0;
  FixUse fix_use;
};
/// Runs a batch. Deterministic. A batch aborted through SolveOptions::progress must not be passed to PoseGraph::take().
/// Throws UserError if Parameters::solver is neither gauss_newton nor the name of one of `references`.
void run(Batch& batch, const SolveOptions& options = {}, const ReferenceSolvers& references = {});

/// The pose graph of many sessions: chains of relative poses, corrected by closures (Newman et al. 2009, sections 5 and
/// 7). Sessions are joined by closures only; two consistent closures suffice, and no manual alignment is needed.
///
/// Not thread-safe. The same calls give bit-identical results for any number of threads.
class PoseGraph {
 public:
  /// `revision`: start of the revision count if this graph replaces another one.
  explicit PoseGraph(const Parameters& parameters, std::int64_t revision = 0);

  /// Begins a session. Throws UserError if it exists.
  void beginSession(const SessionId& session);
  bool hasSession(const SessionId& session) const;
  /// Sets the session that is being recorded, whose corrections are reported. Default: the session begun last.
  void goOn(const SessionId& session);

  /// Appends a step to a session's chain; the first step adds two poses. A step that does not begin at the session's
  /// newest pose breaks the chain (Trouble::BrokenChain). Returns false and ignores the step if it does not end later
  /// than the newest pose or is not finite.
  bool addOdometry(const SessionId& session, const urban_nav_core::RelativePose& step);

  /// Adds a closure and returns its id; the next relax() sets its verdict. Replaces an edge with the same poses, kind
  /// and source. Throws UserError if a pose does not exist (the message states the nearest one that does), if numbers
  /// are not finite, or if the information has a negative eigenvalue.
  ClosureId addClosure(const Closure& offered);
  /// Removes a closure. Returns false if it does not exist.
  bool removeClosure(ClosureId id);
  std::optional<ClosureId> findClosure(const NodeRef& a, const NodeRef& b, EdgeKind kind,
                                       const std::string& source) const;

  /// Sets specific forces at poses of a session, in ascending order of time; they replace the stored ones from the
  /// first of the new stamps on. Batches level by them: if the upward direction is known for one session of a map, the
  /// map has z up, with origin and heading of its first pose.
  void putForces(const SessionId& session, const std::vector<SpecificForce>& forces);
  const std::vector<SpecificForce>& forces(std::size_t track) const { return forces_[track]; }
  /// Adds ground normals at poses of a session, in ascending order of time; normals not later than the newest stored
  /// one are ignored. They level maps for which no session has an accelerometer.
  void putGround(const SessionId& session, const std::vector<GroundNormal>& normals);
  const std::vector<GroundNormal>& ground(std::size_t track) const { return ground_[track]; }
  /// Adds position fixes of a session, in ascending order of time; fixes not later than the newest stored one are
  /// ignored. Batches use them if Parameters::gps is set.
  void putFixes(const SessionId& session, const std::vector<PositionFix>& fixes);
  const std::vector<PositionFix>& fixes(std::size_t track) const { return fixes_[track]; }
  /// Returns the use of the fixes in the last batch.
  const FixUse& fixUse() const { return fix_use_; }
  /// Levels the maps whose upward direction became known. Returns the correction as relax() does; empty if nothing
  /// changed.
  std::optional<Relaxed> level();
  /// Returns whether the map of a session is level.
  bool isLevel(const SessionId& session) const;

  /// Relaxes the whole graph from the measurements only, independent of earlier relaxations. Deterministic. Throws as
  /// run().
  Relaxed relax(const SolveOptions& options = {}, const ReferenceSolvers& references = {});
  /// batch(), run() and take() are the three steps of relax(). Data added since batch() follow the relaxed poses;
  /// closures added or measured again since then are tested as by update(). `batch` must be of this graph.
  Batch batch() const;
  Relaxed take(const Batch& batch);
  /// Relaxes incrementally from the current poses for added closures. Accepts each closure whose innovation passes a
  /// chi-square test at 99.9 %; earlier verdicts stay. Much faster than relax(), and provisional: if a closure was
  /// accepted or contradicts the graph, `needs_batch` requests relax(), which compares sets of closures and may reject
  /// any of them.
  Relaxed update();

  const std::vector<Track>& tracks() const { return tracks_; }
  const Track* track(const SessionId& session) const;
  /// Returns the measured step that ends at a pose of a track; null for the first pose and after a gap.
  const urban_nav_core::RelativePose* stepTo(std::size_t track, std::size_t pose) const;
  const std::map<ClosureId, Closure>& closures() const { return closures_; }
  std::int64_t revision() const { return revision_; }
  urban_nav_core::Status status() const;

  /// Returns the graph as a problem: poses track by track; edges of the chains, then closures in ascending order of id.
  Problem<3> problem() const;
  /// Returns the index of a pose in problem().
  std::optional<int> poseNumber(const NodeRef& ref) const;
  /// Returns the factor of odometry's covariances in the last relax() and in problem(): more than 1 if closures show
  /// that odometry is overconfident; at most 9 unless robust selection found a larger one more likely.
  double odometryVariance() const { return odometry_variance_; }
  /// Returns the closure selection of the last batch.
  const SelectionReport& selection() const { return selection_; }
  /// Returns the largest tilt of an odometry pose relative to the first one, as measured by the accelerometer and
  /// corrected in the last relax(), rad.
  double odometryLean() const { return odometry_lean_; }
  /// Returns the covariance of a pose's own noise, in its own axes: half of the part of its step's covariance that does
  /// not accumulate along the path, if the step states that part. It is not included in chain edges, is included in
  /// closure edges, and must be added to the marginals.
  urban_nav_core::Matrix6d ownNoise(const NodeRef& ref) const;
  /// Sets the name of the camera rig that recorded a session. Calibration constants are common to all sessions of a
  /// rig. Sessions without a name share one rig.
  void setRig(const SessionId& session, const std::string& rig);
  /// Returns the errors of the rigs' constants (RelativePose::constants) in problem()'s edges, for Marginals: for each
  /// constant its uncertainty, and the deviation of the values used by steps from their mean. If several sessions
  /// estimated a constant, the estimate with the smallest standard deviation applies.
  std::vector<CommonError<3>> commonErrors() const;
  /// Returns the weights of problem()'s edges after the last relaxation: 0 for closures that are not accepted.
  std::vector<double> weights() const;

 private:
  class TrackView;  // interface to IncrementalSolver
  std::optional<NodeIndex> findNode(const NodeRef& ref) const;
  /// An unbroken section of a track's chain.
  struct Run {
    std::size_t track = 0, first = 0, last = 0;
    int part = 0;
  };
  std::size_t findRun(const NodeIndex& place) const;
  /// Returns the part of each run as connected by accepted closures, in order of first poses.
  std::vector<int> partNumbers() const;
  urban_nav_core::Matrix6d ownNoise(const NodeIndex& place) const;
  /// The closure's edge; its information is divided by `variance` unless the closure is asserted.
  Edge<3> toEdge(const Closure& closure, const NodeIndex& a, const NodeIndex& b, double variance) const;
  std::vector<ClosureId> accepted() const;
  /// State before a relaxation.
  struct Before {
    std::vector<ClosureId> accepted;
    std::optional<Pose> newest;
  };
  Before before() const { return {accepted(), newest()}; }
  /// Renumbers the parts. Returns the poses whose part changed.
  std::vector<Relaxed::Run> numberParts();
  /// Fills the counts and the correction of the newest pose. `moved`: poses that moved.
  void reportCorrection(Relaxed& made, std::vector<Relaxed::Run> moved, const Before& before, bool levelled = false);
  std::optional<Pose> newest() const;
  Problem<3> problem(double odometry_variance) const;
  /// Poses of all tracks.
  using PoseTable = std::vector<std::vector<Pose>>;
  /// Returns the poses of a batch, followed by odometry since then.
  PoseTable posesAfter(const Batch& batch) const;
  void applyVerdicts(const Batch& batch);
  /// Applies the levelled steps; slipped steps follow the closures.
  void applySteps(const Batch& batch);
  void applyClosureVariance(double variance);
  /// Rotates maps whose upward direction is known; with `stay`, only those that are not level yet. Returns the first
  /// tracks of the maps that were not level before.
  std::vector<std::size_t> level(PoseTable& pose_table, bool stay);
  bool isOfRunning(const std::vector<std::size_t>& maps) const;
  /// Sets the poses. Returns those that moved.
  std::vector<Relaxed::Run> applyPoses(const PoseTable& pose_table);
  /// Tests the closures without a verdict and relaxes with the accepted ones. Returns the poses that moved.
  std::vector<Relaxed::Run> evaluateNew(Relaxed& made);

  Parameters parameters_;
  std::vector<Track> tracks_;
  std::map<SessionId, std::size_t> track_of_;
  std::vector<std::vector<ChainStep>> steps_;  ///< per track: steps_[t][i] leads from pose i to pose i + 1
  /// As steps_, for the store; unused where steps do not join.
  std::vector<std::vector<urban_nav_core::RelativePose>> measured_;
  std::vector<std::string> rigs_;       ///< per track
  std::vector<std::vector<Run>> runs_;  ///< per track, in order
  std::map<ClosureId, Closure> closures_;
  std::map<ClosureId, ClosureEdge> closure_edges_;  ///< per closure, with closure_variance_ applied
  using Name = std::tuple<SessionId, StampNs, SessionId, StampNs, EdgeKind, std::string>;
  static Name makeName(const NodeRef& a, const NodeRef& b, EdgeKind kind, const std::string& source) {
    return {a.session, a.stamp, b.session, b.stamp, kind, source};
  }
  std::map<Name, ClosureId> by_name_;
  std::vector<std::vector<SpecificForce>> forces_;  ///< per track
  std::vector<std::vector<GroundNormal>> ground_;   ///< per track
  std::vector<std::vector<PositionFix>> fixes_;     ///< per track
  FixUse fix_use_;
  std::vector<bool> level_;       ///< per track: whether the map that begins with it is level
  std::vector<Closure> removed_;  ///< accepted closures removed since the last relaxation
  ClosureId next_id_ = 1;
  std::size_t running_ = 0;  ///< index of the track being recorded
  std::int64_t revision_ = 0;
  int parts_ = 0;
  double odometry_variance_ = 1.0, closure_variance_ = 1.0;
  SelectionReport selection_;
  std::vector<Relaxed::Slip> slips_;
  double odometry_lean_ = 0.0;
  std::string ending_warning_;  ///< of the last relaxation
  bool broken_ = false;
  std::any live_;  ///< IncrementalSolver: state of update(); empty if it must be rebuilt
};

/// Returns the information of a chain edge in the convention of Edge, from the part of the step's covariance that
/// accumulates. WARNING: consecutive steps share a pose; covariances composed as if steps were independent are far too
/// large. The remaining part belongs to the ends of closures, see closureInformation().
TangentMatrix<3> chainInformation(const urban_nav_core::RelativePose& step);
/// Returns the covariance of T_a_b, in the convention of stage outputs, due to both poses' own noise
/// (PoseGraph::ownNoise()).
urban_nav_core::Matrix6d relativeNoise(const Pose& T_a_b, const urban_nav_core::Matrix6d& noise_a,
                                       const urban_nav_core::Matrix6d& noise_b);
/// Returns the information of a closure between two poses with own noise.
TangentMatrix<3> closureInformation(const urban_nav_core::Constraint& measured, const urban_nav_core::Matrix6d& noise_a,
                                    const urban_nav_core::Matrix6d& noise_b);

}  // namespace pose_graph
