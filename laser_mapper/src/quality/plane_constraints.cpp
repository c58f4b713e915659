// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/plane_constraints.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "quality/stretch_walk.hpp"
#include "urban_nav_core/geometry/dense.hpp"
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

constexpr double kMostSpread = 1.5;  // s, standard deviation of a patch's stamps for a single pose
constexpr std::size_t kFewestPlanes = 3;
constexpr double kChi2 = 16.27;         // 99.9 % of chi-square with 3 degrees of freedom
constexpr double kLeastAgreeing = 0.7;  // of the planes of a group
constexpr double kLength = 10.0;        // m that count as one rad when directions are compared
// Relative to the largest eigenvalue: normals of one plane vary by about 0.01 rad through noise and roughness, which
// must not be mistaken for information along the plane.
constexpr double kLeastInformation = 0.0025;

// Patches are round and overlap the adjacent blocks: mean number of patches per beam.
constexpr double kOverlap = 3.14159265358979 * kPlaceRadius * kPlaceRadius / (kPlaceSpacing * kPlaceSpacing);

using PlaneJacobian = Eigen::Matrix<double, 3, 6>;

/// Plane in two passes: J x = r + noise, with x = (rho, phi) the correction of pose b in the axes of the map: points p
/// observed from b move to Exp(phi) (p - t_b) + t_b + rho.
struct PlanePair {
  PlaneJacobian J;
  PlaneAxes axes;
  Vector3d r = Vector3d::Zero();          // displacement along the normal, m; two tilts, rad
  Vector3d shares = Vector3d::Zero();     // weights of this pair in the plane's information
  Vector3d variances = Vector3d::Zero();  // of r, m^2 and rad^2: noise and constant error of the lasers
};

/// Pairs of a group, and the inverse covariance of all their r.
struct PairGroup {
  std::vector<PlanePair> pairs;
  Eigen::MatrixXd weights;
};

/// Poses of a session, and their drift according to odometry; null: none.
struct PosesOfPass {
  const Trajectory* T_map_base = nullptr;
  const OdometryDrift* drift = nullptr;
};

/// Patches of one plane and the pair among them.
struct PlaceOfPair {
  const PlanePlace* place = nullptr;
  const PlanePatch *a = nullptr, *b = nullptr;
};

/// Returns the variances of a patch along its normal, m^2, and of its tilt, rad^2: noise, and the effect of the surface
/// on ranges, which is a displacement and, as far as it varies over the patch, a tilt.
Eigen::Vector2d patchVariances(const PlanePatch& patch, double range_bias) {
  const double extent = patch.displacement_sigma / patch.angle_sigma;
  return kOverlap *
         Eigen::Vector2d(patch.displacement_sigma * patch.displacement_sigma + range_bias * range_bias,
                         patch.angle_sigma * patch.angle_sigma + range_bias * range_bias / (extent * extent));
}

/// Returns whether a patch can be assigned to one pose.
bool isUsable(const PlanePatch& patch) {
  return patch.angle_sigma > 0.0 && patch.displacement_sigma > 0.0 && patch.stamp_spread < kMostSpread;
}

