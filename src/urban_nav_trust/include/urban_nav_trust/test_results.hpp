// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_trust/consistency_test.hpp"
#include "urban_nav_trust/covariance_scale.hpp"

namespace urban_nav_trust {

/// Results of all tests of a session or of a map.
struct TestResults {
  std::vector<ConsistencyTest> tests;
  std::vector<AbsentMeasurement> absent;
  std::vector<ConstantSegment> segments;
  ScaleEvidence turns, lengths;  ///< on odometry's covariance, from independent measurements of turns and of lengths
};

/// Components of the motion confirmed by independent measurements.
struct Confirmation {
  bool any = false;                     ///< at least one test compared two sensors
  bool turns = false, lengths = false;  ///< at least one test compared this component with another sensor
  ScaleWeights scales{};                ///< probabilities of covarianceScales()
  bool isComplete() const { return turns && lengths; }
};
/// Returns the confirmation. `disparity_offset` and `reprojection_error` compare a stereo pair with itself and confirm
/// nothing.
Confirmation confirm(const TestResults& results);

/// Returns why a confirmation is incomplete: the component that was not compared, and the tests that could have done so
/// with the reasons of their absence. Empty: it is complete.
std::string missingSentence(const Confirmation& confirmation, const TestResults& results);

}  // namespace urban_nav_trust
