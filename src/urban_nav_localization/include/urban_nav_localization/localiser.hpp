// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/interval.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_localization/parameters.hpp"

namespace urban_nav_localization {

/// Whether the pose of the robot in a map is known.
enum class LocalizationState {
  Uncertain,  ///< the robot may be in the map: no match, too few of them, or the last one was too long ago
  Localized,  ///< consistent matches determine the pose, and odometry since then is accurate enough
  Unmapped,   ///< surroundings observed, but nothing matches the map
};
/// Returns "UNCERTAIN", "LOCALIZED", "UNMAPPED".
const char* toString(LocalizationState state);

/// Why the state is not Localized. Numbers are part of messages: new ones are appended.
enum class LocalizationReason {
  None = 0,             ///< it is Localized
  NoMatch = 1,          ///< no match with the map yet
  NothingSimilar = 2,   ///< the map was searched, and nothing in it is similar
  InitialPoseOnly = 3,  ///< an initial pose was given, and no match confirms it
  SingleMatch = 4,      ///< no second consistent match
  Contested = 5,        ///< as many matches support another pose
  TooLongAgo = 6,       ///< odometry since the last match is not accurate enough
  NotConfirmed = 7,     ///< the map has keyframes of the estimated place, and they do not match
  OdometryLost = 8,     ///< odometry is lost, or was, and no match since then confirms the pose
};
/// Returns "None", "NoMatch", ...
const char* toString(LocalizationReason reason);

/// Pose in the map and its reliability.
struct LocalizationEstimate {
  urban_nav_core::StampNs stamp = 0;
  LocalizationState state = LocalizationState::Uncertain;
  LocalizationReason reason = LocalizationReason::NoMatch;
  /// The best hypothesis, also while Uncertain; nullopt if there is no hypothesis.
  std::optional<urban_nav_core::PoseWithCovariance> T_map_base;
  int supporting_matches = 0;  ///< consistent matches at different places
  /// Probability that it is the right place of the map, from the matches that support this hypothesis and those of the
  /// best other one; 0 without a hypothesis. The accuracy of the pose is in the covariance.
  double probability = 0.0;
  std::string sentence;  ///< explanation for the user
};

/// Localises a robot in a frozen map from matches between places of the map and poses of its drive, and from odometry
/// in between.
///
/// Matches that agree along odometry form a hypothesis. Localized requires two matches of one hypothesis at places at
/// least half a metre apart, and no other hypothesis with as many: a single false match never moves the robot. A robot
/// that was carried elsewhere is found again: two consecutive consistent matches against all earlier ones end
/// Localized, a third one replaces the hypothesis and drops the earlier matches. A step whose status is Lost is a
/// prediction: it ends Localized until a later match agrees with the hypothesis. Poses of the map are exact to
/// Parameters::map_sigma. Memory is bounded: some thousand steps of odometry. Not thread-safe. Deterministic.
class Localiser {
 public:
  explicit Localiser(const Parameters& parameters);

  /// Appends a step, as OdometryChain does. Returns false if the step is refused.
  bool addOdometry(const urban_nav_core::RelativePose& step);
  /// Adds a match. `measured`: T_a_b from a place of the map, at T_map_a, to the robot at stamp `b`. Directions without
  /// information have no effect. A match with free directions, or one that is not firm, supports hypotheses but starts
  /// none.
  void addMatch(urban_nav_core::StampNs b, const urban_nav_core::Pose& T_map_a,
                const urban_nav_core::Constraint& measured, bool is_firm = true);
  /// Adds an initial pose from the user: the hypothesis until the first match, and where to search first. It is not
  /// evidence: it neither leads to Localized nor changes an estimate.
  void addInitialPose(urban_nav_core::StampNs at, const urban_nav_core::PoseWithCovariance& T_map_base);
  /// Adds a query without a match. `expected`: the map has a keyframe near the estimated pose that should have matched;
  /// three of them in a row end Localized.
  void addMiss(urban_nav_core::StampNs at, bool expected);

  /// Returns the odometry, from the oldest step in memory.
  const urban_nav_core::OdometryChain& odometry() const { return odometry_; }
  /// Returns the distance driven since the last match, m; from the beginning if there was none.
  double distanceSinceMatch() const;

  /// Returns the estimate at the newest frame of odometry.
  LocalizationEstimate now() const;
  /// Returns the estimate at any stamp from all matches so far.
  LocalizationEstimate at(urban_nav_core::StampNs stamp) const;

 private:
  struct MapMatch {
    urban_nav_core::StampNs stamp = 0;
    urban_nav_core::PoseWithCovariance T_map_base;
    bool may_begin = true;  ///< a hypothesis may begin with it
    bool is_match = true;   ///< else an initial pose
  };
  /// Matches that agree with one of them.
  struct Hypothesis {
    std::vector<std::size_t> members;  // ascending in time
    int supporting_matches = 0;        // places of members that are matches, half a metre apart
  };
  bool agree(const MapMatch& one, const MapMatch& other) const;
  Hypothesis around(std::size_t match) const;
  urban_nav_core::PoseWithCovariance fuse(const Hypothesis& hypothesis, urban_nav_core::StampNs stamp) const;
  void add(const MapMatch& match);
  void choose();
  /// Returns the supporting matches of the newest match, if all matches of the best hypothesis are older than those.
  int against() const;
  void forgetOldSteps();
  /// Returns whether odometry was lost during a part of (after, until].
  bool isLost(urban_nav_core::StampNs after, urban_nav_core::StampNs until) const;
  /// Returns whether odometry is lost at a stamp, or between it and every match of the best hypothesis.
  bool isUnconfirmedPrediction(urban_nav_core::StampNs stamp) const;

  Parameters parameters_;
  std::vector<urban_nav_core::RelativePose> steps_;  // of odometry_
  std::vector<urban_nav_core::Interval> lost_;       // steps of odometry_ whose status is Lost, in order of time
  urban_nav_core::OdometryChain odometry_;
  std::vector<MapMatch> matches_;  // the latest, in order of time
  int misses_ = 0;                 // consecutive queries without a match
  int unconfirmed_ = 0;            // misses at the place of the best hypothesis since its last match
  Hypothesis best_, second_;
};

}  // namespace urban_nav_localization
