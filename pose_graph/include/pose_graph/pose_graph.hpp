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

/// Why the graph is not OK: Status::reason of this stage.
enum class Trouble : int {
  None = 0,
  BrokenChain,  ///< a relative pose does not begin where the last one ended: what follows is a part of its own
  Separate,     ///< sessions, or parts of one, that no accepted closure joins
  Waiting,      ///< a closure waits for a second one that agrees
  NotStored,    ///< live: what is taken in does not reach the store
  Undecided,    ///< no set of closures is likelier than chance: the map is that of odometry
  Guess,        ///< another set of closures is nearly as likely, or the graph is too large to weigh any
  Slipped,      ///< closures contradict a step of odometry
  Unconverged,  ///< the last relaxation ended before it reached the minimum
};
const char* toString(Trouble trouble);

/// Why the newest pose jumped: the reason on graph/correction.
enum class CorrectionReason : int {
  None = 0,
  ClosuresAccepted,  ///< newly accepted closures: the causing edges
  ClosureAsserted,   ///< the same, and one of them was asserted by hand
  ClosuresRejected,  ///< closures that were accepted before: the causing edges
  ClosuresRemoved,   ///< accepted closures removed by hand: the causing edges
  Refined,           ///< none of these: relaxed from the measurements alone, the graph lies elsewhere
  Levelled,          ///< which way is up is known now: the map was turned about its first pose
};
const char* toString(CorrectionReason reason);

/// A closure, as offered and as judged.
struct Closure {
  ClosureId id = 0;
  NodeRef a, b;
  EdgeKind kind = EdgeKind::Stereo;  ///< not Odometry
  std::string source;
  urban_nav_core::Constraint measured;  ///< T_a_b
  bool odometry_gate = false;           ///< its stage found that odometry allows it
  bool by_hand = false;                 ///< a person vouches for it: never weighted down, as an asserted one
  // From here on: what the last relaxation made of it.
  bool judged = false;
  double weight = 0.0;
  ClosureVerdict verdict = ClosureVerdict::Waiting;
  std::string reason;
  double chi2 = 0.0;                       ///< against all other accepted edges
  std::vector<ClosureId> contradicted_by;  ///< of an asserted one: what cannot be true beside it, the worst first
};

inline bool isVouchedFor(const Closure& closure) { return closure.kind == EdgeKind::Asserted || closure.by_hand; }

/// One session of the trajectory.
struct Track {
  SessionId session;
  std::vector<StampNs> stamps;  ///< ascending
  std::vector<Pose> odom;       ///< T_odom_base: by odometry alone, from the first pose
  std::vector<Pose> map;        ///< T_map_base; equal to `odom` while no closure says otherwise
  std::vector<int> part;        ///< of each pose, which map it lies in: 0 is that of the first session's first pose
};

/// What one relaxation did.
struct Relaxed {
  std::int64_t revision = 0;
  std::size_t poses = 0, edges = 0, closures = 0, accepted = 0, rejected = 0, waiting = 0;
  int parts = 0;            ///< maps that nothing joins
  int sessions_joined = 0;  ///< sessions whose newest pose lies in map 0
  double cost_before = 0.0, cost_after = 0.0;
  std::vector<Iteration> iterations;
  Ending ending = Ending::Converged;
  double gradient = 0.0;  ///< as Solution::gradient
  /// Poses that moved by more than 1 cm or 0.02 deg, as runs [first, last] of a track's numbers.
  struct Run {
    std::size_t track = 0, first = 0, last = 0;
  };
  std::vector<Run> moved;
  /// How the newest pose of the running session jumped, if by more than that: for graph/correction.
  struct Correction {
    NodeRef at;
    Pose before, after;  ///< T_map_base
    double distance = 0.0, angle = 0.0;
    CorrectionReason reason = CorrectionReason::None;
    std::string sentence;
    std::vector<Closure> causing_edges;  ///< as the reason has it
  };
  std::optional<Correction> correction;
  bool needs_batch = false;   ///< update() verified closures one by one: only relax() weighs sets of them
  SelectionReport selection;  ///< of the last batch
  /// A step of odometry that all closures contradict: it counts next to nothing, and follows the closures.
  struct Slip {
    NodeRef from, to;
  };
  std::vector<Slip> slips;  ///< of the last batch
};

