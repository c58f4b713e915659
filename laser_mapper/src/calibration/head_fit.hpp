// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "calibration/brightness_equations.hpp"
#include "calibration/head_views.hpp"

namespace laser_mapper {

/// Fits the terms of a head of cameras to its images: the brightness of a point, less the exposure of each image, must
/// be the same in all views. How the brightness varies along the surface is what the views say on average: that of one
/// view is so noisy that views which do not differ would seem to tell something. The trajectory, along which the points
/// were measured and the views taken, is corrected as FreeTrajectory does. Cubes of 2 m of the map are the places; a
/// fifth of them is held out. The result does not depend on the number of threads. Not thread-safe.
class HeadFit {
 public:
  /// References must outlive the fit, but for `odometry` (null if nothing is known). `centre`: of the head, in
  /// base_link. `range_bias`: standard deviation of a laser's constant error, m.
  HeadFit(const HeadImages& images, const urban_nav_core::Trajectory& T_map_base,
          const urban_nav_core::OdometryChain* odometry, const urban_nav_core::Vector3d& centre, double range_bias);

  /// Estimates the terms in `wanted`; the others are zero. Without terms if no point is seen by several views.
  /// Covariance: what the images say, and what a constant error of the lasers, which the whole map shares, would look
  /// like.
  TermEstimate estimate(const std::vector<bool>& wanted);

  /// Spread of the brightness of points over their views in the held-out places, as a share of it.
  struct HeldOut {
    std::size_t places = 0;
    double stated = 0.0, calibrated = 0.0;
    bool improves = false;  ///< beyond chance
  };
  /// Compares the stated calibration with the last estimate, along the trajectory as given.
  HeldOut compareHeldOut();
  /// Returns the number of places that the last estimate rests on.
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

  std::vector<FreeTrajectory> stretches_;  ///< of the trajectory, in order of time
  const HeadViews views_;
  std::vector<std::uint32_t> place_of_;    ///< of each point
  std::vector<std::uint8_t> is_held_out_;  ///< of each place
  std::vector<float> exposures_;           ///< of each view: logarithm
  TermVector terms_ = TermVector::Zero();
  std::size_t equations_places_ = 0;
  double range_bias_;
  double distance_ = 0.0;  ///< of the points from where the robot was, root mean square, m
};

}  // namespace laser_mapper
