// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <map>
#include <vector>

#include "urban_nav_core/geometry/compose.hpp"
#include "window/sensor_model.hpp"
#include "window/window.hpp"

namespace swf_vo {

/// Textbook EKF-SLAM (Thrun et al. 2005, chapter 10) in covariance form: propagate, remove the old pose, augment,
/// update. Only the models are shared with the window. `first_estimates`: Jacobians at the first estimates (Huang et
/// al. 2008) instead of the latest.
class EkfReference {
 public:
  EkfReference(const urban_nav_core::StereoCamera& camera, bool first_estimates)
      : sensor_(camera), first_(first_estimates) {}

  urban_nav_core::Pose pose;
  Eigen::MatrixXd P;  ///< landmarks in order of `order_`, then the pose

  void start(const urban_nav_core::Pose& T, const urban_nav_core::Matrix6d& covariance) {
    pose = pose_first_ = T;
    P = covariance;
  }

  void propagate(const ProcessInput& u) {
    augmentFirst();
    const urban_nav_core::Pose last = pose, last_first = pose_first_;
    pose = pose_first_ = last * u.T_from_to;
    const auto at = process_model::residual(first_ ? last_first : last, pose, u.T_from_to);
    // A d_last + B d_next = w.
    const urban_nav_core::Matrix6d B = at.next.inverse();
    const urban_nav_core::Matrix6d F = -B * at.last;
    const urban_nav_core::Matrix6d Q = (u.information + process_model::floor()).inverse();
    const Eigen::Index n = P.rows() - 6;
    P.bottomRows(6) = (F * P.bottomRows(6)).eval();
    P.rightCols(6) = (P.rightCols(6) * F.transpose()).eval();
    P.block(n, n, 6, 6) += B * Q * B.transpose();
    left_over_.tail<6>() = (F * left_over_.tail<6>()).eval();
  }

  void forget(LandmarkId id) {
    for (std::size_t i = 0; i < landmarks_.size(); ++i)
      if (landmarks_[i].id == id) {
        const Eigen::Index at = 3 * static_cast<Eigen::Index>(i), n = P.rows();
        Eigen::MatrixXd reduced(n - 3, n - 3);
        reduced << P.topLeftCorner(at, at), P.topRightCorner(at, n - at - 3), P.bottomLeftCorner(n - at - 3, at),
            P.bottomRightCorner(n - at - 3, n - at - 3);
        P = reduced;
        Eigen::VectorXd shorter(n - 3);
        if (first_) {
          shorter << left_over_.head(at), left_over_.tail(n - at - 3);
          left_over_ = shorter;
        }
        landmarks_.erase(landmarks_.begin() + static_cast<std::ptrdiff_t>(i));
        return;
      }
    fresh_.erase(id);
  }

  void update(const std::vector<Observation>& observations) {
    std::vector<Observation> known;
    const PoseMatrices at_pose(pose), at_first(pose_first_);
    for (const Observation& observation : observations) {
      if (find(observation.landmark) >= 0) {
        known.push_back(observation);
        continue;
      }
      Landmark landmark;
      landmark.id = observation.landmark;
      landmark.anchor.R_odom_anchor = pose.R();
      landmark.anchor.t_odom_anchor = pose.t();
      landmark.theta = landmark.theta_first = sensor_.invert(observation.z);
      if (first_) fresh_[landmark.id] = {landmark, observation};
      else augment(landmark, observation, at_pose);
    }
    Eigen::VectorXd dx = Eigen::VectorXd::Zero(P.rows());
    if (first_) dx = left_over_;
    const std::vector<Landmark> before = landmarks_;
    for (const Observation& observation : known) {
      const std::size_t i = static_cast<std::size_t>(find(observation.landmark));
      const Landmark& landmark = landmarks_[i];
      Eigen::Vector3d z;
      SensorModel::Linearised at;
      if (!sensor_.predict(landmark.anchor, landmark.theta, at_pose, z)) throw 1;
      if (!sensor_.linearise(landmark.anchor, first_ ? landmark.theta_first : landmark.theta,
                             first_ ? at_first : at_pose, at))
        throw 1;
      Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, P.rows());
      H.block<3, 3>(0, 3 * static_cast<Eigen::Index>(i)) = at.landmark;
      H.rightCols<6>() = at.pose();
      const Eigen::MatrixXd PHt = P * H.transpose();
      const Eigen::Matrix3d S = H * PHt + observation.information.inverse();
      const Eigen::MatrixXd K = PHt * S.inverse();
      dx += K * (observation.z - z - H * dx);
      P -= K * PHt.transpose();
      P = 0.5 * (P + P.transpose()).eval();
    }
    for (std::size_t i = 0; i < landmarks_.size(); ++i)
      landmarks_[i].theta += dx.segment<3>(3 * static_cast<Eigen::Index>(i));
    const urban_nav_core::Vector6d d = dx.tail<6>();
    // A landmark initialised in this frame moves with the pose, as its measurement requires.
    for (auto& [id, birth] : fresh_) {
      SensorModel::Linearised at;
      sensor_.linearise(birth.first.anchor, birth.first.theta, at_first, at);
      birth.first.theta -= at.landmark.inverse() * at.pose() * d;
      birth.first.theta_first = birth.first.theta;
    }
    pose = urban_nav_core::boxPlus(pose, d);
    if (first_) keepLeftOver(known, before, at_pose, at_first, dx);
  }

