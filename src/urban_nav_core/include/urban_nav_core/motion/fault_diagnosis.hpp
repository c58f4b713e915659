// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/motion/agreement.hpp"

namespace urban_nav_core {

/// Cause of a contradiction between a motion sensor and the reference, odometry by images or sweeps.
struct MotionFault {
  enum class Kind { Unknown, Frozen, Bias, Units, Axes, Scale, Delay };
  Kind kind = Kind::Unknown;
  std::string sentence;  ///< the fault with a figure, and the remedy
};

/// State of a sensor besides its steps.
struct DiagnosisInput {
  double repeated_s = 0.0;           ///< duration of unchanged numbers
  Vector3d bias = Vector3d::Zero();  ///< rad/s, as estimated; zero without an estimate
  Quaterniond q_base_sensor = Quaterniond::Identity();
  std::string reference = "images";  ///< for the sentence: "images", "sweeps"
};

/// Identifies the fault of a gyroscope whose rotation vectors contradict those of the reference. Tests the hypotheses
/// frozen sensor, bias, other units, exchanged axes, other scale and delay, in this order.
MotionFault diagnoseGyroscope(const std::vector<ComparedStep>& steps, const DiagnosisInput& input);

/// Identifies the fault of wheels from their translations.
MotionFault diagnoseWheels(const std::vector<ComparedStep>& steps, const DiagnosisInput& input);

}  // namespace urban_nav_core
