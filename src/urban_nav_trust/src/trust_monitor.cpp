// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/trust_monitor.hpp"

namespace urban_nav_trust {

bool TrustMonitor::add(const urban_nav_core::FrameMeasurements& frame) {
  const bool moved = motion_.add(frame);
  const bool rose = reprojection_.add(frame);
  return offset_.add(frame) || moved || rose;
}

TestResults TrustMonitor::results() const {
  TestResults results;
  if (const std::optional<ConsistencyTest> test = offset_.test()) results.tests.push_back(*test);
  else results.absent.push_back({kOffsetTest, "no stereo frames were compared with the landmarks of earlier ones"});
  if (const std::optional<ConsistencyTest> test = reprojection_.test()) results.tests.push_back(*test);
  else results.absent.push_back({kReprojectionTest, "no reprojection errors of stereo frames over two seconds"});
  for (ConsistencyTest& test : motion_.tests()) results.tests.push_back(std::move(test));
  for (AbsentMeasurement& missing : motion_.absent()) results.absent.push_back(std::move(missing));
  results.segments = offset_.segments();
  results.turns = motion_.turnEvidence();
  results.lengths = motion_.lengthEvidence();
  return results;
}

}  // namespace urban_nav_trust
