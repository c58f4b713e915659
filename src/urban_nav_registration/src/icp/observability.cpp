// SPDX-License-Identifier: BSD-3-Clause
#include "icp/observability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace urban_nav_registration {

namespace {

constexpr double kLeastError = 0.002;                           // m: lower limit for lasers
constexpr double kFreeTranslation = 1e6, kFreeRotation = 10.0;  // m^2, rad^2: docs/conventions.md

double robustWeight(const Match& match, double sigma) {
  const double ratio = match.residual / sigma;
  return match.weight / (1.0 + ratio * ratio);
}

/// Tangent about the matches' centre in units of length: u = S (rho, phi), so that the six directions are comparable.
struct Scaled {
  Vector3d centre = Vector3d::Zero();
  double length = 1.0, weight = 0.0;
  Matrix6d S = Matrix6d::Identity(), S_inverse = Matrix6d::Identity();

  Vector6d row(const Match& match, const Vector3d& normal) const {
    const Vector3d turn = (match.lever - centre).cross(normal) / length;
    return (Vector6d() << normal.x(), normal.y(), normal.z(), turn.x(), turn.y(), turn.z()).finished();
  }
};

Scaled scaleMatches(const std::vector<Match>& matches, double sigma) {
  Scaled scaled;
  for (const Match& match : matches) {
    const double weight = robustWeight(match, sigma);
    scaled.centre += weight * match.lever;
    scaled.weight += weight;
  }
  if (!(scaled.weight > 0.0)) return scaled;
  scaled.centre /= scaled.weight;
  double squares = 0.0;
  for (const Match& match : matches)
    squares += robustWeight(match, sigma) * (match.lever - scaled.centre).squaredNorm();
  scaled.length = std::max(std::sqrt(squares / scaled.weight), 1e-3);
  // A point moves by rho + phi x lever = (rho + phi x centre) + phi x (lever - centre).
  scaled.S.block<3, 3>(0, 3) = -urban_nav_core::skew(scaled.centre);
  scaled.S.bottomRows<3>() *= scaled.length;
  scaled.S_inverse.bottomRightCorner<3, 3>() /= scaled.length;
  scaled.S_inverse.block<3, 3>(0, 3) = urban_nav_core::skew(scaled.centre) / scaled.length;
  return scaled;
}

/// Jacobians of a match with positive weight.
struct Row {
  Vector6d from_target, from_source;
  double weight;            ///< share of the total weight
  std::uint32_t patch = 0;  ///< index of its surface patch
};

/// Means over the matches, and sums over surface patches, whose errors are correlated.
struct Sums {
  Matrix6d agreed = Matrix6d::Zero();   // mean of J_source J_target^T, symmetric part
  Matrix6d normal = Matrix6d::Zero();   // mean of J_target J_target^T
  std::vector<Row> rows;                // one per match with positive weight, in order
  std::vector<Vector6d> pull_by_patch;  // sum of weight J_target: effect of an error common to the patch
  std::vector<double> weight_by_patch, residual_by_patch;  // residual: weighted mean, m

  /// Returns the standard deviation of errors common to patches, m, from their mean residuals. Infinite with too few
  /// patches.
  double errorOfPatches() const;
};

Sums computeSums(const std::vector<Match>& matches, const Scaled& scaled, double sigma, double patch) {
  Sums sums;
  CellTable patches(matches.size() / 4 + 16);
  sums.rows.reserve(matches.size());
  for (const Match& match : matches) {
    const double weight = robustWeight(match, sigma) / scaled.weight;
    if (!(weight > 0.0)) continue;
    const std::uint32_t number =
        patches.insert(toKey(toCell(match.lever.cast<float>(), static_cast<float>(1.0 / patch))));
    if (number == sums.pull_by_patch.size()) {
      sums.pull_by_patch.push_back(Vector6d::Zero());
      sums.weight_by_patch.push_back(0.0);
      sums.residual_by_patch.push_back(0.0);
    }
    const Vector6d from_target = scaled.row(match, match.target_normal),
                   from_source = scaled.row(match, match.source_normal);
    sums.rows.push_back({from_target, from_source, weight, number});
    sums.agreed += 0.5 * weight * (from_source * from_target.transpose() + from_target * from_source.transpose());
    sums.normal += weight * from_target * from_target.transpose();
    sums.pull_by_patch[number] += weight * from_target;
    sums.weight_by_patch[number] += weight;
    sums.residual_by_patch[number] += weight * match.residual;
  }
  for (std::size_t p = 0; p < sums.weight_by_patch.size(); ++p) sums.residual_by_patch[p] /= sums.weight_by_patch[p];
  return sums;
}

// The alignment has used six degrees of freedom.
double Sums::errorOfPatches() const {
  double squares = 0.0, weights = 0.0, weights2 = 0.0;
  for (std::size_t p = 0; p < weight_by_patch.size(); ++p) {
    squares += weight_by_patch[p] * residual_by_patch[p] * residual_by_patch[p];
    weights += weight_by_patch[p];
    weights2 += weight_by_patch[p] * weight_by_patch[p];
  }
  const double count = weights * weights / std::max(weights2, 1e-300);
  return count > 7.0 ? std::sqrt(squares / weights * count / (count - 6.0)) : std::numeric_limits<double>::infinity();
}

/// Returns the standard deviation of u^T agreed u due to noise of the normals, estimated from their difference: of the
/// product (a + e1)(a + e2) it is sqrt(a^2 e^2 + e^4 / 4) with e = e1 - e2. Noise is common to the matches of a patch.
double cloudNoise(const Sums& sums, const Vector6d& u) {
  std::vector<double> by_patch(sums.pull_by_patch.size(), 0.0);
  for (const Row& row : sums.rows) {
    const double a = u.dot(row.from_target), b = u.dot(row.from_source);
    const double e2 = (a - b) * (a - b);
    by_patch[row.patch] += row.weight * std::sqrt(e2 * (std::abs(a * b) + 0.25 * e2));
  }
  double squares = 0.0;
  for (const double noise : by_patch) squares += noise * noise;
  return std::sqrt(squares);
}

/// Returns orthonormal tangents, in scaled coordinates, of the measurable motions: all six, or those in a plane.
Eigen::MatrixXd measurableMotions(const std::optional<Vector3d>& scan_plane) {
  if (!scan_plane) return Eigen::MatrixXd::Identity(6, 6);
  const Vector3d across = scan_plane->unitOrthogonal();
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(6, 3);
  motions.col(0).head<3>() = across;
  motions.col(1).head<3>() = scan_plane->cross(across);
  motions.col(2).tail<3>() = *scan_plane;
  return motions;
}

}  // namespace