PlanePair makePair(const PlaceOfPair& of, const Vector3d& t_b, double range_bias) {
  const PlanePatch &a = *of.a, &b = *of.b;
  const Vector3d normal = (a.normal + b.normal).normalized();
  const Vector3d first = normal.unitOrthogonal(), second = normal.cross(first);
  const Vector3d arm = 0.5 * (a.centre + b.centre) - t_b, turn = b.normal.cross(a.normal);
  PlanePair pair;
  pair.axes = {normal, first, second};
  pair.J << normal.transpose(), arm.cross(normal).transpose(), Eigen::RowVector3d::Zero(), first.transpose(),
      Eigen::RowVector3d::Zero(), second.transpose();
  pair.r << normal.dot(a.centre - b.centre), first.dot(turn), second.dot(turn);
  // The plane itself is unknown: the minimum over the plane of sum w_i (x_i - plane)^2 is the sum over all pairs of w_i
  // w_j (x_i - x_j)^2 / sum of w.
  Eigen::Vector2d all = Eigen::Vector2d::Zero();
  for (const PlanePatch& patch : of.place->patches)
    if (isUsable(patch)) all += patchVariances(patch, range_bias).cwiseInverse();
  const Eigen::Vector2d of_a = patchVariances(a, range_bias), of_b = patchVariances(b, range_bias);
  const Eigen::Vector2d variances = of_a + of_b;
  const Eigen::Vector2d shares = variances.array() / (of_a.array() * of_b.array() * all.array());
  pair.shares << shares(0), shares(1), shares(1);
  pair.variances << variances(0), variances(1), variances(1);
  return pair;
}

/// Solution of a group: information, and the correction in observed directions.
struct GroupFit {
  Matrix6d information = Matrix6d::Zero();
  Vector6d x = Vector6d::Zero();
};

