// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_core {

/// Motion sensor that accompanies the images, and its noise: parameters of readers and nodelets that convert its
/// messages to MotionInput. Base of their parameter structs; the rows are those of withMotionInput().
struct MotionInputParameters {
  std::string motion_input;  // auto, none, wheels, gyroscope
  double wheel_noise;        // m/m and rad/rad
  double gyro_noise;         // rad/s
};

/// Returns the rows `own` followed by those of MotionInputParameters.
template <typename P>
std::vector<Row<P>> withMotionInput(std::vector<Row<P>> own) {
  const std::vector<Row<P>> rows = {{"motion_input",
                                     &P::motion_input,
                                     "",
                                     "auto",
                                     false,
                                     false,
                                     {"auto", "none", "wheels", "gyroscope"},
                                     "Motion sensors used with images and sweeps: gyroscope and wheel odometry if "
                                     "present, one of them, or none.",
                                     "paper 2.1, eq. 1",
                                     {"swf_vo.motion_input"}},
                                    {"wheel_noise",
                                     &P::wheel_noise,
                                     "m/m, rad/rad",
                                     0.05,
                                     0.0001,
                                     10.0,
                                     {},
                                     "Standard deviation of wheel odometry between messages, proportional to distance "
                                     "and angle; adapted from images and sweeps.",
                                     "paper 2.1, eq. 1",
                                     {"swf_vo.wheel_noise"}},
                                    {"gyro_noise",
                                     &P::gyro_noise,
                                     "rad/s",
                                     0.0,
                                     0.0,
                                     10.0,
                                     {},
                                     "Standard deviation of one rate of the IMU without its bias, which is estimated; "
                                     "0: as in its messages, else from their scatter.",
                                     "paper 2.1, eq. 1",
                                     {"swf_vo.gyro_noise"}}};
  own.insert(own.end(), rows.begin(), rows.end());
  return own;
}

}  // namespace urban_nav_core
