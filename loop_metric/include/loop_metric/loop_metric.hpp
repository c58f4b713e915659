// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <string>
#include <vector>

#include "loop_metric/align.hpp"
#include "loop_metric/parameters.hpp"
#include "loop_metric/stereo_closure.hpp"
#include "loop_metric/surroundings.hpp"
#include "urban_nav_core/types/closure.hpp"

namespace loop_metric {

/// Why a candidate has no transform. Numbers are kept in stores: new ones go to the end.
enum class LoopReason {
  None = 0,           ///< accepted
  UnknownMoment = 1,  ///< one of the moments is outside of its session, or the session is not here
  NothingKept = 2,    ///< neither views nor clouds of one of the moments
  NotRegistered = 3,  ///< neither views nor clouds gave a transform
  Odometry = 4,       ///< odometry does not allow the transform
  Contradicted = 5,   ///< closures beside it say something else
  OtherPlace = 6,     ///< the transform is right, and says that the moments are too far apart to be one place
};
/// "", "unknown_moment", "nothing_kept", "not_registered", "odometry", "contradicted", "other_place".
const char* toString(LoopReason reason);

/// One try to register two views.
struct StereoTry {
  NearbyView view_a, view_b;
  StereoClosure result;
};

/// What came of a candidate: the closure for the graph, and all that its verdict rests on.
struct LoopClosure {
  /// `evidence` is printEvidence() of this (evidence.hpp).
  urban_nav_core::MetricClosure metric;
  std::vector<StereoTry> stereo;   ///< in the order in which they were made; the last is the accepted one, if any is
  std::optional<Alignment> icp;    ///< where clouds were aligned: source b, target a
  urban_nav_core::Pose icp_guess;  ///< T_a_b from which it began
  std::vector<ClosureTest> tests;  ///< of the transform against odometry
};

/// From a topological closure to T_a_b with what it knows (Newman et al. 2009, section 4): by stereo where two views of the place can be registered (4.1), by
/// the clouds of the lasers around both moments where they cannot (4.2: opposite direction of travel); then held against the odometry
/// between the moments.
///
/// Cameras of both moments must be the same. Failure of any kind is a verdict with a sentence, never an exception, but for what Surroundings throws.
/// The same candidate in the same surroundings gives the same bits, whatever came before. Not thread-safe; objects are independent.
class LoopMetric {
 public:
  LoopMetric(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
             const urban_nav_core::Pose& T_base_left);

  LoopClosure measure(const urban_nav_core::TopologicalClosure& candidate, const Surroundings& surroundings);

 private:
  friend class Measuring;  // one candidate on its way to a verdict
  const StereoClosure& match(const NearbyView& a, const NearbyView& b, const Surroundings& surroundings);

  Parameters parameters_;
  urban_nav_core::Pose T_base_left_;
  StereoMatcher matcher_;
  std::list<StereoTry> matched_;  // the last ones: candidates half a second apart choose the same views
};

}  // namespace loop_metric
