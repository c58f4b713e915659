// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/motion/agreement.hpp"
#include "urban_nav_core/motion/dead_reckoning.hpp"
#include "urban_nav_core/motion/fault_diagnosis.hpp"
#include "urban_nav_core/motion/motion_calibration.hpp"
#include "urban_nav_core/motion/motion_estimates.hpp"
#include "urban_nav_core/motion/twist_stream.hpp"
#include "urban_nav_core/motion/up_direction.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace urban_nav_core {

/// Settled step of base_link by the reference, odometry by images or sweeps.
struct MeasuredStep {
  std::int64_t frame = 0;                             ///< that of MotionSensors::addFrame()
  StampNs stamp = 0;                                  ///< of the end
  RelativePose step;                                  ///< from == to for the first frame
  Quaterniond q_odom_base = Quaterniond::Identity();  ///< at the end
  Health health = Health::Ok;                         ///< of the end; a step is measured if both ends are OK
  /// Whether both ends determine the rotation, and the translation along x.
  bool measures_turn = true, measures_forward = true;
};
/// Reads or writes all members but the constants of the step.
void archive(Archive& archive, MeasuredStep& step);

/// Estimates bias, scales and time offsets of a gyroscope and wheels from steps measured by the reference only
/// (odometry by images or sweeps), excludes a sensor that contradicts them, and predicts the motion with its
/// covariance. Does not change measured steps. Method: docs/derivations/motion_sensors.md. Without sensor inputs it has
/// no effect. Not thread-safe.
class MotionSensors {
 public:
  struct Options {
    std::string reference = "images";  ///< for messages: "images", "sweeps"
    /// Whether wheels are used, with the standard deviations of their priors, as long as they could not be compared
    /// with the reference; false: like the gyroscope, they predict nothing until a motion confirmed them.
    bool uses_untested_wheels = false;
  };
  MotionSensors();
  explicit MotionSensors(Options options);

  /// Adds sensor inputs; inputs that are not from sensors are ignored.
  void add(const std::vector<MotionInput>& inputs);
  /// Adds one sensor input, between two calls of add().
  void append(const MotionInput& input);
  /// Returns the motion of base_link between two stamps from the sensors in use; nullopt without any. `q_odom_base`: at
  /// `from`. `forward_unmeasured`: time before `from` in which nothing else measured the translation, s; nullopt: that
  /// since the last measured frame.
  std::optional<Reckoned> predict(StampNs from, StampNs to, const Quaterniond& q_odom_base,
                                  std::optional<double> forward_unmeasured = std::nullopt) const;
  /// Returns whether predictions contain the gyroscope.
  bool followsGyroscope() const { return mayPredict(gyroscope_); }
  /// Returns whether predictions contain the wheels.
  bool followsWheels() const { return mayPredict(wheels_); }
  /// Returns the end of the newest rate on the clock of the reference. Requires followsGyroscope().
  StampNs newestRate() const;
  /// Returns the twist of base_link at the newest inputs: rotation and forward speed by the sensors in use, the rest
  /// from `steady`.
  BodyTwist velocity(BodyTwist steady) const;
  /// Continues after a prediction of this length, which nothing measured, and forgets inputs that end long before `to`.
  void continueUnmeasured(StampNs to, double seconds);
  /// Registers a frame that is not settled yet. `by_reference`: its pose is measured by the reference; `reckoned`: the
  /// prediction by sensors contributed to it.
  void addFrame(std::int64_t frame, double seconds, bool by_reference, bool reckoned);
  /// Checks sensors against the newest step of base_link, measured by the reference only, before it settles: a sensor
  /// that contradicts it is not used for prediction until a later step confirms it. Of `newest`, the stamps, the pose
  /// and what it measures are used.
  void check(const MeasuredStep& newest);
  /// Takes a settled frame. Requires frames in order.
  void learn(const MeasuredStep& settled);

  const MotionEstimates& estimates() const { return estimates_; }
  void archive(Archive& archive);

 private:
  struct Sensor {
    explicit Sensor(double floor) : agreement(floor) {}
    TwistStream stream;
    Agreement agreement;
    bool is_used = false, is_left_out = false;
    bool is_contradicted = false;  // the newest step contradicts it
    void archive(Archive& archive) { archive(stream, agreement, is_used, is_left_out, is_contradicted); }
  };
  struct FrameNote {
    std::int64_t frame = 0;
    bool reckoned = false;
    void archive(Archive& archive) { archive(frame, reckoned); }
  };
  struct Compared {
    ComparedStep step;
    Vector3d error = Vector3d::Zero();
    double variance = 0.0;
    double stated_error = 0.0, stated_variance = 0.0;  // of wheels without the estimated scale: m, m^2
  };

  bool isInUse(const Sensor& sensor) const {
    if (sensor.is_used || &sensor == &gyroscope_) return sensor.is_used;
    return options_.uses_untested_wheels && !sensor.is_left_out && sensor.agreement.isUntested();
  }
  bool mayPredict(const Sensor& sensor) const {
    return isInUse(sensor) && !sensor.is_contradicted && !sensor.stream.isEmpty() && !sensor.stream.isStuck();
  }
  void learnStep(const MeasuredStep& settled);
  std::optional<GyroscopeStep> compareGyroscope(const MeasuredStep& settled, const ReferenceStep& images,
                                                std::optional<Compared>& compared) const;
  std::optional<WheelStep> compareWheels(const MeasuredStep& settled, const ReferenceStep& images,
                                         std::optional<Compared>& compared) const;
  bool isBiasBeyondPrior() const;
  void decide(Sensor& sensor, bool is_wheels, StampNs stamp);
  void leaveOut(Sensor& sensor, bool is_wheels, StampNs stamp);
  void write();

  Options options_;
  Quaterniond q_base_imu_ = Quaterniond::Identity();
  Sensor gyroscope_, wheels_;
  MotionCalibration calibration_;
  GroundSlope ground_;
  UpDirection up_;
  std::vector<FrameNote> notes_;  // frames of the window
  MotionEstimates estimates_;
  double since_measured_ = 0.0;  // s
  bool any_settled_ = false, follows_ = false, start_is_sound_ = false;
};

}  // namespace urban_nav_core
