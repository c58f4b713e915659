// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "calibration/term_equations.hpp"
#include "calibration/trajectory_prior.hpp"

namespace laser_mapper {

/// A stretch of time, end not included.
struct CalibrationInterval {
  urban_nav_core::StampNs begin = 0, end = 0;
};
/// Divides the time of a trajectory into equal stretches of at most 300 s; none if it has fewer than two poses.
std::vector<CalibrationInterval> divideTrajectory(const urban_nav_core::Trajectory& T_map_base);

/// Normal equations of one place: all terms, then the corrections of the trajectory at `seconds`, 6 each.
struct PlaceEquations {
  std::vector<std::uint32_t> seconds;  ///< since the beginning of the stretch, ascending
  Eigen::MatrixXd information;         ///< the lower triangle, and all of the terms' part
  Eigen::VectorXd gradient;
};

/// The trajectory of a stretch while devices are calibrated against it: unknown besides their terms is a correction at
/// every second, a random walk with the covariance of odometry. Equations are collected by clear() and add(), and
/// eliminate() leaves those of the terms. Not thread-safe.
class FreeTrajectory {
 public:
  /// `odometry`: null if nothing is known. `terms`: of all devices together.
  FreeTrajectory(const urban_nav_core::Trajectory& T_map_base, const urban_nav_core::OdometryChain* odometry,
                 const CalibrationInterval& interval, Eigen::Index terms);

  /// Where a time lies between two corrections.
  struct Share {
    std::uint32_t second = 0;
    double next = 0.0;  ///< of the correction at second + 1; 1 - next of that at `second`
  };
  Share shareAt(urban_nav_core::StampNs stamp) const;
  const CalibrationInterval& interval() const { return interval_; }
  const std::vector<PoseCorrection>& corrections() const { return corrections_; }
  PoseCorrection correctionAt(const Share& share) const {
    return (1.0 - share.next) * corrections_[share.second] + share.next * corrections_[share.second + 1];
  }

  void clear();
  void add(PlaceEquations place);
  /// Returns the equations of the terms, from which the corrections are eliminated; zero if those are not observable.
  TermEquations eliminate();
  /// Moves the corrections as the equations of the last eliminate() ask for with this change of all terms.
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
  std::vector<PoseCorrection> corrections_;  ///< at whole seconds
  TermEquations equations_;
  Eigen::MatrixXd information_, cross_;  ///< of corrections, lower triangle; their rows and the columns of terms
  Eigen::VectorXd gradient_;             ///< of corrections
  std::vector<PlaceGradient> places_;
  // Of the last eliminate(): corrections change by change_ - per_term_ * change of the terms.
  Eigen::VectorXd change_;
  Eigen::MatrixXd per_term_;
};

}  // namespace laser_mapper