Observability observe(const std::vector<Match>& matches, double sigma, const CloudErrors& errors, double patch) {
  Observability observed;
  const Scaled scaled = scaleMatches(matches, sigma);
  const Sums sums = computeSums(matches, scaled, sigma, patch);
  const Eigen::MatrixXd motions = measurableMotions(errors.scan_plane);
  const auto eigen = urban_nav_core::symmetricEigen(Eigen::MatrixXd(motions.transpose() * sums.agreed * motions));
  const double bias = std::max(errors.bias, 1e-4);
  const double least = std::pow(bias / errors.free_deviation, 2);
  Matrix6d free = Matrix6d::Identity() - motions * motions.transpose();  // projector, in scaled coordinates
  std::vector<Vector6d> held_directions;
  for (Eigen::Index i = 0; i < motions.cols(); ++i) {
    const Vector6d u = eigen ? Vector6d(motions * eigen->vectors.col(i)) : Vector6d(motions.col(i));
    const double mean = eigen ? eigen->values[i] : 0.0;
    const double sure = mean - 2.0 * cloudNoise(sums, u);
    if (i == 0) observed.weakest = mean > 0.0 ? bias / std::sqrt(mean) : 1e3;
    if (sure > least) {
      held_directions.push_back(u);
    } else {
      free += u * u.transpose();
      observed.free_directions.push_back((scaled.S_inverse * u).normalized());
    }
  }
  observed.held = held_directions.size();
  Vector6d unlimited;
  unlimited << Vector3d::Constant(kFreeTranslation), Vector3d::Constant(kFreeRotation * scaled.length * scaled.length);
  Matrix6d covariance = free * unlimited.asDiagonal() * free;
  if (!held_directions.empty()) {
    // Within the constrained directions: errors of the patches by the normal equations (cluster-robust, Liang and Zeger
    // 1986), and an error common to all, which residuals do not show, of the same size.
    const auto count = static_cast<Eigen::Index>(held_directions.size());
    Eigen::MatrixXd basis(6, count);
    for (Eigen::Index i = 0; i < count; ++i) basis.col(i) = held_directions[static_cast<std::size_t>(i)];
    const double error = std::clamp(sums.errorOfPatches(), kLeastError, std::max(errors.most, kLeastError));
    Matrix6d spread = Matrix6d::Zero();
    for (const Vector6d& pull : sums.pull_by_patch) spread += error * error * pull * pull.transpose();
    const auto normal_inverse =
        urban_nav_core::invertPositiveDefinite(Eigen::MatrixXd(basis.transpose() * sums.normal * basis));
    const auto agreed_inverse =
        urban_nav_core::invertPositiveDefinite(Eigen::MatrixXd(basis.transpose() * sums.agreed * basis));
    if (normal_inverse && agreed_inverse) {
      const Eigen::MatrixXd inner =
          *normal_inverse * (basis.transpose() * spread * basis) * *normal_inverse + error * error * *agreed_inverse;
      covariance += basis * inner * basis.transpose();
      if (const auto information = urban_nav_core::invertPositiveDefinite(inner))
        observed.information = scaled.S.transpose() * (basis * *information * basis.transpose()) * scaled.S;
    }
  }
  observed.information = (0.5 * (observed.information + observed.information.transpose())).eval();
  const Matrix6d turned = scaled.S_inverse * covariance * scaled.S_inverse.transpose();
  observed.covariance = 0.5 * (turned + turned.transpose());
  return observed;
}

}  // namespace urban_nav_registration
