// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/dense_cholesky.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// What earlier frames left (Newman et al. 2009, eq. 1 and 3): a Gaussian over the oldest pose and the landmarks
/// that frames outside the window saw, as information Pi and vector eta:
///   l(d, o) = 1/2 d^T Pi d - eta^T d + o border^T d + 1/2 o^2 offset_information - offset_eta o,   d = x - centre
///   (boxMinus for the pose),
/// with o the disparity offset itself, in which the sensor model is linear.
/// Blocks stand in the order landmarks, pose. Pi may be singular: what was never measured has no information in it.
///
/// Two rules make the filter consistent. A block that the prior touches is linearised where the prior was, in every
/// later term (linearise_first; Huang et al. 2008, "first estimates Jacobian"): so the whole information is J^T W J at
/// one set of values, and the six gauge directions stay empty. And the robust weights of what went in are frozen: they
/// are in Pi. The textbook's EKF (linearise_first off) moves the centre to each new estimate instead.
struct Prior {
  bool has_pose = false;
  bool frozen = false;     ///< something was marginalised into it: from now on blocks are linearised where they
                           ///< were then. Before that it is a measurement like any other
  std::vector<int> slots;  ///< landmark slot of each landmark block
  std::vector<Eigen::Vector3d> landmark_centre;
  urban_nav_core::Pose pose_centre;
  DenseMatrix information;  ///< 3 slots.size() + 6
  std::vector<double> eta;
  bool has_offset = false;                                        ///< the disparity offset is a state; else a constant
  std::vector<double> border;                                     ///< 3 slots.size() + 6
  double offset_information = 0.0, offset_eta = 0.0;              ///< from measurements
  double calibrated_offset = 0.0, calibration_information = 0.0;  ///< what the calibration says of it

  int landmarkSize() const { return 3 * static_cast<int>(slots.size()); }
  int size() const { return has_pose ? landmarkSize() + 6 : 0; }

  /// A prior of the first pose alone.
  void start(const urban_nav_core::Pose& centre, const urban_nav_core::Matrix6d& pose_information);
  /// What the calibration says of the disparity offset, and how well it knows (px); with sigma 0 it is a constant.
  void startOffset(double offset, double sigma);
  /// What the calibration counts for at an offset: all of 1 / sigma^2 close to what it says, and less the further away
  /// the measurements want it, as with Student's t: most calibrations are as good as they are said to be, and some are
  /// far off.
  double calibrationInformation(double offset) const;

  /// d at the estimates.
  void deviation(const State& state, std::vector<double>& d) const;
  /// -dl/d(d) into g, -dl/do into g_offset; returns the cost l.
  double gradient(const std::vector<double>& d, double offset, std::vector<double>& g, double& g_offset) const;
  /// Moves the centre to the estimates without changing the quadratic.
  void recentre(const State& state);

  /// As much room as another has, so that copies of it allocate nothing.
  void reserveLike(const Prior& other);
  void archive(urban_nav_core::Archive& archive);

 private:
  std::vector<double> d_, g_;
};

}  // namespace swf_vo
