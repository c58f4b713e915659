// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "calibration/brightness_equations.hpp"
#include "calibration/head_views.hpp"

namespace laser_mapper {

/// Fits the terms of a camera head to its images: the brightness of a point, minus the exposure of each image, must be
/// equal in all views. The gradient of brightness along the surface is averaged over the views, because that of a
/// single view is so noisy that identical views would appear informative. The trajectory, along which points and views
/// were taken, is corrected by FreeTrajectory. The places are cubes of 2 m of the map; a fifth of them is held out. The
/// result does not depend on the number of threads. Not thread-safe.
class HeadFit {
 public:
  /// The arguments must outlive this object, except `odometry` (null if unknown). `centre`: of the head, in base_link.
  /// `range_bias`: standard deviation of a laser's constant error, m.
  HeadFit(const HeadImages& images, const urban_nav_core::Trajectory& T_map_base,
          const urban_nav_core::OdometryChain* odometry, const urban_nav_core::Vector3d& centre, double range_bias);

  /// Estimates the terms in `wanted`; the others are zero. Returns no terms if no point has several views. The
  /// covariance includes the images and the effect of a constant error of the lasers, which is common to the whole map.
  TermEstimate estimate(const std::vector<bool>& wanted);

  /// Relative spread of the brightness of points over their views in the held-out places.
  struct HeldOut {
    std::size_t places = 0;
    double stated = 0.0, calibrated = 0.0;
    bool improves = false;  ///< significantly
  };
  /// Compares the stated calibration with the last estimate, along the given trajectory.
  HeldOut compareHeldOut();
  /// Returns the number of places of the last estimate.
  std::size_t places() const { return equations_places_; }

 private:
  struct PlaceSpread;
  struct PointRows;

  void estimateExposures(const std::vector<HeadRow>& rows);
  TermEquations linearise(std::vector<HeadRow> rows);
  std::vector<PointRows> usablePoints(const std::vector<HeadRow>& rows, bool held_out) const;
  std::vector<BrightnessRow> brightnessRows(const std::vector<HeadRow>& rows, const PointRows& point) const;
  static double rowVariance(const std::vector<HeadRow>& rows, const std::vector<PointRows>& points);
  TermEstimate fit(const std::vector<bool>& wanted);
  void addRangeBias(const std::vector<bool>& wanted, TermEstimate& estimate) const;
  std::vector<PlaceSpread> spreadsAt(const TermVector& terms);

  std::vector<FreeTrajectory> stretches_;  ///< intervals of the trajectory, in order of time
  const HeadViews views_;
  std::vector<std::uint32_t> place_of_;    ///< of each point
  std::vector<std::uint8_t> is_held_out_;  ///< of each place
  std::vector<float> exposures_;           ///< of each view: logarithm
  TermVector terms_ = TermVector::Zero();
  std::size_t equations_places_ = 0;
  double range_bias_;
  double distance_ = 0.0;  ///< root mean square distance of the points from the robot, m
};

}  // namespace laser_mapper
