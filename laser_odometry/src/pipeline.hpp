// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "error_model.hpp"
#include "gap_error.hpp"
#include "laser_odometry/laser_odometry.hpp"
#include "motion.hpp"
#include "planar_floor.hpp"
#include "prior_agreement.hpp"
#include "registration.hpp"
#include "surface_map.hpp"
#include "sweep_points.hpp"

namespace laser_odometry {

/// Variance of the first pose, which is the origin: small positive numbers, m^2 and rad^2.
constexpr double kFirstCovariance = 1e-12;

/// Odometry pipeline: prediction, deskewing, registration, covariance, map update.
class Pipeline {
 public:
  Pipeline(const Parameters& parameters, const Pose& T_base_lidar, Scanner scanner);

  LaserPose process(const urban_nav_core::Sweep& sweep, const std::optional<MotionPrior>& prior);
  std::vector<MapPoint> localMap() const;
  std::string state() const;
  void restore(std::string_view state);

 private:
  /// Predicted motion since the last sweep: T_last_now and its covariance (tangent as in PoseWithCovariance).
  struct Prediction {
    double seconds = 0.0;
    Pose T_last_now;
    Matrix6d covariance = Matrix6d::Identity();
    Matrix6d of_step = Matrix6d::Identity();  ///< part that does not depend on other predictions of a gap
    bool is_measured = false;                 ///< by another sensor
    bool is_tilt_measured = false;            ///< roll and pitch, by another sensor
    bool has_prior = false;                   ///< by another sensor at all
    std::optional<Vector6d> within;           ///< twist within the sweep, by another sensor
  };
  /// A registered sweep with the deskewed segments of its last round, in base_link.
  struct Aligned {
    Registration registration;
    std::vector<Segment> segments;
    SweepMotion motion;  ///< motion within the sweep
    int iterations = 0;
  };

  Prediction predict(const urban_nav_core::Sweep& sweep, const std::optional<MotionPrior>& prior) const;
  std::optional<MotionPrior> complete(const std::optional<MotionPrior>& prior, double seconds) const;
  SweepMotion knownMotion() const;
  SweepPoints collect(const urban_nav_core::Sweep& sweep) const;
  void beginMap(const SweepPoints& points, const SweepMotion& motion);
  Pose searchStart(const SweepPoints& points, const Prediction& prediction);
  /// Motions within the first two sweeps of a map.
  struct StartMotion {
    SweepMotion first, second;
  };
  /// Returns these motions for a step of `seconds` between the sweeps. `change`: from the first motion to the second.
  static StartMotion startMotion(const Pose& T_first_second, double seconds, const SweepMotion& change);
  Aligned align(const SweepPoints& points, const Prediction& prediction, const Pose& guess,
                const std::optional<StartMotion>& start = std::nullopt);
  Aligned alignWithPrior(const SweepPoints& points, const urban_nav_core::Sweep& sweep, Prediction& prediction);
  /// Returns the twists of `free` that no other sensor measured.
  static std::vector<Vector6d> withoutMeasured(const std::vector<Vector6d>& free, const Prediction& prediction);
  void comparePrior(const std::optional<MotionPrior>& prior, const Prediction& prediction, LaserPose& result);
  Aligned alignSecond(const SweepPoints& points, const Prediction& prediction);
  void accept(const Aligned& aligned, const SweepPoints& points, const Prediction& prediction,
              const urban_nav_core::Sweep& sweep, LaserPose& result);
  void grow(const Aligned& aligned, const SweepPoints& points);
  bool isPlausible(const Registration& registration, const Prediction& prediction) const;
  void continueByPrediction(const Prediction& prediction, LaserPose& result);
  void restartIfLost(const SweepPoints& points, const Prediction& prediction, LaserPose& result);
  void accumulate(const Pose& T_odom_last, const urban_nav_core::RelativePose& step);
  LaserPose drop(const urban_nav_core::Sweep& sweep) const;
  void assess(const Aligned& aligned, const SweepPoints& points, const urban_nav_core::Sweep& sweep,
              const Prediction& prediction, LaserPose& result) const;
  Matrix6d skewCovariance(const urban_nav_core::Sweep& sweep) const;
  std::string fingerprint() const;
  void archive(urban_nav_core::Archive& archive);

  const Scanner scanner_;
  const MotionSpace space_;
  Parameters parameters_;  ///< those of the scanner: see toScannerParameters()
  Pose T_base_lidar_;

  SurfaceMap map_;
  MotionModel motion_;
  ErrorModel errors_;
  GapError gap_;
  PriorAgreement agreement_;
  std::int32_t sweep_ = 0;  ///< number of the next sweep
  bool started_ = false;
  urban_nav_core::StampNs stamp_ = 0;
  Pose T_odom_base_;
  Matrix6d end_covariance_ = Matrix6d::Zero();  ///< covariance of the last pose relative to the map
  bool has_step_ = false;
  Matrix6d drift_ = Matrix6d::Zero();  ///< covariance of T_odom_base without the error of its end
  Matrix6d covariance_ = kFirstCovariance * Matrix6d::Identity();  ///< of T_odom_base
  double usual_s_ = 0.0;                                           ///< typical time between sweeps
  std::int32_t lost_ = 0;                                          ///< consecutive sweeps without registration
  Vector3d pruned_at_ = Vector3d::Zero();
  SweepPoints first_;  ///< points of the first sweep of the map, until the next one determines its velocity
};

}  // namespace laser_odometry
