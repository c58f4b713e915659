// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_trust/consistency_test.hpp"
#include "urban_nav_trust/parameters.hpp"

namespace urban_nav_trust {

/// Whether the robot is where the map shows.
enum class TrustState {
  Known,   ///< independent measurements were compared and agree; the probabilities hold
  New,     ///< in a map of its own, which nothing ties to the first one
  Unsure,  ///< a test fails, or nothing could be compared
  Lost     ///< odometry is lost: the position is a prediction
};
/// "KNOWN", "NEW", "UNSURE", "LOST".
const char* toString(TrustState state);

/// Radii of the stated probabilities, m.
constexpr std::array<double, 3> kRadii = {0.1, 0.5, 2.0};

/// A frame before the tests are applied.
struct FrameEvidence {
  urban_nav_core::StampNs stamp = 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< position in the map, m^2
  double travelled = 0.0;                                ///< m along the path from its begin
  bool is_lost = false;                                  ///< status of odometry
  bool is_joined = true;                                 ///< part of the first map
};

struct FrameTrust {
  urban_nav_core::StampNs stamp = 0;
  TrustState state = TrustState::Unsure;
  std::array<double, 3> probabilities{};  ///< that the position is within kRadii
  std::string tests;                      ///< names of the tests that fail here, separated by blanks
};

/// Results of all tests of a map.
struct TestResults {
  std::vector<ConsistencyTest> tests;
  std::vector<AbsentMeasurement> absent;
  std::vector<ConstantSegment> segments;
};

/// Returns whether a test fails: its p-value is below `false_alarm`.
bool hasFailed(const ConsistencyTest& test, const Parameters& parameters);

/// A test that fails where a frame is.
struct Failure {
  std::string test;
  double distance = 0.0;  ///< m travelled in the interval of the test
};
/// Returns whether a test compares two sensors: one of a sensor with itself confirms no map.
bool comparesSensors(const ConsistencyTest& test);
bool comparesSensors(const TestResults& results);
/// Returns the trust in a frame. `is_compared`: at least one test compared two sensors. Each failure widens the
/// covariance by Parameters::unexplained_drift of its distance.
FrameTrust assessFrame(const FrameEvidence& frame, const std::vector<Failure>& failures, bool is_compared,
                       const Parameters& parameters);

/// Returns the trust in each frame of a session. `frames`: in order of time. `spreads`: closures tie the path after a
/// failure to the path before it, so that it affects every frame; otherwise it affects those from its begin on.
std::vector<FrameTrust> assessFrames(const std::vector<FrameEvidence>& frames, const TestResults& results, bool spreads,
                                     const Parameters& parameters);

/// Trust in the map as a whole.
struct MapTrust {
  TrustState state = TrustState::Unsure;
  std::array<double, 3> probabilities{};  ///< means over the frames
  std::string reason;                     ///< why it is not KNOWN; empty: it is
};
MapTrust assessMap(const std::vector<FrameTrust>& frames, const TestResults& results, const Parameters& parameters);

}  // namespace urban_nav_trust
