// SPDX-License-Identifier: BSD-3-Clause
#include "window/datum.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/dense_kernels.hpp"
#include "window/gauge.hpp"

namespace swf_vo {

namespace kernels = urban_nav_core::kernels;

using Eigen::Vector3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::Vector6d;

namespace {

bool invert(Matrix6d A, Matrix6d& result) {
  result.setIdentity();
  return urban_nav_core::solvePositiveDefiniteInPlace(A, result);
}

using Columns = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, 6>>;

Matrix6d symmetric(const Matrix6d& A) { return 0.5 * (A + A.transpose()); }

}  // namespace

void Datum::start(const Prior& prior) {
  origin_ = first_ = prior.pose_centre.t();
  for (int j = 0; j < 6; ++j)
    for (int i = j; i < 6; ++i) information_(i, j) = information_(j, i) = prior.information(i, j);
  carried_.setZero();
  along_px_.setZero();
  along_used_.setZero();
  release_.reset();
  shifted_per_px_ = squared_steps_ = 0.0;
  growth_.setZero();
  strength_m_ = strength_rad_ = 0.0;
  Matrix6d covariance;
  active_ = invert(information_, covariance);
}

void Datum::start(const Prior& prior, const Matrix6d& carried) {
  start(prior);
  carried_ = carried;
}

void Datum::moveTo(const Vector3d& origin) {
  const Matrix6d there = gauge::transport(origin_, origin), back = gauge::transport(origin, origin_);
  carried_ = symmetric(there * carried_ * there.transpose());
  along_px_ = there * along_px_;
  along_used_ = there * along_used_;
  step_ = origin - origin_;
  information_ = symmetric(back.transpose() * information_ * back);
  origin_ = origin;
}

void Datum::marginalised(const Matrix6d& loss) {
  growth_.setZero();
  const Matrix6d left = symmetric(information_ - loss);
  Matrix6d before, after;
  if (!invert(information_, before) || !invert(left, after)) {
    disable();
    return;
  }
  information_ = left;
  growth_ = symmetric(before * loss * after);
}

void Datum::scaleGrowth(const DriftSandwich::Ratio& ratio) {
  Vector6d scale;
  scale << Vector3d::Constant(std::sqrt(ratio.translation)), Vector3d::Constant(std::sqrt(ratio.rotation));
  const Matrix6d scaled = symmetric(scale.asDiagonal() * growth_ * scale.asDiagonal());
  carried_ += scaled - growth_;
  growth_ = scaled;
}

// Computes G and u = Pi G.
void Datum::computeGaugeProducts(const State& state, const Prior& prior) {
  const int n = prior.size();
  gauge::ofPrior(state, prior, origin_, directions_);
  held_.assign(static_cast<std::size_t>(6 * n), 0.0);
  const Columns G(directions_.data(), n, 6);
  Columns u(held_.data(), n, 6);
  for (int c = 0; c < 6; ++c)
    for (int j = 0; j < n; ++j) {
      const double* below = prior.information.column(j) + j + 1;
      u(j, c) += below[-1] * G(j, c) + kernels::dot(below, &G(j, c) + 1, n - j - 1);
      kernels::subtract(&u(j, c) + 1, below, -G(j, c), n - j - 1);
    }
}

Vector6d Datum::releaseOffset(const State& state, Prior& prior) {
  Vector6d per_px = Vector6d::Zero();
  release_.reset();
  if (!prior.has_offset || !active_) return per_px;
  computeGaugeProducts(state, prior);
  const int n = prior.size();
  const Columns G(directions_.data(), n, 6), u(held_.data(), n, 6);
  Matrix6d covariance;
  if (!invert(symmetric(G.transpose() * u), covariance)) return per_px;
  Eigen::Map<Eigen::VectorXd> border(prior.border.data(), n);
  const Vector6d along = G.transpose() * border;
  per_px = -(covariance * along);
  // The gradients at the estimates are preserved.
  double offset_gradient = 0.0;
  prior.deviation(state, deviation_);
  prior.gradient(deviation_, state.disparity_offset, gradient_, offset_gradient);
  product_.resize(static_cast<std::size_t>(n));
  Eigen::Map<Eigen::VectorXd> released(product_.data(), n);
  released.noalias() = u * (-per_px);
  border -= released;
  prior.offset_information -= along.dot(covariance * along);
  Eigen::Map<Eigen::VectorXd>(prior.eta.data(), n) -= released * state.disparity_offset;
  prior.offset_eta = offset_gradient + border.dot(Eigen::Map<const Eigen::VectorXd>(deviation_.data(), n)) +
                     prior.offset_information * state.disparity_offset;
  along_px_ += per_px;
  along_used_ += per_px * state.disparity_offset;
  release_ = Release{per_px, state.disparity_offset};
  shifted_per_px_ += per_px.head<3>().dot(step_);
  squared_steps_ += step_.squaredNorm();
  return per_px;
}

double Datum::scaleSigma() const {
  const double per_px = squared_steps_ > 0.0 ? shifted_per_px_ / squared_steps_ : 0.0;
  return std::sqrt(rig_scale_ * rig_scale_ + per_px * per_px * offset_.error());
}

bool Datum::fixGauge(const Matrix6d& local, double ratio, const State& state, Prior& prior) {
  Matrix6d covariance;
  strength_m_ = std::max(strength_m_, local.diagonal().head<3>().maxCoeff());
  strength_rad_ = std::max(strength_rad_, local.diagonal().tail<3>().maxCoeff());
  if (!invert(information_, covariance)) return false;
  const double looseness = std::max(covariance.diagonal().head<3>().maxCoeff() * strength_m_,
                                    covariance.diagonal().tail<3>().maxCoeff() * strength_rad_);
  if (looseness < ratio) return false;

  computeGaugeProducts(state, prior);
  const int n = prior.size();
  const Columns G(directions_.data(), n, 6), u(held_.data(), n, 6);
  const Matrix6d M = symmetric(G.transpose() * u);
  if (!invert(M, covariance)) return false;
  Matrix6d W = M, held;
  for (int i = 0; i < 6; ++i) W(i, i) += i < 3 ? strength_m_ : strength_rad_;
  if (!invert(W, held)) return false;

  // Pi + v (W - M) v^T with unchanged gradient along gamma: with d the deviation, gradient = eta - Pi d.
  prior.deviation(state, deviation_);
  double unchanged = 0.0;
  prior.gradient(deviation_, state.disparity_offset, gradient_, unchanged);
  Eigen::Map<Eigen::VectorXd> gradient(gradient_.data(), n);
  const Matrix6d added = covariance * (W - M) * covariance;
  const Vector6d drawn = added * (G.transpose() * gradient);
  gradient.noalias() += u * drawn;
  for (int j = 0; j < n; ++j) {
    const Vector6d row = added * u.row(j).transpose();
    for (int c = 0; c < 6; ++c) kernels::subtract(prior.information.column(j) + j, &u(j, c), -row[c], n - j);
  }
  std::fill(prior.eta.begin(), prior.eta.end(), 0.0);
  prior.gradient(deviation_, state.disparity_offset, product_, unchanged);
  for (std::size_t i = 0; i < product_.size(); ++i) prior.eta[i] = gradient_[i] - product_[i];

  shift_ = symmetric(covariance - held);
  carried_ += shift_;
  information_ = W;
  return true;
}

Matrix6d Datum::carried(const urban_nav_core::Pose& T_odom_camera) const {
  const Matrix6d G = gauge::ofPose(T_odom_camera, origin_);
  const Vector6d along = G * along_px_, displaced = G * (along_used_ - offset_.mean * along_px_);
  Matrix6d result =
      G * carried_ * G.transpose() + offset_.variance * along * along.transpose() + displaced * displaced.transpose();
  const Vector3d path = T_odom_camera.t() - first_;
  result.topLeftCorner<3, 3>() += rig_scale_ * rig_scale_ * path * path.transpose();
  return symmetric(result);
}

void archive(urban_nav_core::Archive& archive, Datum::Release& release) { archive(release.per_px, release.used); }

void Datum::archive(urban_nav_core::Archive& archive) {
  archive(active_, origin_, information_, carried_, growth_, shift_, along_px_, along_used_, strength_m_,
          strength_rad_);
  archive(offset_.used, offset_.mean, offset_.variance, first_, step_, rig_scale_, shifted_per_px_, squared_steps_);
  archive(release_);
}

}  // namespace swf_vo
