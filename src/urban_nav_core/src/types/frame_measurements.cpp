// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/types/frame_measurements.hpp"

namespace urban_nav_core {

void archive(Archive& archive, FrameMeasurements& frame) {
  archive(frame.stamp, frame.disparity_step_px, frame.disparity_step_sigma_px, frame.turn, frame.turn_error);
  archive(frame.turn_sigma);
  archive(frame.forward, frame.sideways, frame.forward_error, frame.forward_sigma);
  archive(frame.imu_delay, frame.imu_delay_sigma, frame.wheel_delay, frame.wheel_delay_sigma);
  archive(frame.gyroscope_fault, frame.wheels_fault);
}

}  // namespace urban_nav_core
