// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/trajectory_prior.hpp"

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace laser_mapper {

using urban_nav_core::Matrix3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::StampNs;
using urban_nav_core::Vector6d;

namespace {

constexpr StampNs kSecond = 1'000'000'000;
constexpr double kLeastStep = 1e-3, kLeastTurn = 3e-4;     // m, rad: interpolation error of poses within a second
constexpr double kUnknownStep = 0.1, kUnknownTurn = 0.02;  // m, rad: without odometry
constexpr double kFirst = 1e-6;                            // m, rad: fixes the map as a whole

Matrix6d squares(double step, double turn) {
  Vector6d diagonal;
  diagonal << step * step, step * step, step * step, turn * turn, turn * turn, turn * turn;
  return diagonal.asDiagonal();
}

/// Rotates a covariance from the axes of a pose to those of its parent.
Matrix6d turned(const Matrix6d& covariance, const Matrix3d& R) {
  Matrix6d both = Matrix6d::Zero();
  both.topLeftCorner<3, 3>() = both.bottomRightCorner<3, 3>() = R;
  return both * covariance * both.transpose();
}

}  // namespace

TrajectoryPrior::TrajectoryPrior(const urban_nav_core::Trajectory& T_map_base,
                                 const urban_nav_core::OdometryChain* odometry, StampNs begin, std::size_t count) {
  for (std::size_t k = 0; k + 1 < count; ++k) {
    const StampNs from = begin + static_cast<StampNs>(k) * kSecond, to = from + kSecond;
    const urban_nav_core::Pose& a = T_map_base[T_map_base.nearest(from)].pose;
    const urban_nav_core::Pose& b = T_map_base[T_map_base.nearest(to)].pose;
    Step step;
    step.carry.topRightCorner<3, 3>() = -urban_nav_core::skew(b.t() - a.t());
    Matrix6d covariance = squares(kLeastStep, kLeastTurn);
    if (odometry != nullptr) {
      const auto between =
          odometry->between(T_map_base[T_map_base.nearest(from)].stamp, T_map_base[T_map_base.nearest(to)].stamp);
      covariance += between ? turned(between->covariance, a.R()) : squares(kUnknownStep, kUnknownTurn);
    }
    step.information = urban_nav_core::SmallCholesky<6>(covariance).inverse();
    steps_.push_back(step);
  }
}

void TrajectoryPrior::addTo(const std::vector<PoseCorrection>& corrections, Eigen::MatrixXd& information,
                            Eigen::VectorXd& gradient) const {
  information.topLeftCorner<6, 6>() += Matrix6d::Identity() / (kFirst * kFirst);
  gradient.head<6>() -= corrections.front() / (kFirst * kFirst);
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const Step& step = steps_[k];
    const auto at = static_cast<Eigen::Index>(6 * k);
    const Vector6d residual = step.information * (corrections[k + 1] - step.carry * corrections[k]);
    const Matrix6d cross = step.information * step.carry;
    information.block<6, 6>(at, at) += step.carry.transpose() * cross;
    information.block<6, 6>(at + 6, at) -= cross;
    information.block<6, 6>(at + 6, at + 6) += step.information;
    gradient.segment<6>(at) += step.carry.transpose() * residual;
    gradient.segment<6>(at + 6) -= residual;
  }
}

Eigen::MatrixXd TrajectoryPrior::transformed(const Eigen::MatrixXd& W) const {
  Eigen::MatrixXd sum = W.topRows<6>().transpose() * W.topRows<6>() / (kFirst * kFirst);
  for (std::size_t k = 0; k < steps_.size(); ++k) {
    const auto at = static_cast<Eigen::Index>(6 * k);
    const Eigen::MatrixXd change = W.middleRows<6>(at + 6) - steps_[k].carry * W.middleRows<6>(at);
    sum += change.transpose() * (steps_[k].information * change);
  }
  return sum;
}

}  // namespace laser_mapper