/// "odometry slipped between kitchen at 12.3 s and ...".
std::string toSentence(const Relaxed::Slip& slip);

/// A batch relaxation of a graph as it stood: PoseGraph::batch() makes it, run() does the work, which may be in another
/// thread while the graph grows, and PoseGraph::take() lays the graph as it says.
struct Batch {
  Parameters parameters;
  Problem<3> problem;  ///< as PoseGraph::problem(), odometry as it was measured; levelled, with covariances as found,
                       ///< when it has run
  std::vector<std::vector<StampNs>> stamps;        ///< of each track
  std::vector<std::vector<SpecificForce>> forces;  ///< of each track; who knows more than the graph may put it in
  std::vector<std::vector<PositionFix>> fixes;     ///< of each track, likewise
  std::map<ClosureId, Closure> closures;           ///< judged when it has run
  Solution<3> solution;
  SelectionReport selection;
  std::vector<int> slipped;  ///< edges of the problem
  double odometry_variance = 1.0;
  double odometry_lean = 0.0;
  FixUse fix_use;
};
/// Deterministic. A batch that SolveOptions::progress has ended must not be taken. Throws UserError if
/// Parameters::solver is neither the stage's own nor one of `references`.
void run(Batch& batch, const SolveOptions& options = {}, const ReferenceSolvers& references = {});

/// The pose graph of many sessions: chains of relative poses, pinched together by closures (Newman et al. 2009,
/// sections 5 and 7). Sessions are joined by nothing but closures: two that agree fuse them, with no alignment by hand.
///
/// Not thread-safe. The same calls give the same bits, whatever the number of threads.
class PoseGraph {
 public:
  /// `revision`: to count on from, where this graph takes the place of another.
  explicit PoseGraph(const Parameters& parameters, std::int64_t revision = 0);

  /// A session begins; UserError where it has begun already.
  void beginSession(const SessionId& session);
  bool hasSession(const SessionId& session) const;
  /// The session that is being recorded, whose corrections are reported: the one that began last, unless it is said
  /// here.
  void goOn(const SessionId& session);

  /// The next step of a session's chain. The first one makes two poses. A step that does not begin at the session's
  /// newest pose breaks the chain (Trouble::BrokenChain); one that is not later than it, or not finite, is left out:
  /// false.
  bool addOdometry(const SessionId& session, const urban_nav_core::RelativePose& step);

  /// UserError where a pose does not exist (with the nearest one that does), where numbers are not finite or the
  /// information has a negative eigenvalue. An edge with the same poses, kind and source is replaced. Judged by the
  /// next relax().
  ClosureId addClosure(const Closure& offered);
  /// False where there is none.
  bool removeClosure(ClosureId id);
  std::optional<ClosureId> findClosure(const NodeRef& a, const NodeRef& b, EdgeKind kind,
                                       const std::string& source) const;

  /// Specific forces at poses of a session, in order of time; from the first of them on it takes the place of what is
  /// known. Batches level by it: a map of which one of the sessions knows which way is up has z up, and origin and
  /// heading of its first pose.
  void putForces(const SessionId& session, const std::vector<SpecificForce>& forces);
  const std::vector<SpecificForce>& forces(std::size_t track) const { return forces_[track]; }
  /// Adds normals of the ground at poses of a session, in order of time; those that are not later than the newest known
  /// one are left out. They level maps of which no session knows the direction of gravity from an accelerometer.
  void putGround(const SessionId& session, const std::vector<GroundNormal>& normals);
  const std::vector<GroundNormal>& ground(std::size_t track) const { return ground_[track]; }
  /// Adds positions that satellites measured during a session, in order of time; those that are not later than the
  /// newest known one are left out. With Parameters::gps batches use them.
  void putFixes(const SessionId& session, const std::vector<PositionFix>& fixes);
  const std::vector<PositionFix>& fixes(std::size_t track) const { return fixes_[track]; }
  /// What the last batch made of the fixes.
  const FixUse& fixUse() const { return fix_use_; }
  /// Levels what is not level yet where that is known by now, and tells of it as relax() does.
  std::optional<Relaxed> level();
  /// Whether the map that a session lies in is level.
  bool isLevel(const SessionId& session) const;

