// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/trust_monitor.hpp"

namespace urban_nav_trust {

TestResults TrustMonitor::results() const {
  TestResults results;
  if (const std::optional<ConsistencyTest> test = offset_.test()) results.tests.push_back(*test);
  else results.absent.push_back({kOffsetTest, "no stereo frames were compared with the landmarks of earlier ones"});
  results.segments = offset_.segments();
  return results;
}

}  // namespace urban_nav_trust
