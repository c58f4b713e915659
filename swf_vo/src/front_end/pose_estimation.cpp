// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/pose_estimation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "front_end/refine.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace swf_vo {

using urban_nav_core::expSo3;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::skew;
using urban_nav_core::StereoCamera;
using urban_nav_core::Vector6d;

namespace {

constexpr double kCauchy2 = 5.7;  // (2.385 sigma)^2: 95 % efficiency, Zhang 1997
constexpr double kGate = 16.3;    // chi-square, 3 degrees of freedom, 99.9 %
constexpr int kMostPoseSteps = 12;
constexpr double kPredictionBonus = 0.9;  // a pose found by consensus must have a lower cost than this share of the
                                          // best start's
constexpr double kClearMajority = 0.35;   // share of the highest cost; below, no other motion is searched
constexpr double kFullTrustAge = 6.0;     // frames

// Constrains the pose where collinear points or too few matches leave it undetermined.
constexpr double kAnchorM = 1.0, kAnchorRad = 0.2;

/// Returns the covariance of a landmark's predicted measurement due to the error of its first disparity, which is
/// projected as the camera moves and averages out with further measurements.
Eigen::Matrix3d mapCovariance(const StereoCamera& camera, const Track& track, const Pose& T_camera_odom,
                              double inverse_depth) {
  const Pose T_camera_born = T_camera_odom * track.T_born_odom.inverse();
  const double per_px = 1.0 / (camera.left.fx * camera.baseline);
  const Eigen::Vector3d p = T_camera_born.q() * track.ray + T_camera_born.t() * inverse_depth;
  if (!(p.z() > 1e-3)) return Eigen::Matrix3d::Zero();
  const Eigen::Vector3d t = T_camera_born.t();
  const double du = camera.left.fx * (t.x() - p.x() / p.z() * t.z()) / p.z();
  const double dv = camera.left.fy * (t.y() - p.y() / p.z() * t.z()) / p.z();
  const double dd = camera.left.fx * camera.baseline * (1.0 - inverse_depth * t.z() / p.z()) / p.z();
  const Eigen::Vector3d s = per_px * Eigen::Vector3d(du, dv, du - dd);
  return s * s.transpose() * (track.sigma_disparity * track.sigma_disparity / std::max(1, track.seen));
}

Pose apply(const Vector6d& step, const Pose& T) {
  const auto turn = expSo3(step.tail<3>());
  return {turn * T.q(), turn * T.t() + step.head<3>()};
}

}  // namespace

void PoseEstimator::prepare(const Pose& T_camera_odom, const PoseEstimatorOptions& options,
                            const std::vector<Match>& matches) {
  items_.clear();
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Match& match = matches[i];
    if (!match.measured) continue;
    Item item;
    item.p_odom = match.p_odom;
    item.z = match.z;
    item.match = static_cast<int>(i);
    item.trust = std::min(1.0, 0.1 + match.track->seen / kFullTrustAge);
    Eigen::Matrix3d extra = mapCovariance(camera_, *match.track, T_camera_odom, inverseDepthWhereBorn(match));
    extra.diagonal().array() += options.slack_px * options.slack_px;
    // (R + extra)^-1 without inverting the information, which may be singular
    const Eigen::Matrix3d own = match.information / match.inflation;
    const Eigen::Matrix3d sum = Eigen::Matrix3d::Identity() + own * extra;
    item.information = sum.inverse() * own;
    item.information = (0.5 * (item.information + item.information.transpose())).eval();
    if (item.information.allFinite()) items_.push_back(item);
  }
}

bool PoseEstimator::residual(const Item& item, const Pose& T_camera_odom, Eigen::Vector3d& e,
                             Eigen::Matrix<double, 3, 6>* J) const {
  const auto& c = camera_.left;
  const double w = item.p_odom.w();
  const Eigen::Vector3d p = T_camera_odom.q() * item.p_odom.head<3>() + T_camera_odom.t() * w;
  if (!(p.z() > 1e-6)) return false;
  const double iz = 1.0 / p.z(), x = p.x() * iz, y = p.y() * iz, r = (p.x() - camera_.baseline * w) * iz;
  e = item.z - Eigen::Vector3d(c.fx * x + c.cx, c.fy * y + c.cy, c.fx * r + c.cx - camera_.disparity_offset);
  if (J != nullptr) {
    Eigen::Matrix3d P;
    P << c.fx * iz, 0.0, -c.fx * x * iz, 0.0, c.fy * iz, -c.fy * y * iz, c.fx * iz, 0.0, -c.fx * r * iz;
    J->leftCols<3>() = P * w;
    J->rightCols<3>() = -P * skew(p);
  }
  return true;
}

