// SPDX-License-Identifier: BSD-3-Clause
#include "window/landmark_score.hpp"

#include "urban_nav_core/io/archive_types.hpp"
#include "window/gauge.hpp"

namespace swf_vo {

using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;

namespace {

// Pivots below this share of a coordinate's information are rounding errors.
constexpr double kLeastThetaPivot = 1e-12;

}  // namespace

void LandmarkScore::add(const LandmarkBlock& landmark, const PoseBlock& pose, double view_change,
                        const SensorTerm& term) {
  if (!used_) {
    used_ = true;
    born_ = view_change;
    reference_ = landmark.estimate;
    anchor_ = landmark.anchor;
    information_.setZero();
    score_.setZero();
  }
  last_ = view_change;
  const Matrix6d G = (view_change - born_) * gauge::ofPose(pose.linearised, anchor_.t_odom_anchor);
  const Vector3d moved = landmark.estimate - reference_;
  const Matrix63d cross = G.transpose() * term.cross;
  information_.topLeftCorner<3, 3>() += term.landmark;
  information_.block<6, 3>(3, 0) += cross;
  information_.block<3, 6>(0, 3) += cross.transpose();
  information_.block<6, 6>(3, 3) += G.transpose() * term.pose * G;
  Eigen::Matrix<double, 9, 1> border;
  border << term.landmark_border, G.transpose() * term.pose_border;
  information_.topRightCorner<9, 1>() += border;
  information_.bottomLeftCorner<1, 9>() += border.transpose();
  information_(9, 9) += term.border_information;
  score_.head<3>() += term.landmark_gradient + term.landmark * moved;
  score_.segment<6>(3) += G.transpose() * term.pose_gradient + cross * moved;
  score_[9] += term.border_gradient + term.landmark_border.dot(moved);
}

// Pi - Pi E (I + Q E^T Pi E)^-1 Q E^T Pi, also valid for singular Q.
void LandmarkScore::age(const Eigen::Matrix2d& covariance) {
  if (!used_) return;
  const Eigen::Matrix2d known = information_.topLeftCorner<2, 2>();
  const Eigen::Matrix2d A = Eigen::Matrix2d::Identity() + covariance * known;
  Eigen::Matrix2d adjugate;
  adjugate << A(1, 1), -A(0, 1), -A(1, 0), A(0, 0);
  const Eigen::Matrix2d lost = adjugate * covariance / (A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0));
  const Eigen::Matrix<double, 10, 2> columns = information_.leftCols<2>();
  score_ -= columns * (lost * score_.head<2>().eval());
  information_ -= columns * lost * columns.transpose();
}

DriftScore LandmarkScore::evaluate(const Pose& T_odom_camera) const {
  Matrix10d A = information_;
  Vector10d b = score_;
  for (int j = 0; j < 3; ++j) {
    if (!(A(j, j) > kLeastThetaPivot * information_(j, j))) continue;
    for (int i = j + 1; i < 10; ++i) {
      const double factor = A(i, j) / A(j, j);
      b[i] -= factor * b[j];
      for (int k = j + 1; k < 10; ++k) A(i, k) -= factor * A(j, k);
    }
  }
  const Matrix6d moved = gauge::transport(T_odom_camera.t(), anchor_.t_odom_anchor);
  const Eigen::Matrix3d R = T_odom_camera.R();
  Matrix6d T;
  T.leftCols<3>() = moved.leftCols<3>() * R;
  T.rightCols<3>() = moved.rightCols<3>() * R;
  DriftScore result;
  result.score = T.transpose() * b.segment<6>(3);
  const Matrix6d information = T.transpose() * A.block<6, 6>(3, 3) * T;
  result.information = 0.5 * (information + information.transpose());
  result.offset_score = b[9];
  result.offset_information = A(9, 9);
  result.offset_cross = T.transpose() * A.block<6, 1>(3, 9);
  result.life = last_ - born_;
  const Eigen::Vector4d point = anchor_.homogeneous(reference_);
  const Vector3d ray = R.transpose() * (point.head<3>() - point.w() * T_odom_camera.t());
  if (ray.z() > 0.0) result.direction = ray.head<2>() / ray.z();
  return result;
}

void LandmarkScore::archive(urban_nav_core::Archive& archive) {
  archive(used_);
  if (used_) archive(born_, last_, reference_, anchor_, information_, score_);
}

}  // namespace swf_vo
