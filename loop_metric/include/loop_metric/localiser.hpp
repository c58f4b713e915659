// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "loop_metric/parameters.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace loop_metric {

/// Does the robot know where in a map it is?
enum class Knowledge {
  Unsure,  ///< it may be in the map: nothing says where, what says so has no second witness, or it was too long ago
  Known,   ///< witnesses that agree say where, and odometry since then is good enough
  New,     ///< it looks around and knows nothing of what it sees
};
/// "UNSURE", "KNOWN", "NEW".
const char* toString(Knowledge knowledge);

/// Why the robot is not KNOWN. Numbers are part of messages: new ones go to the end.
enum class LocatedReason {
  None = 0,          ///< it is
  NothingSeen = 1,   ///< nothing of the map was recognised yet
  NothingAlike = 2,  ///< it was looked for, and nothing here looks like the map
  BeliefAlone = 3,   ///< somebody says so, and nothing was seen of it
  OneSighting = 4,   ///< and no second one that agrees
  Contested = 5,     ///< as many sightings say that it is elsewhere
  TooLongAgo = 6,    ///< odometry since the last sighting is not good enough
  NotSeenAgain = 7,  ///< the map has views of where it should be, and what it sees is something else
};
/// "None", "NothingSeen", ...
const char* toString(LocatedReason reason);

/// Where the robot is, and how that is known.
struct Located {
  urban_nav_core::StampNs stamp = 0;
  Knowledge knowledge = Knowledge::Unsure;
  LocatedReason reason = LocatedReason::NothingSeen;
  /// The best guess there is, UNSURE ones too; empty where there is none.
  std::optional<urban_nav_core::PoseWithCovariance> T_map_base;
  int witnesses = 0;  ///< sightings that agree with it
  /// That it is the right place of the map, in the light of the sightings that agree and of those of the best other guess; 0 without a guess. It says nothing of how
  /// well the pose is known: the covariance does.
  double probability = 0.0;
  std::string sentence;  ///< for a person
};

/// Finds a robot in a map that stays as it is: from closures between a place of the map and a moment of its drive, and from odometry in between.
///
/// Sightings that agree with each other along odometry are one hypothesis. KNOWN takes two of one hypothesis at places half a metre apart or more, and none that has as many
/// witnesses beside it: one false sighting never moves the robot. A robot that was carried elsewhere is found again: two sightings in a row that agree against all before them end KNOWN,
/// a third one makes them the truth, and what was seen before them is forgotten. The map's own poses are taken as exact to Parameters::map_sigma. Memory is bounded: what lies
/// more than some thousand steps of odometry back is forgotten. Not thread-safe. The same calls give the same bits.
class Localiser {
 public:
  explicit Localiser(const Parameters& parameters);

  /// Steps in order, as OdometryChain has them.
  bool addOdometry(const urban_nav_core::RelativePose& step);
  /// `measured`: T_a_b from a place of the map, at T_map_a, to the robot at `b`. Directions without information count for nothing; a closure that leaves
  /// some free, or is not firm, is a witness, but no hypothesis begins with it.
  void addSighting(urban_nav_core::StampNs b, const urban_nav_core::Pose& T_map_a,
                   const urban_nav_core::Constraint& measured, bool is_firm = true);
  /// What somebody believes (initialpose): the best guess until something is seen, and where to look first. It is no evidence: it makes nothing KNOWN, and adds nothing to
  /// the pose.
  void addBelief(urban_nav_core::StampNs at, const urban_nav_core::PoseWithCovariance& T_map_base);
  /// At this moment the robot looked for the place in the map and found nothing like it. `expected`: the map has a view of where it believes to be that it should have
  /// recognised; three of them in a row end KNOWN.
  void addNothing(urban_nav_core::StampNs at, bool expected);

  /// What odometry is known, from the oldest step that is not forgotten.
  const urban_nav_core::OdometryChain& odometry() const { return odometry_; }
  /// m driven since the robot was seen last; without any sighting, from the beginning.
  double unseen() const;

  /// At the newest frame of odometry.
  Located now() const;
  /// At any moment, with what is known by now.
  Located at(urban_nav_core::StampNs stamp) const;

 private:
  struct Sighting {
    urban_nav_core::StampNs stamp = 0;
    urban_nav_core::PoseWithCovariance T_map_base;
    bool begins = true;  ///< a hypothesis may begin with it
    bool sees = true;    ///< else somebody's belief
  };
  /// Sightings that agree with one of them, and what they say together.
  struct Hypothesis {
    std::vector<std::size_t> members;  // ascending in time
    int witnesses = 0;                 // places of members that see, half a metre apart
  };
  bool agree(const Sighting& one, const Sighting& other) const;
  Hypothesis around(std::size_t sighting) const;
  urban_nav_core::PoseWithCovariance fuse(const Hypothesis& hypothesis, urban_nav_core::StampNs stamp) const;
  void add(const Sighting& sighting);
  void choose();
  /// Witnesses of the newest sighting's hypothesis, where all of the best one's saw before them.
  int against() const;
  void forgetOldSteps();

  Parameters parameters_;
  std::vector<urban_nav_core::RelativePose> steps_;  // of odometry_
  urban_nav_core::OdometryChain odometry_;
  std::vector<Sighting> sightings_;  // the latest, in order of time
  int nothing_ = 0;                  // looks in a row that showed nothing
  int missed_ = 0;                   // looks that should have shown the best hypothesis' place, since the last that did
  Hypothesis best_, second_;
};

}  // namespace loop_metric
