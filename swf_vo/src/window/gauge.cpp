// SPDX-License-Identifier: BSD-3-Clause
#include "window/gauge.hpp"

#include "window/reserve_with_headroom.hpp"

namespace swf_vo::gauge {

using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::skew;

Matrix6d transport(const Vector3d& from, const Vector3d& to) {
  Matrix6d A = Matrix6d::Identity();
  A.topRightCorner<3, 3>() = -skew(to - from);
  return A;
}

Matrix6d ofPose(const urban_nav_core::Pose& T_odom_camera, const Vector3d& origin) {
  return transport(origin, T_odom_camera.t());
}

Eigen::Matrix<double, 3, 6> ofLandmark(const Anchor& anchor, const Vector3d& theta, const Vector3d& origin) {
  // The homogeneous point (W, rho) relative to `origin` moves by (rho shift + turn x W, 0); theta is this point divided
  // by its depth in the anchor.
  const Vector3d W =
      anchor.R_odom_anchor * Vector3d(theta.x(), theta.y(), 1.0) + theta.z() * (anchor.t_odom_anchor - origin);
  Eigen::Matrix<double, 3, 6> moved;
  moved.leftCols<3>() = theta.z() * anchor.R_odom_anchor.transpose();
  moved.rightCols<3>() = -anchor.R_odom_anchor.transpose() * skew(W);
  Eigen::Matrix<double, 3, 6> G;
  G.row(0) = moved.row(0) - theta.x() * moved.row(2);
  G.row(1) = moved.row(1) - theta.y() * moved.row(2);
  G.row(2) = -theta.z() * moved.row(2);
  return G;
}

void ofPrior(const State& state, const Prior& prior, const Vector3d& origin, std::vector<double>& directions) {
  const Eigen::Index n = prior.size();
  reserveWithHeadroom(directions, static_cast<std::size_t>(6 * n));
  directions.resize(static_cast<std::size_t>(6 * n));
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 6>> G(directions.data(), n, 6);
  for (std::size_t i = 0; i < prior.slots.size(); ++i)
    G.middleRows<3>(static_cast<Eigen::Index>(3 * i)) =
        ofLandmark(state.landmarks[static_cast<std::size_t>(prior.slots[i])].anchor, prior.landmark_centre[i], origin);
  G.middleRows<6>(prior.landmarkSize()) = ofPose(prior.pose_centre, origin);
}

}  // namespace swf_vo::gauge
