// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "window/dense_cholesky.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// Prior from earlier frames (Newman et al. 2009, eq. 1 and 3): a Gaussian over the oldest pose and the landmarks
/// observed by marginalised frames, as information Pi and vector eta:
///   l(d, o) = 1/2 d^T Pi d - eta^T d + o border^T d + 1/2 o^2 offset_information - offset_eta o, d = x - centre
///   (boxMinus for the pose),
/// with o the disparity offset, in which the sensor model is linear. Order of blocks: landmarks, pose. Pi may be
/// singular: unmeasured directions have no information.
///
/// Two rules make the filter consistent. First, a block of the prior is linearised at the point of the prior in every
/// later term (linearise_first; Huang et al. 2008, "first estimates Jacobian"): the whole information is then J^T W J
/// at one set of values, and the six gauge directions have no information. Second, the robust weights of marginalised
/// terms are frozen in Pi. The textbook EKF (linearise_first off) moves the centre to each new estimate instead.
struct Prior {
  bool has_pose = false;
  bool frozen = false;     ///< terms were marginalised into it: from now on blocks are linearised where they were then.
                           ///< Before that it is a measurement like any other
  std::vector<int> slots;  ///< landmark slot of each landmark block
  std::vector<Eigen::Vector3d> landmark_centre;
  urban_nav_core::Pose pose_centre;
  DenseMatrix information;  ///< 3 slots.size() + 6
  std::vector<double> eta;
  bool has_offset = false;                                        ///< the disparity offset is a state; else a constant
  std::vector<double> border;                                     ///< 3 slots.size() + 6
  double offset_information = 0.0, offset_eta = 0.0;              ///< from measurements
  double calibrated_offset = 0.0, calibration_information = 0.0;  ///< calibrated value and its information

  int landmarkSize() const { return 3 * static_cast<int>(slots.size()); }
  int size() const { return has_pose ? landmarkSize() + 6 : 0; }

  /// Sets a prior of the first pose only.
  void start(const urban_nav_core::Pose& centre, const urban_nav_core::Matrix6d& pose_information);
  /// Sets the offset of the calibration and its standard deviation (px); with sigma 0 it is a constant.
  void startOffset(double offset, double sigma);
  /// Returns the information of the calibration at an estimate of the offset: 1 / sigma^2 close to the calibrated
  /// value, decreasing with the distance from it, as with Student's t distribution: most calibrations are as accurate
  /// as stated, and some are far off.
  double calibrationInformation(double offset) const;

  /// Computes d at the estimates.
  void deviation(const State& state, std::vector<double>& d) const;
  /// Computes -dl/d(d) in g and -dl/do in g_offset; returns the cost l.
  double gradient(const std::vector<double>& d, double offset, std::vector<double>& g, double& g_offset) const;
  /// Moves the centre to the estimates without changing the quadratic.
  void recentre(const State& state);

  /// Reserves the capacity of another prior, so that copies of it do not allocate.
  void reserveLike(const Prior& other);
  void archive(urban_nav_core::Archive& archive);

 private:
  std::vector<double> d_, g_;
};

}  // namespace swf_vo
