// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/shared_beams.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace laser_mapper {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector6d;

namespace {

constexpr double kMetresPerRadian = 10.0;  // m that count as one rad when directions are compared
constexpr double kNoInformation = 1e-12;   // relative to the largest eigenvalue

/// Returns `information` minus `known`, in the directions where the difference is positive.
Matrix6d remainder(const Matrix6d& information, const Matrix6d& known) {
  Vector6d scale;
  scale << 1.0, 1.0, 1.0, 1.0 / kMetresPerRadian, 1.0 / kMetresPerRadian, 1.0 / kMetresPerRadian;
  const auto eigen = urban_nav_core::smallEigen<6>(Matrix6d(scale.asDiagonal() * information * scale.asDiagonal()));
  Vector6d root, inverse_root;
  for (int i = 0; i < 6; ++i) {
    const bool is_known = eigen.values(i) > kNoInformation * eigen.values(5);
    root(i) = is_known ? std::sqrt(eigen.values(i)) : 0.0;
    inverse_root(i) = is_known ? 1.0 / root(i) : 0.0;
  }
  // With `information` whitened to the identity, it exceeds `known` in the eigenvectors with positive eigenvalues.
  const Matrix6d whitened = inverse_root.asDiagonal() * eigen.vectors.transpose() * scale.asDiagonal() * known *
                            scale.asDiagonal() * eigen.vectors * inverse_root.asDiagonal();
  const auto left = urban_nav_core::smallEigen<6>(Matrix6d(Matrix6d::Identity() - whitened));
  const Matrix6d back = scale.cwiseInverse().asDiagonal() * eigen.vectors * root.asDiagonal() * left.vectors;
  return back * left.values.cwiseMax(0.0).asDiagonal() * back.transpose();
}

}  // namespace

double SharedBeams::PathLengths::at(StampNs stamp) const {
  const auto after = std::upper_bound(stamps.begin(), stamps.end(), stamp);
  return after == stamps.begin() ? 0.0 : lengths[static_cast<std::size_t>(after - stamps.begin()) - 1];
}

double SharedBeams::Interval::common(const Interval& other) const {
  return session == other.session ? std::max(0.0, std::min(to, other.to) - std::max(from, other.from)) : 0.0;
}

SharedBeams::SharedBeams(const std::vector<const Trajectory*>& T_map_base, std::vector<CloudClosure> closures,
                         double cloud_half_length)
    : T_map_base_(T_map_base), closures_(std::move(closures)), cloud_length_(2.0 * cloud_half_length) {
  for (const Trajectory* trajectory : T_map_base) {
    PathLengths path;
    for (std::size_t i = 0; i < trajectory->size(); ++i) {
      const urban_nav_core::StampedPose& pose = (*trajectory)[i];
      path.stamps.push_back(pose.stamp);
      path.lengths.push_back(i == 0 ? 0.0
                                    : path.lengths.back() + distanceBetween((*trajectory)[i - 1].pose, pose.pose));
    }
    paths_.push_back(std::move(path));
  }
  const auto cloud = [&](std::size_t session, StampNs stamp) {
    const double middle = paths_.at(session).at(stamp);
    return Interval{session, middle - cloud_half_length, middle + cloud_half_length};
  };
  for (const CloudClosure& closure : closures_)
    clouds_.emplace_back(cloud(closure.session_a, closure.stamp_a), cloud(closure.session_b, closure.stamp_b));
}

SharedBeams::Interval SharedBeams::stretch(std::size_t session, std::int64_t number) const {
  const PathLengths& path = paths_.at(session);
  if (path.stamps.empty()) return {session, 0.0, 0.0};
  const StampNs begin = path.stamps.front() + number * kPlaneGroupTime;
  return {session, path.at(begin), path.at(begin + kPlaneGroupTime)};
}

SharedBeams::Common SharedBeams::common(const std::pair<Interval, Interval>& clouds,
                                        const PlaneConstraint& constraint) const {
  const Interval a = stretch(constraint.session_a, constraint.stretch_a),
                 b = stretch(constraint.session_b, constraint.stretch_b);
  const double straight = std::min(clouds.first.common(a), clouds.second.common(b)),
               reversed = std::min(clouds.first.common(b), clouds.second.common(a));
  return {std::max(straight, reversed), reversed > straight};
}

/// Returns the information of a closure on the poses of a constraint, assuming exact odometry between them.
Matrix6d SharedBeams::carry(const CloudClosure& closure, bool is_reversed, const PlaneConstraint& to) const {
  const auto poseOf = [&](std::size_t session, StampNs stamp) {
    const Trajectory& trajectory = *T_map_base_[session];
    return trajectory[trajectory.nearest(stamp)].pose;
  };
  const Pose T_map_a = poseOf(closure.session_a, closure.stamp_a), T_map_b = poseOf(closure.session_b, closure.stamp_b),
             T_map_to_a = poseOf(to.session_a, to.stamp_a), T_map_to_b = poseOf(to.session_b, to.stamp_b);
  const Pose T_to_a_to_b = T_map_to_a.inverse() * T_map_to_b;
  const auto carried = [&](const Pose& T_map_first, const Pose& T_map_second, const Matrix6d& information) {
    const auto inner = urban_nav_core::compose(T_map_first.inverse() * T_map_to_a, T_to_a_to_b);
    const auto outer = urban_nav_core::compose(inner.T_a_c, T_map_to_b.inverse() * T_map_second);
    return urban_nav_core::transformInformation(outer.J1 * inner.J2, information);
  };
  if (!is_reversed) return carried(T_map_a, T_map_b, closure.measured.information);
  const auto inversion = urban_nav_core::invert(T_map_b.inverse() * T_map_a);
  return carried(T_map_b, T_map_a, urban_nav_core::transformInformation(inversion.J, closure.measured.information));
}

std::vector<PlaneConstraint> SharedBeams::discount(std::vector<PlaneConstraint> constraints) const {
  std::vector<Matrix6d> known(constraints.size(), Matrix6d::Zero());
  for (std::size_t c = 0; c < closures_.size(); ++c) {
    std::vector<Common> shared;
    double all = 0.0;
    for (const PlaneConstraint& constraint : constraints) {
      shared.push_back(common(clouds_[c], constraint));
      all += shared.back().length;
    }
    for (std::size_t i = 0; i < constraints.size(); ++i) {
      if (shared[i].length <= 0.0) continue;
      const double share = shared[i].length / std::max(all, cloud_length_);
      known[i] += share * carry(closures_[c], shared[i].is_reversed, constraints[i]);
      constraints[i].is_shared = true;
    }
  }
  for (std::size_t i = 0; i < constraints.size(); ++i)
    if (constraints[i].is_shared)
      constraints[i].measured.information = remainder(constraints[i].measured.information, known[i]);
  return constraints;
}

}  // namespace laser_mapper
