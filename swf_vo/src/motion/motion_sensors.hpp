// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "motion/agreement.hpp"
#include "motion/dead_reckoning.hpp"
#include "motion/fault_diagnosis.hpp"
#include "motion/motion_calibration.hpp"
#include "motion/twist_stream.hpp"
#include "motion/up_direction.hpp"
#include "swf_vo/frame.hpp"
#include "window/process_model.hpp"

namespace swf_vo {

/// Estimates bias, scales and time offsets of a gyroscope and wheels from steps measured by images only, excludes a
/// sensor that contradicts them, and predicts the motion with its covariance. Does not change steps measured by images.
/// Method: docs/derivations/motion_sensors.md. Without sensor inputs it has no effect. Not thread-safe.
class MotionSensors {
 public:
  explicit MotionSensors(const urban_nav_core::Pose& T_base_camera);

  /// Adds sensor inputs; inputs that are not from sensors are ignored.
  void add(const std::vector<urban_nav_core::MotionInput>& inputs);
  /// Adds one sensor input, between two calls of add().
  void append(const urban_nav_core::MotionInput& input);
  /// Returns the motion of the left camera between two stamps from the sensors in use, with zero information in the
  /// remaining directions; nullopt without any. `T_odom_camera`: at `from`.
  std::optional<ProcessInput> predict(urban_nav_core::StampNs from, urban_nav_core::StampNs to,
                                      const urban_nav_core::Pose& T_odom_camera) const;
  /// Returns whether predictions contain the gyroscope.
  bool followsGyroscope() const { return gyroscope_.mayPredict(); }
  /// Returns the end of the newest rate on the clock of the cameras. Requires followsGyroscope().
  urban_nav_core::StampNs newestRate() const;
  /// Returns the twist of base_link at the newest inputs: rotation and forward speed by the sensors in use, the rest
  /// from `steady`.
  Velocity velocity(Velocity steady) const;
  /// Continues after a prediction of this length, which nothing measured, and forgets inputs that end long before `to`.
  void continueUnmeasured(urban_nav_core::StampNs to, double seconds);
  /// Registers a frame of the window. `by_images`: its pose is measured by images; `reckoned`: the prediction by
  /// sensors contributed to it.
  void addFrame(FrameId frame, double seconds, bool by_images, bool reckoned);
  /// Checks sensors against the newest step of the left camera, measured by images only, before it settles: a sensor
  /// that contradicts it is not used for prediction until a later step confirms it.
  void check(urban_nav_core::StampNs from, urban_nav_core::StampNs to, const urban_nav_core::Pose& T_from_to);
  /// Takes a settled frame. Requires frames in order.
  void learn(const Settled& settled);

  const MotionEstimates& estimates() const { return estimates_; }
  void archive(urban_nav_core::Archive& archive);

 private:
  struct Sensor {
    explicit Sensor(double floor) : agreement(floor) {}
    TwistStream stream;
    Agreement agreement;
    bool is_used = false, is_left_out = false;
    bool is_contradicted = false;  // the newest step contradicts it
    bool mayPredict() const { return is_used && !is_contradicted && !stream.isEmpty() && !stream.isStuck(); }
    void archive(urban_nav_core::Archive& archive) {
      archive(stream, agreement, is_used, is_left_out, is_contradicted);
    }
  };
  struct FrameNote {
    FrameId frame = 0;
    bool reckoned = false;
    void archive(urban_nav_core::Archive& archive) { archive(frame, reckoned); }
  };
  struct Compared {
    ComparedStep step;
    urban_nav_core::Vector3d error = urban_nav_core::Vector3d::Zero();
    double variance = 0.0;
    double stated_error = 0.0, stated_variance = 0.0;  // of wheels without the estimated scale: m, m^2
  };

  std::optional<Reckoned> reckonBy(bool gyroscope, bool wheels, urban_nav_core::StampNs from,
                                   urban_nav_core::StampNs to, const urban_nav_core::Pose& T_odom_base) const;
  void learnStep(const Settled& settled);
  std::optional<GyroscopeStep> compareGyroscope(const Settled& settled, const ImageStep& images,
                                                std::optional<Compared>& compared) const;
  std::optional<WheelStep> compareWheels(const Settled& settled, const ImageStep& images,
                                         std::optional<Compared>& compared) const;
  bool isBiasBeyondPrior() const;
  void decide(Sensor& sensor, bool is_wheels, urban_nav_core::StampNs stamp);
  void leaveOut(Sensor& sensor, bool is_wheels, urban_nav_core::StampNs stamp);
  void write();

  urban_nav_core::Pose T_base_camera_;
  urban_nav_core::Quaterniond q_base_imu_ = urban_nav_core::Quaterniond::Identity();
  Sensor gyroscope_, wheels_;
  MotionCalibration calibration_;
  GroundSlope ground_;
  UpDirection up_;
  std::vector<FrameNote> notes_;  // frames of the window
  MotionEstimates estimates_;
  double since_measured_ = 0.0;  // s
  bool any_settled_ = false, follows_ = false, start_is_sound_ = false;
};

}  // namespace swf_vo