  /// Relaxes all there is, from the measurements alone: what was relaxed before leaves no trace. Deterministic.
  /// Throws as run().
  Relaxed relax(const SolveOptions& options = {}, const ReferenceSolvers& references = {});
  /// The same in three steps. What the graph took in since batch() follows what was there; closures that are new, or
  /// were measured anew, are judged as by update(). Not of another graph.
  Batch batch() const;
  Relaxed take(const Batch& batch);
  /// The same from where the graph stands, for some closures more: each is accepted if it raises the cost by no more
  /// than chance and noise explain (its innovation, chi-square at 99.9 %), verdicts given earlier stay. Faster by far,
  /// and provisional: where a closure was accepted or disagrees, `needs_batch` asks for relax(), which weighs sets of
  /// closures against each other and may find any of them wrong.
  Relaxed update();

  const std::vector<Track>& tracks() const { return tracks_; }
  const Track* track(const SessionId& session) const;
  /// The step that leads to a pose of a track, as it was measured; null at the first one, and after a gap.
  const urban_nav_core::RelativePose* stepTo(std::size_t track, std::size_t pose) const;
  const std::map<ClosureId, Closure>& closures() const { return closures_; }
  std::int64_t revision() const { return revision_; }
  urban_nav_core::Status status() const;

  /// The graph as a problem: poses of the tracks one after another, edges: the chains, then the closures in the order
  /// of ids.
  Problem<3> problem() const;
  /// Number of a pose in problem().
  std::optional<int> poseNumber(const NodeRef& ref) const;
  /// By what the covariances of odometry were multiplied in the last relax(), in problem() too: 1, or more where the
  /// closures show that it promises more than it keeps: at most 9, unless the selection found more the likelier.
  double odometryVariance() const { return odometry_variance_; }
  /// The last batch's selection among the closures.
  const SelectionReport& selection() const { return selection_; }
  /// How far a pose of odometry leant at most against its first one, rad, as the accelerometer says: taken out in the
  /// last relax().
  double odometryLean() const { return odometry_lean_; }
  /// The covariance of a pose's own settled noise, in its own axes: half that of its step, where the step tells which
  /// part of it adds up along the way. It is in no edge of the chain, in the closures' edges, and has to be added to
  /// what Marginals tell.
  urban_nav_core::Matrix6d ownNoise(const NodeRef& ref) const;
  /// Names the rig of cameras that recorded a session. Constants of one rig are the same in all its sessions. Sessions
  /// without a name share one rig.
  void setRig(const SessionId& session, const std::string& rig);
  /// Returns the errors of the rigs' constants (RelativePose::constants) in problem()'s edges, for Marginals: for each
  /// constant its uncertainty, and the known deviation of the values that steps used from its mean. If several sessions
  /// have estimated a constant, the estimate with the smallest standard deviation applies.
  std::vector<CommonError<3>> commonErrors() const;
  /// Weights of problem()'s edges after the last relaxation: 0 for closures that are not accepted.
  std::vector<double> weights() const;

