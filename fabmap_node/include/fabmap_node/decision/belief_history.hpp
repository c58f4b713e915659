// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "fabmap_node/decision/place_belief.hpp"

namespace fabmap_node {

/// Closure with the verdict of geometry.
struct VerifiedClosure {
  urban_nav_core::PoseRef a, b;
  double travelled_a = 0.0, travelled_b = 0.0;  ///< to both poses in their sessions, m
  PlaceVerdict verdict = PlaceVerdict::Rejected;
};

/// Beliefs of one session by appearance, and with the verdicts of geometry on its closures.
///
/// A verdict multiplies the odds of its place by a likelihood ratio (place_verdict.hpp). It also counts for other
/// observations: after the same distance along both paths, the robot shows the same place as long as it follows the
/// earlier path. Closures near each other succeed or fail together, since they compare nearly the same surroundings: of
/// the verdicts on a place only the strongest one in favour and the strongest one against count. Not thread-safe.
class BeliefHistory {
 public:
  explicit BeliefHistory(const Parameters& parameters) : parameters_(parameters) {}

  /// Adds a belief by appearance; stamps and distances must ascend. Returns it with the verdicts so far.
  PlaceBelief add(PlaceBelief belief);
  /// Adds a verdict, which replaces earlier ones on the same poses, except that those of the pose graph are only
  /// replaced by its own. `b` must be of the session of the beliefs. Returns the belief at `b`, or at the observation
  /// nearest to it, and those whose knowledge changes, in order of time, all with the verdicts; beliefs of a robot at
  /// rest only as that of its first observation.
  std::vector<PlaceBelief> addVerdict(const VerifiedClosure& closure);
  /// Returns a belief of the session by appearance with the verdicts.
  PlaceBelief withVerdicts(PlaceBelief belief) const;
  /// Removes all beliefs and verdicts.
  void clear();

 private:
  void applyVerdicts(const PlaceBelief& belief, LikelyPlace& place) const;

  Parameters parameters_;
  std::vector<PlaceBelief> by_appearance_;  // except those of a robot at rest
  std::map<std::pair<urban_nav_core::PoseRef, urban_nav_core::PoseRef>, VerifiedClosure> closures_;
  std::multimap<double, const VerifiedClosure*> along_path_;  // elements of closures_ by travelled_b
};

}  // namespace fabmap_node
