// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <list>
#include <string>
#include <vector>

#include "loop_metric/parameters.hpp"
#include "loop_metric/place/place_data.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_registration/icp/align.hpp"
#include "urban_nav_registration/stereo/stereo_closure.hpp"

namespace loop_metric {

/// Reason why a candidate has no transform. Numbers are stored: new ones are appended.
enum class LoopReason {
  None = 0,           ///< accepted
  UnknownMoment = 1,  ///< one of the poses is outside its session, or the session is unknown
  NothingKept = 2,    ///< neither keyframes nor clouds of one of the poses
  NotRegistered = 3,  ///< neither keyframes nor clouds gave a transform
  Odometry = 4,       ///< odometry does not allow the transform
  Contradicted = 5,   ///< neighbouring closures contradict it
  OtherPlace = 6,     ///< the transform is valid, but the poses are too far apart for one place
};
/// "", "unknown_moment", "nothing_kept", "not_registered", "odometry", "contradicted", "other_place".
const char* toString(LoopReason reason);

/// One attempt to register two keyframes.
struct StereoAttempt {
  NearbyKeyframe keyframe_a, keyframe_b;
  urban_nav_registration::StereoClosure result;
};

/// Attempts to register the views and clouds of a candidate: the data of its verdict.
struct RegistrationAttempts {
  std::vector<StereoAttempt> stereo;  ///< in the order in which they were made; the last is the accepted one, if any is
  std::optional<urban_nav_registration::Alignment> icp;    ///< where clouds were aligned: source b, target a
  urban_nav_core::Pose icp_guess;                          ///< T_a_b from which the alignment began
  std::vector<urban_nav_registration::ClosureTest> tests;  ///< of the transform against odometry
};

/// Result of LoopMetric::measure(). `metric.evidence` is printEvidence() of both (evidence.hpp).
struct CandidateMeasurement {
  urban_nav_core::MetricClosure metric;
  RegistrationAttempts attempts;
};

/// Measures topological closures: T_a_b with its information (Newman et al. 2009, section 4), by stereo if two
/// keyframes of the place can be registered (4.1), otherwise by the clouds of the lasers around both poses (4.2:
/// opposite direction of travel). The result is compared with the odometry between the poses.
///
/// Requires that both poses have the same camera. Failure of any kind is a verdict with a sentence; only exceptions of
/// PlaceData pass through. The same candidate with the same data gives the same bits, whatever came before. Not thread-
/// safe; objects are independent.
class LoopMetric {
 public:
  LoopMetric(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
             const urban_nav_core::Pose& T_base_left);

  CandidateMeasurement measure(const urban_nav_core::TopologicalClosure& candidate, const PlaceData& place_data);

 private:
  friend class Measuring;  // one candidate on its way to a verdict
  const urban_nav_registration::StereoClosure& match(const NearbyKeyframe& a, const NearbyKeyframe& b,
                                                     const PlaceData& place_data);

  Parameters parameters_;
  urban_nav_core::Pose T_base_left_;
  urban_nav_registration::StereoMatcher matcher_;
  std::list<StereoAttempt> matched_;  // the last ones: candidates half a second apart choose the same views
};

}  // namespace loop_metric
