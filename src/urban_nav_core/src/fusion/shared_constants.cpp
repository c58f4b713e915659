// SPDX-License-Identifier: BSD-3-Clause
#include "fusion/shared_constants.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace urban_nav_core {

namespace {

constexpr int kMounting = 3;             // number of mounting constants, which come first
constexpr int kIterations = 8;           // reweighted Gauss-Newton; the problem is linear for mounting rotations of up
                                         // to about 2 deg
constexpr double kHuber = 22.46;         // squared Mahalanobis distance, 0.999 of chi-square with 6 degrees of freedom
constexpr double kContradicted = 16.27;  // squared Mahalanobis distance, 0.999 of chi-square with 3 degrees of freedom
constexpr double kFixed = 1e-9;          // rad, prior sigma of a mounting that is kept
constexpr const char* kScaleName = "scale";

/// Returns the rotation of the mounting about the position of the LiDAR.
Pose mountingChange(const Vector3d& phi, const Vector3d& p_base_lidar) {
  const Quaterniond turn = expSo3(phi);
  return Pose(turn, p_base_lidar - turn * p_base_lidar);
}

}  // namespace

SharedConstants::SharedConstants(std::vector<Stretch>& stretches, const std::vector<RelativePose>& stereo,
                                 const std::vector<RelativePose>& laser, const Vector3d& p_base_lidar,
                                 const FusionOptions& options)
    : p_base_lidar_(p_base_lidar), names_({"mounting_x", "mounting_y", "mounting_z"}) {
  prior_ = Eigen::VectorXd::Zero(kMounting);
  prior_sigma_ = Eigen::VectorXd::Constant(kMounting, options.mounting_sigma);
  const double scale_sigma = stretches.empty() ? 0.0 : options.scale_sigma;  // without overlap the scale is
                                                                             // unobservable
  addPriors(stereo, scale_sigma);
  addPriors(laser, 0.0);
  value_ = prior_;
  covariance_ = prior_sigma_.array().square().matrix().asDiagonal();
  factor_ = prior_sigma_.asDiagonal();
  estimate(stretches);
  measured_ = value_;
  keepMounting(stretches);
  Eigen::MatrixXd factor = covariance_;
  if (choleskyInPlace(factor)) factor_ = factor.triangularView<Eigen::Lower>();
}

void SharedConstants::keepMounting(std::vector<Stretch>& stretches) {
  const Matrix3d uncertainty = covariance_.topLeftCorner<kMounting, kMounting>();
  const Vector3d turn = value_.head<kMounting>();
  if (stretches.empty() || turn.dot(SmallCholesky<3>(uncertainty).solve(turn)) > kContradicted) return;
  keeps_mounting_ = true;
  prior_sigma_.head<kMounting>().setConstant(kFixed);
  value_ = prior_;
  estimate(stretches);
  covariance_.topLeftCorner<kMounting, kMounting>() = uncertainty;
}

void SharedConstants::addPriors(const std::vector<RelativePose>& steps, double scale_sigma) {
  // The newest step has the most recent estimate of its constants.
  for (auto step = steps.rbegin(); step != steps.rend(); ++step)
    for (const ConsideredConstant& constant : step->constants) {
      if (index(constant.name)) continue;
      const double widened = constant.name == kScaleName ? scale_sigma : 0.0;
      const Eigen::Index size = prior_.size();
      names_.push_back(constant.name);
      prior_.conservativeResize(size + 1);
      prior_sigma_.conservativeResize(size + 1);
      prior_[size] = constant.mean;
      prior_sigma_[size] = std::max({constant.sigma, widened, 1e-9});
    }
}

std::optional<std::size_t> SharedConstants::index(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? std::nullopt : std::optional<std::size_t>(found - names_.begin());
}

Pose SharedConstants::applyConstants(const IntervalMotion& motion, const Pose& measured) const {
  Vector6d change = Vector6d::Zero();
  for (const ConstantShare& share : motion.constants) {
    const std::optional<std::size_t> at = index(share.name);
    if (at) change -= share.used - share.sensitivity * value_[static_cast<Eigen::Index>(*at)];
  }
  return boxPlus(measured, change);
}

void SharedConstants::addConstants(const IntervalMotion& motion, Eigen::MatrixXd& sensitivity) const {
  for (const ConstantShare& share : motion.constants)
    if (const std::optional<std::size_t> at = index(share.name))
      sensitivity.col(static_cast<Eigen::Index>(*at)) += share.sensitivity;
}

Pose SharedConstants::correctedStereo(const IntervalMotion& motion) const {
  return applyConstants(motion, motion.T_from_to);
}

Pose SharedConstants::correctedLaser(const IntervalMotion& motion) const {
  const Pose change = mountingChange(value_.head<kMounting>(), p_base_lidar_);
  return applyConstants(motion, change * motion.T_from_to * change.inverse());
}

Eigen::MatrixXd SharedConstants::stereoSensitivity(const IntervalMotion& motion) const {
  Eigen::MatrixXd sensitivity = Eigen::MatrixXd::Zero(6, value_.size());
  addConstants(motion, sensitivity);
  return sensitivity;
}

Eigen::MatrixXd SharedConstants::laserSensitivity(const IntervalMotion& motion) const {
  Eigen::MatrixXd sensitivity = Eigen::MatrixXd::Zero(6, value_.size());
  addConstants(motion, sensitivity);
  const Pose turned = correctedLaser(motion);
  Eigen::Matrix<double, 6, kMounting> twist;  // rotation about the position of the LiDAR
  twist << skew(p_base_lidar_), Matrix3d::Identity();
  sensitivity.leftCols<kMounting>() = boxFromLeft(turned) * (Matrix6d::Identity() - adjoint(turned)) * twist;
  return sensitivity;
}

void SharedConstants::estimate(std::vector<Stretch>& stretches) {
  if (stretches.empty()) return;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Eigen::MatrixXd H = prior_sigma_.array().square().inverse().matrix().asDiagonal();
    Eigen::VectorXd gradient = H * (value_ - prior_);
    double sum = 0.0, weights = 0.0;
    for (Stretch& stretch : stretches) {
      const Vector6d residual = boxMinus(correctedLaser(stretch.laser), correctedStereo(stretch.stereo));
      const Eigen::MatrixXd J = laserSensitivity(stretch.laser) - stereoSensitivity(stretch.stereo);
      const SmallCholesky<6> noise(Matrix6d(stretch.laser.covariance + stretch.stereo.covariance));
      const Vector6d weighted = noise.solve(residual);
      const double distance = residual.dot(weighted);
      const double weight = distance > kHuber ? std::sqrt(kHuber / distance) : 1.0;
      const Matrix6d information = noise.inverse();
      H += weight * J.transpose() * information * J;
      gradient += weight * J.transpose() * weighted;
      stretch.statistic = distance;
      sum += weight * distance;
      weights += weight;
    }
    spread_ = std::max(1.0, sum / (6.0 * weights));
    const std::optional<Eigen::MatrixXd> inverse = invertPositiveDefinite(H);
    if (!inverse) return;
    covariance_ = spread_ * *inverse;
    if (iteration + 1 < kIterations) value_ -= *inverse * gradient;
  }
}

std::vector<SharedConstant> SharedConstants::list() const {
  std::vector<SharedConstant> constants;
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const bool is_kept = keeps_mounting_ && at < kMounting;
    constants.push_back({names_[i], is_kept ? measured_[at] : value_[at], std::sqrt(covariance_(at, at)), !is_kept});
  }
  return constants;
}

}  // namespace urban_nav_core