  urban_nav_core::Matrix6d covariance() const { return P.bottomRightCorner<6, 6>(); }

 private:
  // With fixed Jacobians the residuals are recomputed at the new estimate, as in a further Gauss-Newton step: their
  // remainder after one linear step shifts the mean from the estimate.
  struct Landmark {
    LandmarkId id = 0;
    Anchor anchor;
    Eigen::Vector3d theta, theta_first;
  };

  void keepLeftOver(const std::vector<Observation>& known, const std::vector<Landmark>& before,
                    const PoseMatrices& at_pose, const PoseMatrices& at_first, const Eigen::VectorXd& dx) {
    left_over_ = Eigen::VectorXd::Zero(P.rows());
    const PoseMatrices now(pose);
    for (const Observation& observation : known) {
      const std::size_t i = static_cast<std::size_t>(find(observation.landmark));
      Eigen::Vector3d z, z_before;
      SensorModel::Linearised at;
      sensor_.predict(before[i].anchor, before[i].theta, at_pose, z_before);
      sensor_.predict(landmarks_[i].anchor, landmarks_[i].theta, now, z);
      sensor_.linearise(landmarks_[i].anchor, landmarks_[i].theta_first, at_first, at);
      Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3, P.rows());
      H.block<3, 3>(0, 3 * static_cast<Eigen::Index>(i)) = at.landmark;
      H.rightCols<6>() = at.pose();
      left_over_ += P * H.transpose() * observation.information * (z_before + H * dx - z);
    }
  }

  int find(LandmarkId id) const {
    for (std::size_t i = 0; i < landmarks_.size(); ++i)
      if (landmarks_[i].id == id) return static_cast<int>(i);
    return -1;
  }

  // From H_p d_pose + H_theta d_theta + v = 0.
  void augment(const Landmark& landmark, const Observation& observation, const PoseMatrices& at_pose,
               const Eigen::Vector3d& unexplained = Eigen::Vector3d::Zero()) {
    SensorModel::Linearised at;
    if (!sensor_.linearise(landmark.anchor, landmark.theta_first, at_pose, at)) throw 1;
    const Eigen::Matrix3d inverse = at.landmark.inverse();
    const Eigen::Matrix<double, 3, 6> G = -inverse * at.pose();
    const Eigen::Index n = P.rows(), m = n - 6;
    Eigen::MatrixXd grown(n + 3, n + 3);
    const Eigen::MatrixXd cross = G * P.bottomRows(6);  // 3 x n
    grown.topLeftCorner(m, m) = P.topLeftCorner(m, m);
    grown.block(0, m + 3, m, 6) = P.topRightCorner(m, 6);
    grown.block(m + 3, 0, 6, m) = P.bottomLeftCorner(6, m);
    grown.bottomRightCorner(6, 6) = P.bottomRightCorner(6, 6);
    grown.block(m, 0, 3, m) = cross.leftCols(m);
    grown.block(m, m + 3, 3, 6) = cross.rightCols(6);
    grown.block(0, m, m, 3) = cross.leftCols(m).transpose();
    grown.block(m + 3, m, 6, 3) = cross.rightCols(6).transpose();
    grown.block(m, m, 3, 3) =
        cross.rightCols(6) * G.transpose() + inverse * observation.information.inverse() * inverse.transpose();
    P = grown;
    if (first_) {
      Eigen::VectorXd longer(n + 3);
      longer << left_over_.head(m), G * left_over_.tail<6>() + inverse * unexplained, left_over_.tail<6>();
      left_over_ = longer;
    }
    landmarks_.push_back(landmark);
  }

  // The first estimate of a landmark is that after the update of its first frame.
  void augmentFirst() {
    const PoseMatrices at_first(pose_first_), at_pose(pose);
    for (auto& [id, birth] : fresh_) {
      Eigen::Vector3d z;
      sensor_.predict(birth.first.anchor, birth.first.theta, at_pose, z);
      augment(birth.first, birth.second, at_first, birth.second.z - z);
    }
    fresh_.clear();
  }

  SensorModel sensor_;
  bool first_;
  urban_nav_core::Pose pose_first_;
  Eigen::VectorXd left_over_ = Eigen::VectorXd::Zero(6);
  std::vector<Landmark> landmarks_;
  std::map<LandmarkId, std::pair<Landmark, Observation>> fresh_;
};

}  // namespace swf_vo
