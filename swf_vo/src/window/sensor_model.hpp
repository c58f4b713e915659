// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "urban_nav_core/camera/stereo_camera.hpp"
#include "urban_nav_core/geometry/se3.hpp"

namespace swf_vo {

/// A landmark in inverse depth relative to a constant anchor frame: the point ((a, b, 1) / rho) in the frame `anchor`,
/// which is the camera of the first observation *as estimated at that time*: a constant, not a state. A landmark is
/// therefore a fixed point of `odom`, the stereo pixel is nearly linear in theta = (a, b, rho), and points near
/// infinity (rho = 0, also slightly negative while estimating) need no special case.
struct Anchor {
  Eigen::Matrix3d R_odom_anchor = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_odom_anchor = Eigen::Vector3d::Zero();

  /// (x, y, z, w): the point (x, y, z) / w in `odom`.
  Eigen::Vector4d homogeneous(const Eigen::Vector3d& theta) const;
};

/// A pose in the form required by the sensor model, computed once for many landmarks.
struct PoseMatrices {
  Eigen::Matrix3d R_camera_odom = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t_odom_camera = Eigen::Vector3d::Zero();

  PoseMatrices() = default;
  explicit PoseMatrices(const urban_nav_core::Pose& T_odom_camera);
};

/// z_ij = h(x_m(i), x_p(j)) + v (Newman et al. 2009, section 2.1 and eq. 2): stereo pixel (u_left, v, u_right) of a
/// landmark. h depends only on the point relative to the camera and is invariant to a common motion of both: its
/// Jacobians at one set of values have no component in the six gauge directions.
class SensorModel {
 public:
  explicit SensorModel(const urban_nav_core::StereoCamera& camera);

  struct Linearised {
    Eigen::Matrix3d
        H;  ///< dz/dw, w being the point as seen from the camera's place, scaled by rho, in the axes of odom
    Eigen::Vector3d w;  ///< dz/dw, w being the point relative to the camera centre, scaled by rho, in the axes of odom
    double rho = 0.0;
    Eigen::Matrix3d landmark;  ///< dz/dtheta

    /// dz/dpose for boxPlus: [-rho H, H [w]x].
    Eigen::Matrix<double, 3, 6> pose() const;
  };

  /// Computes h; returns false, with z unchanged, if the point is not in front of the camera.
  bool predict(const Anchor& anchor, const Eigen::Vector3d& theta, const PoseMatrices& pose, Eigen::Vector3d& z) const;
  /// Computes both exact Jacobians; returns false if the point is not in front of the camera.
  bool linearise(const Anchor& anchor, const Eigen::Vector3d& theta, const PoseMatrices& pose,
                 Linearised& result) const;

  /// Returns theta of a landmark whose anchor is the camera that measured z. Defined for any finite z; a negative
  /// disparity gives rho < 0.
  Eigen::Vector3d invert(const Eigen::Vector3d& z) const;
  /// Transforms a covariance of left-image pixels to one of (a, b).
  Eigen::Matrix2d bearing(const Eigen::Matrix2d& covariance_px) const;

 private:
  double fx_, fy_, cx_, cy_, baseline_;
};

}  // namespace swf_vo
