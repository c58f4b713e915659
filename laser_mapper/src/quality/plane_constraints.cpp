// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/plane_constraints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace laser_mapper {

using Eigen::Vector3d;
using urban_nav_core::Matrix3d;
using urban_nav_core::Matrix6d;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector6d;

namespace {

constexpr double kMostSpread = 1.5;  // s, standard deviation of a patch's stamps: it belongs to one pose
constexpr std::size_t kFewestPlanes = 3;
constexpr double kChi2 = 16.27;         // of 3 degrees of freedom, 99.9 %
constexpr double kLeastAgreeing = 0.7;  // of the planes of a group
constexpr double kLength = 10.0;        // m that weigh as much as a rad, where directions are told apart
// Of the largest eigenvalue: normals of one plane differ by some 0.01 rad through noise and roughness, which must not
// pass for knowledge along the plane.
constexpr double kLeastInformation = 0.0025;

using PlaneJacobian = Eigen::Matrix<double, 3, 6>;

/// One plane in two passes: J x = r + noise, with x = (rho, phi) the correction of pose b in the axes of the map:
/// points p that b has seen go to Exp(phi) (p - t_b) + t_b + rho.
struct PlanePair {
  PlaneJacobian J;
  Vector3d r = Vector3d::Zero();          // displacement along the normal, m; two tilts, rad
  Vector3d weights = Vector3d::Zero();    // 1/m^2, 1/rad^2: share of this pair in the plane's information
  Vector3d variances = Vector3d::Zero();  // of r
};

/// Patches of one plane and the pair among them.
struct PlaceOfPair {
  const PlanePlace* place = nullptr;
  const PlanePatch *a = nullptr, *b = nullptr;
};

/// Variances of a patch along its normal, m^2, and of its tilt, rad^2: noise, and a constant error of the laser, which
/// ends up in the displacement and, as far as it varies over the patch, in the tilt.
Eigen::Vector2d patchVariances(const PlanePatch& patch, double range_bias) {
  const double extent = patch.displacement_sigma / patch.angle_sigma;
  return {patch.displacement_sigma * patch.displacement_sigma + range_bias * range_bias,
          patch.angle_sigma * patch.angle_sigma + range_bias * range_bias / (extent * extent)};
}

/// Whether a patch can be said to hang on one pose.
bool isUsable(const PlanePatch& patch) {
  return patch.angle_sigma > 0.0 && patch.displacement_sigma > 0.0 && patch.stamp_spread < kMostSpread;
}

PlanePair makePair(const PlaceOfPair& of, const Vector3d& t_b, double range_bias) {
  const PlanePatch &a = *of.a, &b = *of.b;
  const Vector3d normal = (a.normal + b.normal).normalized();
  const Vector3d first = normal.unitOrthogonal(), second = normal.cross(first);
  const Vector3d arm = 0.5 * (a.centre + b.centre) - t_b, turn = b.normal.cross(a.normal);
  PlanePair pair;
  pair.J << normal.transpose(), arm.cross(normal).transpose(), Eigen::RowVector3d::Zero(), first.transpose(),
      Eigen::RowVector3d::Zero(), second.transpose();
  pair.r << normal.dot(a.centre - b.centre), first.dot(turn), second.dot(turn);
  // The plane itself is unknown: sum of w_i (x_i - plane)^2, least over the plane, is the sum over all pairs of
  // w_i w_j (x_i - x_j)^2 / sum of w.
  Eigen::Vector2d all = Eigen::Vector2d::Zero();
  for (const PlanePatch& patch : of.place->patches)
    if (isUsable(patch)) all += patchVariances(patch, range_bias).cwiseInverse();
  const Eigen::Vector2d of_a = patchVariances(a, range_bias), of_b = patchVariances(b, range_bias);
  const Eigen::Vector2d weights = (of_a.array() * of_b.array() * all.array()).inverse(), variances = of_a + of_b;
  pair.weights << weights(0), weights(1), weights(1);
  pair.variances << variances(0), variances(1), variances(1);
  return pair;
}

/// Solution of a group: information, and the correction in the directions that it tells.
struct GroupFit {
  Matrix6d information = Matrix6d::Zero();
  Vector6d x = Vector6d::Zero();
};

GroupFit fitGroup(const std::vector<PlanePair>& pairs) {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
  for (const PlanePair& pair : pairs) {
    H += pair.J.transpose() * pair.weights.asDiagonal() * pair.J;
    g += pair.J.transpose() * pair.weights.cwiseProduct(pair.r);
  }
  Vector6d scale;
  scale << 1.0, 1.0, 1.0, 1.0 / kLength, 1.0 / kLength, 1.0 / kLength;
  const auto eigen = urban_nav_core::smallEigen<6>(scale.asDiagonal() * H * scale.asDiagonal());
  const Vector6d scaled = scale.cwiseProduct(g);
  GroupFit fit;
  Vector6d y = Vector6d::Zero();
  Matrix6d kept = Matrix6d::Zero();
  for (int i = 0; i < 6; ++i) {
    const double value = eigen.values(i);
    if (!(value > kLeastInformation * eigen.values(5))) continue;
    const Vector6d direction = eigen.vectors.col(i);
    y += direction.dot(scaled) / value * direction;
    kept += value * direction * direction.transpose();
  }
  fit.x = scale.cwiseProduct(y);
  fit.information = scale.cwiseInverse().asDiagonal() * kept * scale.cwiseInverse().asDiagonal();
  return fit;
}

/// Leaves out pairs that contradict the others, the worst first; nullopt if too few remain.
std::optional<GroupFit> fitAgreeing(std::vector<PlanePair>& pairs) {
  const double least = std::max(static_cast<double>(kFewestPlanes), kLeastAgreeing * static_cast<double>(pairs.size()));
  while (static_cast<double>(pairs.size()) >= least) {
    const GroupFit fit = fitGroup(pairs);
    const auto chi2 = [&](const PlanePair& pair) {
      const Vector3d e = pair.r - pair.J * fit.x;
      return e.cwiseProduct(e).cwiseQuotient(pair.variances).sum();
    };
    const auto worst = std::max_element(pairs.begin(), pairs.end(),
                                        [&](const PlanePair& a, const PlanePair& b) { return chi2(a) < chi2(b); });
    if (chi2(*worst) < kChi2) return fit;
    pairs.erase(worst);
  }
  return std::nullopt;
}

/// Information after an error of covariance `noise` that all of a group have in common; may be singular.
Matrix6d addNoise(const Matrix6d& information, const Matrix6d& noise) {
  const Matrix6d reduced =
      information * urban_nav_core::inverseByLu<6>(Matrix6d(Matrix6d::Identity() + noise * information));
  return 0.5 * (reduced + reduced.transpose());
}

/// Passes of which a group is made: sessions, and stretches of time in them.
using GroupKey = std::tuple<std::size_t, StampNs, std::size_t, StampNs>;

StampNs stretchAt(const Trajectory& trajectory, StampNs stamp) {
  return (stamp - trajectory.front().stamp) / kPlaneGroupTime;
}

StampNs meanStamp(const std::vector<PlaceOfPair>& group, const PlanePatch* PlaceOfPair::*patch) {
  const StampNs since = (group.front().*patch)->stamp;
  double sum = 0.0;
  for (const PlaceOfPair& of : group) sum += static_cast<double>((of.*patch)->stamp - since);
  return since + std::llround(sum / static_cast<double>(group.size()));
}

std::optional<PlaneConstraint> constrain(const std::vector<PlaceOfPair>& group, const Trajectory& T_map_a,
                                         const Trajectory& T_map_b, double range_bias) {
  if (group.size() < kFewestPlanes) return std::nullopt;
  const urban_nav_core::StampedPose& a = T_map_a[T_map_a.nearest(meanStamp(group, &PlaceOfPair::a))];
  const urban_nav_core::StampedPose& b = T_map_b[T_map_b.nearest(meanStamp(group, &PlaceOfPair::b))];
  std::vector<PlanePair> pairs;
  for (const PlaceOfPair& of : group) pairs.push_back(makePair(of, b.pose.t(), range_bias));
  const std::optional<GroupFit> fit = fitAgreeing(pairs);
  if (!fit) return std::nullopt;
  Matrix6d common = Matrix6d::Zero();  // two lasers
  common.topLeftCorner<3, 3>().diagonal().setConstant(2.0 * range_bias * range_bias);
  const Matrix6d information = addNoise(fit->information, common);
  const Matrix3d R_a_map = a.pose.q().conjugate().toRotationMatrix();
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R_a_map;
  const Vector6d x = turn * fit->x;
  PlaneConstraint made;
  made.stamp_a = a.stamp;
  made.stamp_b = b.stamp;
  made.planes = pairs.size();
  made.measured.T_a_b = urban_nav_core::boxPlus(a.pose.inverse() * b.pose, x);
  made.measured.information = turn * information * turn.transpose();
  if (!made.measured.information.allFinite() || !x.allFinite()) return std::nullopt;
  return made;
}

}  // namespace

