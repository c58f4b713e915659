// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "motion/agreement.hpp"

namespace swf_vo {

/// Why a motion sensor contradicts the images.
struct MotionFault {
  enum class Kind { Unknown, Frozen, Bias, Units, Axes, Scale, Delay };
  Kind kind = Kind::Unknown;
  std::string sentence;  ///< what is wrong, with a figure, and the remedy
};

/// State of a sensor apart from its steps.
struct DiagnosisInput {
  double repeated_s = 0.0;                                           ///< every number has been the same for so long
  urban_nav_core::Vector3d bias = urban_nav_core::Vector3d::Zero();  ///< rad/s, as estimated; zero without
  urban_nav_core::Quaterniond q_base_sensor = urban_nav_core::Quaterniond::Identity();
};

/// Names the fault of a gyroscope whose rotation vectors contradict those of images: it tries what explains them, a
/// frozen sensor, a bias, other units, exchanged axes, another scale, a delay, in this order.
MotionFault diagnoseGyroscope(const std::vector<ComparedStep>& steps, const DiagnosisInput& input);

/// Names the fault of wheels, from their translations.
MotionFault diagnoseWheels(const std::vector<ComparedStep>& steps, const DiagnosisInput& input);

}  // namespace swf_vo