 private:
  class TrackView;  // what IncrementalSolver reads and writes
  std::optional<NodeIndex> findNode(const NodeRef& ref) const;
  /// An unbroken piece of a track's chain.
  struct Run {
    std::size_t track = 0, first = 0, last = 0;
    int part = 0;
  };
  std::size_t findRun(const NodeIndex& place) const;
  /// Which part each run is in, by accepted closures: numbered by their first poses.
  std::vector<int> partNumbers() const;
  urban_nav_core::Matrix6d ownNoise(const NodeIndex& place) const;
  /// Its information divided by `variance`, unless it is asserted.
  Edge<3> toEdge(const Closure& closure, const NodeIndex& a, const NodeIndex& b, double variance) const;
  std::vector<ClosureId> accepted() const;
  /// How things stand before a relaxation.
  struct Before {
    std::vector<ClosureId> accepted;
    std::optional<Pose> newest;
  };
  Before before() const { return {accepted(), newest()}; }
  /// Numbers the parts anew: the poses whose number is another one.
  std::vector<Relaxed::Run> numberParts();
  /// Counts, and says how the newest pose jumped. `moved`: poses that did.
  void tell(Relaxed& made, std::vector<Relaxed::Run> moved, const Before& before, bool levelled = false);
  std::optional<Pose> newest() const;
  Problem<3> problem(double odometry_variance) const;
  /// Poses of all tracks as they are laid.
  using Laid = std::vector<std::vector<Pose>>;
  /// Where each batch pose goes, and what has come since after them.
  Laid laidBy(const Batch& batch) const;
  void takeVerdicts(const Batch& batch);
  /// Steps as they were levelled; those that slipped follow the closures.
  void takeSteps(const Batch& batch);
  void takeClosureVariance(double variance);
  /// Turns the maps of which it is known which way is up, but those that are level already if they are to `stay`. The
  /// maps, by their first tracks, that were not level before.
  std::vector<std::size_t> level(Laid& laid, bool stay);
  bool isOfRunning(const std::vector<std::size_t>& maps) const;
  /// The poses that moved by it.
  std::vector<Relaxed::Run> lay(const Laid& laid);
  /// Judges the closures that are not judged yet, and relaxes with those that are believed: the poses that moved.
  std::vector<Relaxed::Run> judgeNew(Relaxed& made);

  Parameters parameters_;
  std::vector<Track> tracks_;
  std::map<SessionId, std::size_t> track_of_;
  std::vector<std::vector<ChainStep>> steps_;  ///< of each track: steps_[t][i] leads from pose i to pose i + 1
  /// As steps_, for the store; those that do not join are nothing.
  std::vector<std::vector<urban_nav_core::RelativePose>> measured_;
  std::vector<std::string> rigs_;       ///< of each track
  std::vector<std::vector<Run>> runs_;  ///< of each track, in order
  std::map<ClosureId, Closure> closures_;
  std::map<ClosureId, ClosureEdge> closure_edges_;  ///< of each closure, with closure_variance_
  using Name = std::tuple<SessionId, StampNs, SessionId, StampNs, EdgeKind, std::string>;
  static Name makeName(const NodeRef& a, const NodeRef& b, EdgeKind kind, const std::string& source) {
    return {a.session, a.stamp, b.session, b.stamp, kind, source};
  }
  std::map<Name, ClosureId> by_name_;
  std::vector<std::vector<SpecificForce>> forces_;  ///< of each track
  std::vector<std::vector<GroundNormal>> ground_;   ///< of each track
  std::vector<std::vector<PositionFix>> fixes_;     ///< of each track
  FixUse fix_use_;
  std::vector<bool> level_;       ///< of each track: whether the map that begins with it is
  std::vector<Closure> removed_;  ///< since the last relaxation, of those that were accepted
  ClosureId next_id_ = 1;
  std::size_t running_ = 0;  ///< number of the track that is being recorded
  std::int64_t revision_ = 0;
  int parts_ = 0;
  double odometry_variance_ = 1.0, closure_variance_ = 1.0;
  SelectionReport selection_;
  std::vector<Relaxed::Slip> slips_;
  double odometry_lean_ = 0.0;
  std::string ending_warning_;  ///< of the last relaxation
  bool broken_ = false;
  std::any live_;  ///< IncrementalSolver: what update() goes on from; empty where that is not known
};

/// The information of a chain's edge for relaxation, in the convention of Edge: of the part of the step's covariance
/// that adds up from step to step. WARNING: neighbouring steps share an end, so their covariances composed as if
/// independent are far too large; what is left over belongs to the ends of closures, see closureInformation.
TangentMatrix<3> chainInformation(const urban_nav_core::RelativePose& step);
/// The covariance of T_a_b (as what leaves a stage) that comes from both poses' own noise: PoseGraph::ownNoise().
urban_nav_core::Matrix6d relativeNoise(const Pose& T_a_b, const urban_nav_core::Matrix6d& noise_a,
                                       const urban_nav_core::Matrix6d& noise_b);
/// The information of a closure between two poses that have noise of their own.
TangentMatrix<3> closureInformation(const urban_nav_core::Constraint& measured, const urban_nav_core::Matrix6d& noise_a,
                                    const urban_nav_core::Matrix6d& noise_b);

}  // namespace pose_graph