Pose PoseEstimator::descend(Pose T, int steps, const std::array<int, kSampleSize>* only) const {
  const Pose anchor = T;
  for (int step = 0; step < steps; ++step) {
    Matrix6d H = Matrix6d::Zero();
    Vector6d b = Vector6d::Zero();
    const auto add = [&](const Item& item) {
      Eigen::Vector3d e;
      Eigen::Matrix<double, 3, 6> J;
      if (!residual(item, T, e, &J)) return;
      const Eigen::Vector3d Ie = item.information * e;
      const double weight = only != nullptr ? 1.0 : 1.0 / (1.0 + e.dot(Ie) / kCauchy2);
      const Eigen::Matrix<double, 6, 3> WJ = weight * J.transpose() * item.information;
      H.noalias() += WJ * J;
      b.noalias() += WJ * e;
    };
    if (only != nullptr) {
      for (const int i : *only) add(items_[static_cast<std::size_t>(i)]);
    } else {
      for (const Item& item : items_) add(item);
    }
    H.diagonal().head<3>().array() += 1.0 / (kAnchorM * kAnchorM);
    H.diagonal().tail<3>().array() += 1.0 / (kAnchorRad * kAnchorRad);
    b.head<3>() -= (T.t() - anchor.t()) / (kAnchorM * kAnchorM);
    const Vector6d d = urban_nav_core::solveByLdlt<6, 1>(H, b);
    if (!d.allFinite()) return anchor;
    T = apply(d, T);
    if (d.head<3>().norm() < 1e-6 && d.tail<3>().norm() < 1e-7) break;
  }
  return T;
}

double PoseEstimator::cost(const Pose& T_camera_odom) const {
  double total = 0.0;
  for (const Item& item : items_) {
    Eigen::Vector3d e;
    double chi2 = kGate;
    if (residual(item, T_camera_odom, e, nullptr)) chi2 = std::min(kGate, e.dot(item.information * e));
    total += item.trust * chi2;
  }
  return total;
}

Pose PoseEstimator::bestByConsensus(const Pose& start, int samples, double& best_cost) const {
  Pose best = start;
  const std::uint32_t count = static_cast<std::uint32_t>(items_.size());
  std::uint32_t state = 12345;
  std::array<int, kSampleSize> chosen{};
  for (int sample = 0; sample < samples; ++sample) {
    for (auto next = chosen.begin(); next != chosen.end();) {
      state = state * 1664525U + 1013904223U;
      *next = static_cast<int>((state >> 8) % count);
      if (std::find(chosen.begin(), next, *next) == next) ++next;
    }
    const Pose T = descend(start, 6, &chosen);
    const double c = cost(T);
    if (c < best_cost) {
      best_cost = c;
      best = T;
    }
  }
  return best;
}

PoseEstimate PoseEstimator::locate(const std::vector<Pose>& starts, const PoseEstimatorOptions& options,
                                   std::vector<Match>& matches) {
  PoseEstimate result;
  result.T_camera_odom = starts.front();
  prepare(starts.front(), options, matches);
  result.candidates = static_cast<int>(items_.size());
  for (Match& match : matches) match.inlier = false;
  if (items_.size() < 4) return result;

  Pose best = descend(starts.front(), kMostPoseSteps, nullptr);
  double best_cost = cost(best);
  const auto consider = [&](const Pose& start) {
    const Pose T = descend(start, kMostPoseSteps, nullptr);
    const double c = cost(T);
    if (c < kPredictionBonus * best_cost) {
      best_cost = c;
      best = T;
    }
  };
  for (std::size_t i = 1; i < starts.size(); ++i) consider(starts[i]);
  double trust = 0.0;
  for (const Item& item : items_) trust += item.trust;
  // Another motion can have a lower cost only if its support exceeds the remainder.
  if (best_cost > kClearMajority * kGate * trust) {
    double consensus_cost = kPredictionBonus * best_cost;
    consider(bestByConsensus(starts.front(), options.samples, consensus_cost));
  }

  double squares = 0.0;
  int in_left = 0;
  for (const Item& item : items_) {
    Match& match = matches[static_cast<std::size_t>(item.match)];
    Eigen::Vector3d e;
    if (!residual(item, best, e, nullptr)) continue;
    match.chi2 = e.dot(item.information * e);
    match.inlier = match.chi2 < kGate;
    if (!match.inlier) continue;
    ++result.inliers;
    if (!match.left.found) continue;
    squares += e.head<2>().squaredNorm();
    ++in_left;
  }
  result.found = result.inliers >= options.least_inliers;
  if (!result.found) {
    for (Match& match : matches) match.inlier = false;
    return result;
  }
  result.T_camera_odom = best;
  result.reprojection_px = in_left > 0 ? std::sqrt(squares / in_left) : 0.0;
  return result;
}

}  // namespace swf_vo
