// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "calibration/term_equations.hpp"
#include "calibration/trajectory_prior.hpp"

namespace laser_mapper {

/// Half-open interval of time.
struct CalibrationInterval {
  urban_nav_core::StampNs begin = 0, end = 0;
};
/// Divides the time of a trajectory into equal intervals of at most 300 s; none with fewer than two poses.
std::vector<CalibrationInterval> divideTrajectory(const urban_nav_core::Trajectory& T_map_base);

/// Normal equations of one place: all terms, then the corrections of the trajectory at `seconds`, 6 each.
struct PlaceEquations {
  std::vector<std::uint32_t> seconds;  ///< since the beginning of the interval, ascending
  Eigen::MatrixXd information;         ///< lower triangle, and the full block of the terms
  Eigen::VectorXd gradient;
};

/// Trajectory of an interval during calibration: a correction per second is unknown besides the terms, with a random
/// walk prior from the covariance of odometry. Equations are collected by clear() and add(), and eliminate() reduces
/// them to the terms. Not thread-safe.
class FreeTrajectory {
 public:
  /// `odometry`: null if unknown. `terms`: of all devices together.
  FreeTrajectory(const urban_nav_core::Trajectory& T_map_base, const urban_nav_core::OdometryChain* odometry,
                 const CalibrationInterval& interval, Eigen::Index terms);

  /// Time between two corrections.
  struct Share {
    std::uint32_t second = 0;
    double next = 0.0;  ///< weight of the correction at second + 1; 1 - next is that of the one at `second`
  };
  Share shareAt(urban_nav_core::StampNs stamp) const;
  const CalibrationInterval& interval() const { return interval_; }
  const std::vector<PoseCorrection>& corrections() const { return corrections_; }
  PoseCorrection correctionAt(const Share& share) const {
    return (1.0 - share.next) * corrections_[share.second] + share.next * corrections_[share.second + 1];
  }

  void clear();
  void add(PlaceEquations place);
  /// Returns the equations of the terms with the corrections eliminated; zero if the corrections are not observable.
  TermEquations eliminate();
  /// Applies the corrections from the last eliminate() for this change of all terms.
  void move(const Eigen::VectorXd& change);

 private:
  /// Gradient of a place, for the scatter.
  struct PlaceGradient {
    std::vector<std::uint32_t> seconds;
    Eigen::VectorXd gradient;
  };

  const CalibrationInterval interval_;
  const Eigen::Index terms_;
  const TrajectoryPrior prior_;
  std::vector<PoseCorrection> corrections_;  ///< at integer seconds
  TermEquations equations_;
  Eigen::MatrixXd information_, cross_;  ///< of corrections, lower triangle; rows of corrections and columns of terms
  Eigen::VectorXd gradient_;             ///< of corrections
  std::vector<PlaceGradient> places_;
  // From the last eliminate(): corrections change by change_ - per_term_ * change of the terms.
  Eigen::VectorXd change_;
  Eigen::MatrixXd per_term_;
};

}  // namespace laser_mapper
