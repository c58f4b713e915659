// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// Chooses the mean of the process term (eq. 1) of a step that images measure, separately for translation and rotation:
/// constant velocity or motion sensors, whichever was closer to the motion by images over about ten frames; without
/// data, constant velocity. On a steady drive the previous step predicts the next one better than slipping wheels; in a
/// turn a gyroscope predicts it better.
class MeanChoice {
 public:
  /// Returns T_from_to.
  urban_nav_core::Pose choose(const urban_nav_core::Pose& steady, const urban_nav_core::Pose& by_sensors) const {
    return urban_nav_core::Pose(rotation_.prefersSensors() ? by_sensors.q() : steady.q(),
                                translation_.prefersSensors() ? by_sensors.t() : steady.t());
  }
  /// Compares both with the motion by images.
  void see(const urban_nav_core::Pose& steady, const urban_nav_core::Pose& by_sensors,
           const urban_nav_core::Pose& measured) {
    translation_.see((steady.t() - measured.t()).squaredNorm(), (by_sensors.t() - measured.t()).squaredNorm());
    rotation_.see(squaredAngle(steady, measured), squaredAngle(by_sensors, measured));
  }
  void archive(urban_nav_core::Archive& archive) { archive(translation_, rotation_); }

 private:
  struct Errors {
    double steady = 0.0, sensors = 0.0;  // squares, exponentially weighted
    void see(double of_steady, double of_sensors) {
      constexpr double kKept = 0.9;
      steady = kKept * steady + of_steady;
      sensors = kKept * sensors + of_sensors;
    }
    bool prefersSensors() const { return sensors < steady; }
    void archive(urban_nav_core::Archive& archive) { archive(steady, sensors); }
  };
  static double squaredAngle(const urban_nav_core::Pose& a, const urban_nav_core::Pose& b) {
    const double angle = urban_nav_core::angleBetween(a, b);
    return angle * angle;
  }

  Errors translation_, rotation_;
};

}  // namespace swf_vo
