// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion/route_path.hpp"
#include "motion/segway.hpp"
#include "noise/noise.hpp"

namespace urban_nav_sim {

/// Who stands on the Segway: looks a step ahead on the way and steers for that place, slower where the way bends, to a
/// halt where it stops or turns round. Deterministic; to be asked in the order of time.
class SteeringModel {
 public:
  /// The way must outlive the driver. `wander`: m to the side (standard deviation). `start`: m along the way.
  SteeringModel(const RoutePath& way, double start, double wander, const Noise& hand);

  /// What is wanted for the next `dt` seconds.
  SegwayCommand steer(const SegwayState& state, double dt);
  /// How far along the way it has come, m.
  double along() const { return along_; }

 private:
  Eigen::Vector2d wantedPlace(double s, double stop) const;
  void comeAlong(const SegwayState& state, double stop);
  double allowedSpeed(double stop) const;
  double wantedSpeed(const SegwayState& state, double off_course, double stop) const;

  const RoutePath& way_;
  double wander_, along_, passed_, waiting_ = 0.0;
  SegwayCommand last_;
  Noise sideways_, haste_;
};

}  // namespace urban_nav_sim
