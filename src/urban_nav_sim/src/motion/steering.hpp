// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "motion/route_path.hpp"
#include "motion/segway.hpp"
#include "noise/noise.hpp"

namespace urban_nav_sim {

/// Driver of the Segway: steers for a point ahead on the path, slower in bends, and halts where the path stops or turns
/// around. Deterministic; to be called in the order of time.
class SteeringModel {
 public:
  /// `way` must outlive this object. `wander`: lateral deviation, m (standard deviation). `start`: m along the path.
  SteeringModel(const RoutePath& way, double start, double wander, const Noise& hand);

  /// Returns the command for the next `dt` seconds.
  SegwayCommand steer(const SegwayState& state, double dt);
  /// Returns the distance along the path, m.
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