/// Solves for the directions observed by the arrangement of the planes: those with enough information if poses had no
/// drift.
GroupFit fitGroup(const PairGroup& group) {
  Matrix6d arrangement = Matrix6d::Zero();
  const auto rows = static_cast<Eigen::Index>(3 * group.pairs.size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> J(rows, 6);
  Eigen::VectorXd r(rows);
  for (std::size_t i = 0; i < group.pairs.size(); ++i) {
    const PlanePair& pair = group.pairs[i];
    arrangement += pair.J.transpose() * pair.shares.cwiseQuotient(pair.variances).asDiagonal() * pair.J;
    const Vector3d roots = pair.shares.cwiseSqrt();
    J.middleRows<3>(3 * static_cast<Eigen::Index>(i)) = roots.asDiagonal() * pair.J;
    r.segment<3>(3 * static_cast<Eigen::Index>(i)) = roots.cwiseProduct(pair.r);
  }
  Vector6d scale;
  scale << 1.0, 1.0, 1.0, 1.0 / kLength, 1.0 / kLength, 1.0 / kLength;
  const auto eigen = urban_nav_core::smallEigen<6>(scale.asDiagonal() * arrangement * scale.asDiagonal());
  Matrix6d observable = Matrix6d::Zero();  // projector onto these directions
  for (int i = 0; i < 6; ++i)
    if (eigen.values(i) > kLeastInformation * eigen.values(5))
      observable += eigen.vectors.col(i) * eigen.vectors.col(i).transpose();
  const Eigen::Matrix<double, Eigen::Dynamic, 6> along = J * scale.asDiagonal() * observable,
                                                 weighted = group.weights * along;
  const Matrix6d information = along.transpose() * weighted;
  const double filling = information.trace();  // regularises the other directions, where the solution is zero
  GroupFit fit;
  fit.x = scale.cwiseProduct(
      urban_nav_core::SmallCholesky<6>(Matrix6d(information + filling * (Matrix6d::Identity() - observable)))
          .solve(Vector6d(weighted.transpose() * r)));
  fit.information = scale.cwiseInverse().asDiagonal() * information * scale.cwiseInverse().asDiagonal();
  return fit;
}

/// Removes a pair and its rows of the covariance.
void removePair(PairGroup& group, std::size_t number) {
  const Eigen::MatrixXd& all = group.weights;
  const auto at = static_cast<Eigen::Index>(3 * number), rest = all.rows() - 3, after = rest - at;
  Eigen::MatrixXd kept(rest, rest);
  kept.topLeftCorner(at, at) = all.topLeftCorner(at, at);
  kept.topRightCorner(at, after) = all.topRightCorner(at, after);
  kept.bottomLeftCorner(after, at) = all.bottomLeftCorner(after, at);
  kept.bottomRightCorner(after, after) = all.bottomRightCorner(after, after);
  Eigen::Matrix<double, Eigen::Dynamic, 3> shared(rest, 3);
  shared.topRows(at) = all.block(0, at, at, 3);
  shared.bottomRows(after) = all.block(at + 3, at, after, 3);
  const Matrix3d own = all.block<3, 3>(at, at);
  group.weights = kept - shared * urban_nav_core::SmallCholesky<3>(own).inverse() * shared.transpose();
  group.pairs.erase(group.pairs.begin() + static_cast<std::ptrdiff_t>(number));
}

/// Removes pairs that contradict the others, the worst first; nullopt if too few remain.
std::optional<GroupFit> fitAgreeing(PairGroup& group) {
  const double least =
      std::max(static_cast<double>(kFewestPlanes), kLeastAgreeing * static_cast<double>(group.pairs.size()));
  while (static_cast<double>(group.pairs.size()) >= least) {
    const GroupFit fit = fitGroup(group);
    Eigen::VectorXd residuals(group.weights.rows());
    for (std::size_t i = 0; i < group.pairs.size(); ++i)
      residuals.segment<3>(3 * static_cast<Eigen::Index>(i)) = group.pairs[i].r - group.pairs[i].J * fit.x;
    const Eigen::VectorXd weighted = group.weights * residuals;
    // With the inverse covariance W of all residuals e, the prediction of a pair from the others differs by W_ii^-1 (W
    // e)_i, with the covariance W_ii^-1.
    std::size_t worst = 0;
    double worst_chi2 = -1.0;
    for (std::size_t i = 0; i < group.pairs.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(3 * i);
      const Vector3d part = weighted.segment<3>(at);
      const double chi2 =
          part.dot(urban_nav_core::SmallCholesky<3>(Matrix3d(group.weights.block<3, 3>(at, at))).solve(part));
      if (!(chi2 <= worst_chi2)) {
        worst = i;
        worst_chi2 = chi2;
      }
    }
    if (worst_chi2 < kChi2) return fit;
    removePair(group, worst);
  }
  return std::nullopt;
}

/// Passes of a group: sessions, and their intervals of time.
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

/// Returns the walk of a trajectory around its pose `reference` during the observation of a group's patches.
StretchWalk walkDuring(const std::vector<PlaceOfPair>& group, const PlanePatch* PlaceOfPair::*patch,
                       const PosesOfPass& pass, StampNs reference) {
  StampNs begin = reference, end = reference;
  for (const PlaceOfPair& of : group) {
    const StampNs half = std::llround(1e9 * std::sqrt(3.0) * (of.*patch)->stamp_spread);
    begin = std::min(begin, (of.*patch)->stamp - half);
    end = std::max(end, (of.*patch)->stamp + half);
  }
  return StretchWalk(*pass.T_map_base, reference, begin, end, pass.drift);
}

/// Returns the linear map from the constant errors of the lasers, independent in both passes and of unit standard
/// deviation, to the rows of all pairs. `bias`: standard deviation of such an error, m.
Eigen::MatrixXd laserColumns(const std::vector<PlaceOfPair>& group, double bias) {
  std::map<std::pair<bool, std::uint8_t>, Eigen::Index> columns;
  for (const PlaceOfPair& of : group)
    for (const bool is_b : {false, true})
      columns.emplace(std::pair(is_b, (is_b ? of.b : of.a)->laser), static_cast<Eigen::Index>(columns.size()));
  Eigen::MatrixXd by_lasers =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(3 * group.size()), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < group.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    by_lasers(row, columns.at({false, group[i].a->laser})) = bias * group[i].a->facing;
    by_lasers(row, columns.at({true, group[i].b->laser})) = -bias * group[i].b->facing;
  }
  return by_lasers;
}

