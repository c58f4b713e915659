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

/// Reason for a rejected candidate. Values are stored: append new ones at the end.
enum class LoopReason {
  None = 0,           ///< accepted
  UnknownMoment = 1,  ///< one of the poses is outside its session, or the session is unknown
  NothingKept = 2,    ///< neither keyframes nor clouds are stored for one of the poses
  NotRegistered = 3,  ///< neither keyframes nor clouds gave a transform
  Odometry = 4,       ///< the transform is inconsistent with odometry
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
  std::vector<StereoAttempt> stereo;  ///< in order of execution; the last one is the accepted one, if any
  std::optional<urban_nav_registration::Alignment> icp;    ///< if clouds were aligned: source b, target a
  urban_nav_core::Pose icp_guess;                          ///< initial T_a_b of the alignment
  std::vector<urban_nav_registration::ClosureTest> tests;  ///< tests of the transform against odometry
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
/// Requires that both poses have the same camera. Any failure is a verdict with a sentence; only exceptions of
/// PlaceData are passed on. Stateless: the same candidate with the same data gives bit-identical results. Not
/// thread-safe; different objects are independent.
class LoopMetric {
 public:
  LoopMetric(const Parameters& parameters, const urban_nav_core::StereoCamera& camera,
             const urban_nav_core::Pose& T_base_left);

  CandidateMeasurement measure(const urban_nav_core::TopologicalClosure& candidate, const PlaceData& place_data);

 private:
  friend class Measuring;  // measurement of one candidate
  const urban_nav_registration::StereoClosure& match(const NearbyKeyframe& a, const NearbyKeyframe& b,
                                                     const PlaceData& place_data);

  Parameters parameters_;
  urban_nav_core::Pose T_base_left_;
  urban_nav_registration::StereoMatcher matcher_;
  std::list<StereoAttempt> matched_;  // most recent ones: candidates half a second apart use the same keyframes
};

}  // namespace loop_metric
