// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/align.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <cassert>
#include <cmath>
#include <ostream>

namespace urban_nav_core {
namespace {

Vector3d centre(const std::vector<Pose>& poses) {
  Vector3d sum = Vector3d::Zero();
  for (const Pose& pose : poses) sum += pose.t();
  return sum / static_cast<double>(poses.size());
}

// Returns the rotation R that maximises trace(R^T M), with det R = 1 (Umeyama, eq. 40-43).
Matrix3d bestRotation(const Matrix3d& M) {
  const Eigen::JacobiSVD<Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Vector3d sign = Vector3d::Ones();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) sign.z() = -1.0;
  return svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
}

Similarity umeyama(const std::vector<Pose>& truth, const std::vector<Pose>& estimate, bool with_scale) {
  assert(!truth.empty() && truth.size() == estimate.size());
  const auto n = static_cast<double>(truth.size());
  const Vector3d mean_truth = centre(truth), mean_estimate = centre(estimate);
  Matrix3d covariance = Matrix3d::Zero();
  double variance = 0.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Vector3d p = estimate[i].t() - mean_estimate;
    covariance += (truth[i].t() - mean_truth) * p.transpose() / n;
    variance += p.squaredNorm() / n;
  }
  // Weight of the first heading, which determines the rotation about the line of collinear positions: negligible if the
  // positions determine it, but far above rounding otherwise.
  constexpr double kTieBreak = 1e-9;
  const double size = covariance.norm();
  const Matrix3d heading = (truth.front().q() * estimate.front().q().conjugate()).toRotationMatrix();
  const Eigen::JacobiSVD<Matrix3d> svd(covariance);
  const bool open = !(svd.singularValues()[1] > 1e-6 * size) || !(size > 0.0);
  const Matrix3d R =
      bestRotation(open ? Matrix3d(covariance + (size > 0.0 ? kTieBreak * size : 1.0) * heading) : covariance);

  Similarity similarity;
  if (with_scale && variance > 0.0) similarity.scale = (R.transpose() * covariance).trace() / variance;
  if (!(similarity.scale > 0.0)) similarity.scale = 1.0;
  similarity.T_truth_estimate = Pose(R, mean_truth - similarity.scale * (R * mean_estimate));
  return similarity;
}

}  // namespace

Pose Similarity::operator*(const Pose& pose) const { return Pose(T_truth_estimate.q() * pose.q(), *this * pose.t()); }

Similarity alignFirst(const std::vector<Pose>& truth, const std::vector<Pose>& estimate) {
  assert(!truth.empty() && !estimate.empty());
  return {1.0, truth.front() * estimate.front().inverse()};
}

Similarity alignSe3(const std::vector<Pose>& truth, const std::vector<Pose>& estimate) {
  return umeyama(truth, estimate, false);
}
Similarity alignSim3(const std::vector<Pose>& truth, const std::vector<Pose>& estimate) {
  return umeyama(truth, estimate, true);
}

bool isApprox(const Similarity& a, const Similarity& b, double tolerance) {
  return std::abs(a.scale - b.scale) <= tolerance && isApprox(a.T_truth_estimate, b.T_truth_estimate, tolerance);
}

std::ostream& operator<<(std::ostream& out, const Similarity& similarity) {
  return out << "scale = " << similarity.scale << ", " << similarity.T_truth_estimate;
}

}  // namespace urban_nav_core
