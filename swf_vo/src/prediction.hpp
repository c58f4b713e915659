// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swf_vo/parameters.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/motion_input.hpp"
#include "window/window.hpp"

namespace swf_vo {

/// Standard deviation of a velocity of which nothing is known: a walking or slowly driving robot, or a car at 15 m/s.
constexpr double kUnknownSpeed = 10.0;        // m/s
constexpr double kUnknownAngularSpeed = 1.0;  // rad/s

/// Returns a prediction together with a measurement of the same step, which may leave directions free. Requires
/// information of full rank in one of the two.
ProcessInput fuse(ProcessInput u, const urban_nav_core::Pose& T_from_to, const urban_nav_core::Matrix6d& information);

/// The input of the process model (eq. 1) from what is known: constant velocity, and where there is one, a measured u.
///
/// Without u: the motion of the last step continues at the same velocity, with white noise on the acceleration: sigma =
/// a dt^2. It is weak on purpose, since the velocity itself comes from the same images. After m steps by prediction
/// alone sigma is m times that, so that the sum over m steps grows as the random walk of the velocity does (m^3 / 3 in
/// variance), although the window takes steps as independent; and no larger than it would be if nothing had ever been
/// known of the velocity. The velocity itself fades over these steps by the correlation that velocities of neighbouring
/// frames had, which is near 1 for a vehicle and less for a camera shaken in a hand.
class Prediction {
 public:
  Prediction(const Parameters& parameters, const urban_nav_core::Pose& T_base_camera);

  /// `seconds`: from the last frame to this one. Inputs that are to be taken as they are follow one another; what they
  /// do not cover of the step is extrapolated. Those of sensors are left to MotionSensors.
  ProcessInput step(double seconds, const std::vector<urban_nav_core::MotionInput>& inputs) const;

  /// The motion of the last step as it was estimated, and whether measurements had part in it. `blind`: there were none
  /// because there was no usable image; the velocity is then kept, else it is given up after some frames. `smoothed`:
  /// measurements had part in where the step begins, too; where they had not, its length says nothing after a frame by
  /// prediction.
  void learn(const urban_nav_core::Pose& T_last_camera, double seconds, bool measured, bool blind = false,
             bool smoothed = true);
  void archive(urban_nav_core::Archive& archive);

 private:
  /// How alike the velocities of neighbouring frames are, over some ten frames.
  struct Persistence {
    double product = 0.0, square = 0.0;
    void see(const urban_nav_core::Vector3d& before, const urban_nav_core::Vector3d& now);
    /// Returns the correlation, 0...1; 1 where nothing is known.
    double correlation() const;
    void archive(urban_nav_core::Archive& archive) { archive(product, square); }
  };
  urban_nav_core::Vector6d fadedVelocity() const;

  urban_nav_core::Pose T_base_camera_;
  double acceleration_;
  double angular_acceleration_;
  urban_nav_core::Vector6d velocity_;  // tangent of SE(3) in the camera, per second
  bool known_ = false;
  int unmeasured_ = 0;
  Persistence translation_, rotation_;
};

}  // namespace swf_vo
