// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swf_vo/parameters.hpp"
#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/motion_input.hpp"
#include "window/window.hpp"

namespace swf_vo {

/// Standard deviation of an unknown velocity: a walking or slowly driving robot, or a car at 15 m/s.
constexpr double kUnknownSpeed = 10.0;        // m/s
constexpr double kUnknownAngularSpeed = 1.0;  // rad/s

/// Fuses a prediction with a measurement of the same step, which may have free directions. Requires information of full
/// rank in one of the two.
ProcessInput fuse(ProcessInput u, const urban_nav_core::Pose& T_from_to, const urban_nav_core::Matrix6d& information);

/// Computes the input of the process model (eq. 1): constant velocity, or a measured u where available.
///
/// Without u, the motion of the last step continues at the same velocity, with white noise on the acceleration: sigma =
/// a dt^2. The weight is low on purpose, since the velocity is estimated from the same images. After m steps by
/// prediction only, sigma is m times that value, so that the sum over m steps grows as the random walk of the velocity
/// does (m^3 / 3 in variance), although the window treats steps as independent; limited to the sigma of an unknown
/// velocity. The velocity decays over these steps by the correlation between velocities of successive frames, which is
/// near 1 for a vehicle and less for a handheld camera.
class Prediction {
 public:
  Prediction(const Parameters& parameters, const urban_nav_core::Pose& T_base_camera);

  /// `seconds`: from the previous frame to this one. Inputs that are used directly as u must be consecutive; the part
  /// of the step that they do not cover is extrapolated. Inputs of sensors are handled by MotionSensors.
  ProcessInput step(double seconds, const std::vector<urban_nav_core::MotionInput>& inputs) const;

  /// Updates the velocity with the estimated motion of the last step. `measured`: measurements contributed to it.
  /// `blind`: there was no usable image; the velocity is then kept, else it is dropped after some frames without
  /// measurements. `smoothed`: measurements contributed to the start pose of the step as well; otherwise, after a frame
  /// by prediction, the length of the step is not informative.
  void learn(const urban_nav_core::Pose& T_last_camera, double seconds, bool measured, bool blind = false,
             bool smoothed = true);
  void archive(urban_nav_core::Archive& archive);

 private:
  /// Correlation between velocities of successive frames, over about ten frames.
  struct Persistence {
    double product = 0.0, square = 0.0;
    void see(const urban_nav_core::Vector3d& before, const urban_nav_core::Vector3d& now);
    /// Returns the correlation, 0...1; 1 without data.
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
