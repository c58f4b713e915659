// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_trust/consistency_test.hpp"
#include "urban_nav_trust/parameters.hpp"
#include "urban_nav_trust/test_results.hpp"

namespace urban_nav_trust {

/// Whether the robot's position in the map is reliable.
enum class TrustState {
  Known,   ///< independent measurements of turns and of lengths were compared and agree
  New,     ///< in a separate map that is not connected to the first one
  Unsure,  ///< a test fails, or turns or lengths could not be compared
  Lost     ///< odometry is lost: the position is predicted
};
/// Returns "KNOWN", "NEW", "UNSURE" or "LOST".
const char* toString(TrustState state);

/// Radii of the stated probabilities, m.
constexpr std::array<double, 3> kRadii = {0.1, 0.5, 2.0};

/// State of a frame before the tests are applied.
struct FrameEvidence {
  urban_nav_core::StampNs stamp = 0;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of the position in the map, as stated by odometry and
                                                         ///< graph, m^2
  double travelled = 0.0;                                ///< m along the path from its beginning
  bool is_lost = false;                                  ///< status of odometry
  bool is_joined = true;                                 ///< part of the first map
};
/// State and tests of one frame.
struct FrameTrust {
  urban_nav_core::StampNs stamp = 0;
  TrustState state = TrustState::Unsure;
  std::array<double, 3> probabilities{};  ///< that the position error is less than kRadii
  std::string tests;                      ///< names of the tests that fail at this frame, separated by blanks
};

/// Returns whether a test fails: its p-value is below `false_alarm`.
bool hasFailed(const ConsistencyTest& test, const Parameters& parameters);

/// Failed test that affects a frame.
struct Failure {
  std::string test;
  double distance = 0.0;         ///< m travelled during the interval of the test
  bool is_present = true;        ///< false: its cause was corrected, and the frame is not in the interval
  bool affects_position = true;  ///< ConsistencyTest::affects_position
};
/// Returns the trust in a frame. Its covariance is known up to the factor of Confirmation::scales, over which the
/// probabilities are averaged; each failure that affects the position adds Parameters::unexplained_drift of its
/// distance. UNSURE at such a failure that is present, and unless the confirmation is complete.
FrameTrust assessFrame(const FrameEvidence& frame, const std::vector<Failure>& failures,
                       const Confirmation& confirmation, const Parameters& parameters);

/// Returns the trust in each frame of a session. `frames`: in order of time. `spreads`: closures connect the path after
/// a failure to the path before it, so that it affects every frame; otherwise it affects the frames from its beginning
/// on.
std::vector<FrameTrust> assessFrames(const std::vector<FrameEvidence>& frames, const TestResults& results, bool spreads,
                                     const Parameters& parameters);

/// Trust in the whole map.
struct MapTrust {
  TrustState state = TrustState::Unsure;
  std::array<double, 3> probabilities{};  ///< means over the frames
  std::string reason;                     ///< why the state is not KNOWN; empty if it is
};
MapTrust assessMap(const std::vector<FrameTrust>& frames, const TestResults& results, const Parameters& parameters);

}  // namespace urban_nav_trust
