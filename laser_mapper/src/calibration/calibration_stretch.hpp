// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calibration/calibration_patches.hpp"
#include "calibration/free_trajectory.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"

namespace laser_mapper {

/// Interval of a session whose beams calibrate its lasers. Further unknowns are the plane of every place, and the
/// trajectory as corrected by FreeTrajectory. Not thread-safe.
class CalibrationStretch {
 public:
  /// The arguments must outlive this object.
  CalibrationStretch(const Parameters& parameters, const std::vector<MountedLaser>& lasers,
                     const urban_nav_core::Trajectory& T_map_base, const urban_nav_core::OdometryChain* odometry,
                     SampledScans samples);

  /// Matches surfels up to `reach` (m) apart and returns the equations at these terms, without held-out places.
  TermEquations linearise(const std::vector<TermVector>& terms, double reach);
  /// Applies the corrections of the trajectory from the last linearise() for this change of all terms.
  void moveTrajectory(const Eigen::VectorXd& change) { trajectory_.move(change); }

  /// Spread of one held-out place along the given trajectory.
  struct Spread {
    double stated = 0.0, calibrated = 0.0;  ///< m
  };
  /// Compares the held-out places with the stated calibration, at which surfels are matched, and with `terms`.
  std::vector<Spread> compareHeldOut(const std::vector<TermVector>& terms) const;

 private:
  PlaceEquations linearisePatch(const CalibrationPatch& patch, const SurfelSet& set,
                                const std::vector<ScanPlace>& places, double scale) const;
  std::vector<ScanPlace> placesWith(const std::vector<TermVector>& terms,
                                    const std::vector<PoseCorrection>& corrections) const;
  Eigen::Index termCount() const { return static_cast<Eigen::Index>(kCalibrationTerms * lasers_.size()); }

  const Parameters& parameters_;
  const std::vector<MountedLaser>& lasers_;
  const urban_nav_core::Trajectory& T_map_base_;
  const SampledScans samples_;
  FreeTrajectory trajectory_;
};

}  // namespace laser_mapper
