// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <sstream>

#include "state/steps.hpp"

namespace swf_vo {
namespace {

/// Prints health, poses, covariances, and rig estimates. Excludes reasons and standard deviations that depend directly
/// on parameters.
std::string printEstimate(const Frame& frame) {
  std::ostringstream text;
  text.precision(17);
  text << toString(frame.status.health) << "\n"
       << frame.T_odom_base.pose.matrix() << "\n"
       << frame.T_odom_base.covariance << "\n"
       << frame.rig.roll_rad << " " << frame.rig.delay_s << "\n";
  for (const Settled& settled : frame.settled)
    text << settled.from_previous.T_from_to.matrix() << "\n" << settled.from_previous.drift_covariance << "\n";
  return text.str();
}

/// Returns the estimates along 24 frames around the room with a fault (parseFault).
std::string playRoom(const Parameters& parameters, const std::string& fault) {
  SwfVo filter(parameters, stereoCamera(), kPlace);
  std::string text;
  for (const Step& step : collectSteps("loop", 24, fault)) text += printEstimate(filter.process(step.frame.pair()));
  return text;
}

TEST(ParameterEffects, EachParameterChangesTheEstimate) {
  using Experiment = urban_nav_core::testing::ParameterExperiment<Parameters>;
  const auto play = [](const Parameters& parameters) { return playRoom(parameters, "black:1000:1"); };
  const auto playBlurred = [](const Parameters& parameters) { return playRoom(parameters, "blur:0:1000"); };
  const Experiment drive("drive around a room", play,
                         {{"window", 5},
                          {"features", 40},
                          {"pixel_noise_floor", 0.1},
                          {"disparity_offset", 0.0},
                          {"rig_scale", 1.0},
                          {"right_roll", 0.5},
                          {"shutter_delay", 1.0},
                          {"robust_covariance", false},
                          {"huber", 1.0},
                          {"iterations", 1},
                          {"acceleration", 1.0},
                          {"angular_acceleration", 1.0},
                          {"search_radius", 4.0},
                          {"fast_threshold", 40},
                          {"lost_features", 200},
                          {"degraded_features", 200}});
  const Experiment blurred("drive with blurred images", playBlurred, {{"pyramid_levels", 1}});
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(table(), {drive, blurred});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace swf_vo