/// Returns the inverse covariance of the rows of all pairs: noise, constant errors of the lasers, and the drift of both
/// trajectories; empty if it is not positive definite.
Eigen::MatrixXd weighPairs(const std::vector<PlaceOfPair>& group, const std::vector<PlanePair>& pairs,
                           const StretchWalk& walk_a, const StretchWalk& walk_b, double bias) {
  const auto rows = static_cast<Eigen::Index>(3 * pairs.size());
  Eigen::VectorXd variances(rows);
  const Eigen::MatrixXd by_lasers = laserColumns(group, bias);
  Eigen::MatrixXd by_walks(rows, walk_a.size() + walk_b.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    variances.segment<3>(at) = pairs[i].variances;
    by_walks.middleRows<3>(at) << walk_a.rows(*group[i].a, pairs[i].axes), walk_b.rows(*group[i].b, pairs[i].axes);
  }
  Eigen::MatrixXd covariance = by_walks * by_walks.transpose() + by_lasers * by_lasers.transpose();
  covariance.diagonal() += variances;
  return urban_nav_core::invertPositiveDefinite(covariance).value_or(Eigen::MatrixXd());
}

/// `groups`: number of groups between the two passes, which share the constant errors of the lasers.
std::optional<PlaneConstraint> constrain(const std::vector<PlaceOfPair>& group, const PosesOfPass& pass_a,
                                         const PosesOfPass& pass_b, double range_bias, std::size_t groups) {
  const Trajectory &T_map_a = *pass_a.T_map_base, &T_map_b = *pass_b.T_map_base;
  const urban_nav_core::StampedPose& a = T_map_a[T_map_a.nearest(meanStamp(group, &PlaceOfPair::a))];
  const urban_nav_core::StampedPose& b = T_map_b[T_map_b.nearest(meanStamp(group, &PlaceOfPair::b))];
  PairGroup fitted;
  for (const PlaceOfPair& of : group) fitted.pairs.push_back(makePair(of, b.pose.t(), range_bias));
  fitted.weights = weighPairs(group, fitted.pairs, walkDuring(group, &PlaceOfPair::a, pass_a, a.stamp),
                              walkDuring(group, &PlaceOfPair::b, pass_b, b.stamp),
                              range_bias * std::sqrt(static_cast<double>(groups)));
  if (fitted.weights.size() == 0) return std::nullopt;
  const std::optional<GroupFit> fit = fitAgreeing(fitted);
  if (!fit) return std::nullopt;
  const Matrix3d R_a_map = a.pose.q().conjugate().toRotationMatrix();
  Matrix6d turn = Matrix6d::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R_a_map;
  const Vector6d x = turn * fit->x;
  PlaneConstraint made;
  made.stamp_a = a.stamp;
  made.stamp_b = b.stamp;
  made.planes = fitted.pairs.size();
  made.measured.T_a_b = urban_nav_core::boxPlus(a.pose.inverse() * b.pose, x);
  made.measured.information = turn * fit->information * turn.transpose();
  if (!made.measured.information.allFinite() || !x.allFinite()) return std::nullopt;
  return made;
}

}  // namespace

std::vector<PlaneConstraint> findPlaneConstraints(const std::vector<PlanePlace>& places,
                                                  const std::vector<const Trajectory*>& T_map_base, double range_bias,
                                                  const std::vector<const OdometryDrift*>& drifts) {
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
  std::map<std::pair<std::uint16_t, std::uint16_t>, std::size_t> shared;  // number of groups, by passes
  const auto passes = [](const std::vector<PlaceOfPair>& group) {
    return std::pair(group.front().a->pass, group.front().b->pass);
  };
  for (const auto& [key, group] : groups)
    if (group.size() >= kFewestPlanes) ++shared[passes(group)];
  std::vector<PlaneConstraint> made;
  for (const auto& [key, group] : groups) {
    if (group.size() < kFewestPlanes) continue;
    const std::size_t a = std::get<0>(key), b = std::get<2>(key);
    std::optional<PlaneConstraint> constraint =
        constrain(group, {T_map_base[a], drifts[a]}, {T_map_base[b], drifts[b]}, range_bias, shared[passes(group)]);
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
