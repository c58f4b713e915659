// SPDX-License-Identifier: BSD-3-Clause
#include "trust_message.hpp"

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_trust {

using urban_nav_msgs::Trust;
using urban_nav_ros::toRosTime;

namespace {

std::uint8_t toMessage(TrustState state) {
  switch (state) {
    case TrustState::Known: return Trust::KNOWN;
    case TrustState::New: return Trust::NEW;
    case TrustState::Unsure: return Trust::UNSURE;
    case TrustState::Lost: return Trust::LOST;
  }
  return Trust::UNSURE;
}

}  // namespace

Trust toMessage(const LiveEstimate& estimate, const Parameters& parameters, const std::string& map_frame) {
  Trust message;
  message.header.stamp = toRosTime(estimate.frame.stamp);
  message.header.frame_id = map_frame;
  message.state = toMessage(estimate.frame.state);
  message.reason = estimate.reason;
  message.radii.assign(kRadii.begin(), kRadii.end());
  message.probabilities.assign(estimate.frame.probabilities.begin(), estimate.frame.probabilities.end());
  for (const ConsistencyTest& test : estimate.results.tests) {
    urban_nav_msgs::ConsistencyTest each;
    each.name = test.name;
    each.failed = hasFailed(test, parameters);
    each.from_stamp = toRosTime(test.interval.from);
    each.to_stamp = toRosTime(test.interval.to);
    each.statistic = test.statistic;
    each.degrees_of_freedom = test.degrees_of_freedom;
    each.p_value = test.p_value;
    each.sentence = test.sentence;
    each.remedy = test.remedy;
    each.corrected = test.is_corrected;
    message.tests.push_back(std::move(each));
  }
  for (const AbsentMeasurement& missing : estimate.results.absent) {
    message.absent.push_back(missing.name);
    message.absent_reasons.push_back(missing.reason);
  }
  return message;
}

}  // namespace urban_nav_trust