std::vector<PlaneConstraint> findPlaneConstraints(const std::vector<PlanePlace>& places,
                                                  const std::vector<const Trajectory*>& T_map_base, double range_bias) {
  std::map<GroupKey, std::vector<PlaceOfPair>> groups;
  for (const PlanePlace& place : places)
    for (const PlanePlace::Pair& pair : place.pairs) {
      const PlanePatch &a = place.patches[pair.a], &b = place.patches[pair.b];
      if (!isUsable(a) || !isUsable(b)) continue;
      const Trajectory &T_map_a = *T_map_base[a.session], &T_map_b = *T_map_base[b.session];
      if (T_map_a.empty() || T_map_b.empty()) continue;
      groups[{a.session, stretchAt(T_map_a, a.stamp), b.session, stretchAt(T_map_b, b.stamp)}].push_back(
          {&place, &a, &b});
    }
  std::vector<PlaneConstraint> made;
  for (const auto& [key, group] : groups) {
    const std::size_t a = std::get<0>(key), b = std::get<2>(key);
    std::optional<PlaneConstraint> constraint = constrain(group, *T_map_base[a], *T_map_base[b], range_bias);
    if (!constraint) continue;
    constraint->session_a = a;
    constraint->session_b = b;
    constraint->stretch_a = std::get<1>(key);
    constraint->stretch_b = std::get<3>(key);
    made.push_back(std::move(*constraint));
  }
  return made;
}

}  // namespace laser_mapper
