// SPDX-License-Identifier: BSD-3-Clause
#include "registration.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/dense.hpp"

namespace laser_odometry {
namespace {

constexpr std::size_t kFewestMatches = 12;
constexpr double kSmallStep = 1e-4;       // m at the surfaces: a tenth of the accuracy of a sweep
constexpr double kCauchy = 2.385;         // 95 % efficiency for normal errors (Holland, Welsch 1977)
constexpr double kSmallStart = 0.005;     // m
constexpr double kThickest = 6.0;         // ratio of the variance of a patch to that of its plane
constexpr double kNear = 10.0;            // m: rings 2 deg apart share the coarsest cubes, on the ground too
constexpr double kNormalMedian = 0.6745;  // median of |x| of a standard normal variable

/// Returns the median of |values|; reorders them.
double median(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns the robust standard deviation of residual / sqrt(variance); 0 without matches.
double robustSpread(const std::vector<PatchMatch>& matches) {
  std::vector<double> whitened;
  whitened.reserve(matches.size());
  for (const PatchMatch& match : matches) whitened.push_back(std::abs(match.residual) * std::sqrt(match.row.weight));
  return median(whitened) / kNormalMedian;
}

/// Sets the factors of the kernel. `scale`: spread of the whitened residuals. `start_sigma`: effect of an error of the
/// start pose, m.
void setRobustFactors(std::vector<PatchMatch>& matches, double scale, double start_sigma) {
  const double least = 1e-6;
  for (PatchMatch& match : matches) {
    const double variance = std::max(scale * scale, least) / match.row.weight + start_sigma * start_sigma;
    match.robust = 1.0 / (1.0 + match.residual * match.residual / (kCauchy * kCauchy * variance));
  }
}

using Vector12d = Eigen::Matrix<double, 12, 1>;
using Matrix12d = Eigen::Matrix<double, 12, 12>;
using Matrix12x6d = Eigen::Matrix<double, 12, 6>;

/// Normal equations of the pose, with the motion within the sweep eliminated (Schur complement).
struct NormalEquations {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
  Matrix12x6d coupling = Matrix12x6d::Zero();  // motion by pose, times the inverse of the motion's block
  Vector12d motion = Vector12d::Zero();        // step of the motion for a fixed pose

  SweepMotion solveMotion(const Vector6d& step) const {
    const Vector12d solved = motion - coupling * step;
    return {solved.head<6>(), solved.tail<6>()};
  }
};

Vector12d stacked(const SweepMotion& motion) {
  Vector12d v;
  v << motion.twist, motion.acceleration;
  return v;
}

/// Derivative of the residual by the motion within the sweep: the point moves with base_link for the time of its patch.
Vector12d motionJacobian(const PatchMatch& match, const Matrix3d& R_base_odom) {
  const Vector3d normal = R_base_odom * match.row.normal;
  Vector6d J;
  J << normal, (R_base_odom * match.row.lever).cross(normal);
  Vector12d all;
  all << match.time * J, match.half_square * J;
  return all;
}

/// Returns the information of the predicted motion within the sweep.
Vector12d predictedInformation(const RegistrationOptions& options) {
  const auto information = [](double sigma) { return Vector3d(Vector3d::Constant(1.0 / (sigma * sigma))); };
  Vector12d all;
  all << information(options.velocity_sigma), information(options.rate_sigma), information(options.acceleration_sigma),
      information(options.angular_acceleration_sigma);
  return all;
}

/// Builds the equations; `rows` is set to the matches' rows with robust weights.
NormalEquations buildEquations(const Registration& state, const RegistrationOptions& options,
                               std::vector<PlaneRow>& rows) {
  NormalEquations equations;
  Matrix12d motion_H = Matrix12d::Zero();
  Matrix12x6d cross = Matrix12x6d::Zero();
  Vector12d motion_g = Vector12d::Zero();
  const Matrix3d R_base_odom = state.T_odom_base.R().transpose();
  const bool is_timed = options.velocity_sigma > 0.0;
  rows.clear();
  for (const PatchMatch& match : state.matches) {
    PlaneRow row = match.row;
    row.weight *= match.robust;
    const Vector6d J = row.jacobian();
    equations.H.noalias() += row.weight * J * J.transpose();
    equations.g -= row.weight * match.residual * J;
    rows.push_back(row);
    if (!is_timed) continue;
    const Vector12d J_motion = motionJacobian(match, R_base_odom), weighted = row.weight * J_motion;
    cross.noalias() += weighted * J.transpose();
    motion_H.noalias() += weighted * J_motion.transpose();
    motion_g -= match.residual * weighted;
  }
  if (!is_timed) return equations;
  const Vector12d information = predictedInformation(options);
  motion_H.diagonal() += information;
  motion_g -= information.cwiseProduct(stacked(options.motion_offset + state.motion_change));
  Eigen::MatrixXd solved(12, 7), A = motion_H;
  solved << cross, motion_g;
  if (!urban_nav_core::solvePositiveDefiniteInPlace(A, solved)) return equations;
  equations.coupling = solved.leftCols<6>();
  equations.motion = solved.col(6);
  equations.H -= cross.transpose() * equations.coupling;
  equations.g -= cross.transpose() * equations.motion;
  return equations;
}

/// Returns Registration::covered.
double coveredShare(const std::vector<Patch>& patches, const std::vector<PatchMatch>& matches) {
  const auto is_near = [](const Vector3d& p) { return p.squaredNorm() < kNear * kNear; };
  const auto all =
      std::count_if(patches.begin(), patches.end(), [&](const Patch& patch) { return is_near(patch.mean); });
  const auto with_plane =
      std::count_if(matches.begin(), matches.end(), [&](const PatchMatch& match) { return is_near(match.row.lever); });
  return all == 0 ? 1.0 : static_cast<double>(with_plane) / static_cast<double>(all);
}

}  // namespace

std::vector<PatchMatch> matchPatches(const std::vector<Patch>& patches, SurfaceMap& map, const Pose& T_odom_base,
                                     const SweepMotion& motion_change, double surface_sigma, int level) {
  std::vector<PatchMatch> matches;
  matches.reserve(patches.size());
  const Matrix3d R = T_odom_base.R();
  for (const Patch& patch : patches) {
    const Vector6d shift = patch.time * motion_change.twist + patch.half_square * motion_change.acceleration;
    const Vector3d moved = patch.mean + shift.head<3>() + shift.tail<3>().cross(patch.mean);
    const Vector3d turned = R * moved;
    const Vector3d p = turned + T_odom_base.t();
    MapCell* cell = map.find(p, level);
    if (cell == nullptr) continue;
    const Plane& plane = cell->plane;
    PatchMatch match;
    match.cell = cell;
    match.residual = plane.normal.dot(p - plane.mean);
    const Vector3d normal_base = R.transpose() * plane.normal;
    const double thickness = std::max(0.0, normal_base.dot(patch.covariance * normal_base));
    if (thickness > kThickest * (plane.variance + kBeamVariance)) continue;  // the patch extends over an edge
    const double tilt = plane.normal_variance * (p - plane.mean).squaredNorm();
    match.row = {plane.normal, turned, std::sqrt(plane.normal_variance),
                 1.0 / (plane.variance + thickness + tilt + kBeamVariance + surface_sigma * surface_sigma)};
    match.count = patch.count;
    match.time = patch.time;
    match.half_square = patch.half_square;
    match.p_odom = p;
    matches.push_back(match);
  }
  return matches;
}

Registration registerPatches(const std::vector<Patch>& patches, SurfaceMap& map, const Pose& prior, const Pose& start,
                             const RegistrationOptions& options) {
  Registration result;
  result.T_odom_base = start;
  result.free.space = options.space;
  std::vector<PlaneRow> rows;
  double start_sigma = options.start_sigma;
  int level = std::min(options.coarse_level, map.levels() - 1);
  for (int i = 0; i < options.iterations; ++i) {
    result.matches = matchPatches(patches, map, result.T_odom_base, result.motion_change, options.surface_sigma, level);
    result.iterations = i + 1;
    if (result.matches.size() < kFewestMatches) break;
    result.scale = robustSpread(result.matches);
    setRobustFactors(result.matches, result.scale, start_sigma);
    const bool is_narrow = start_sigma < kSmallStart;
    start_sigma = is_narrow ? 0.0 : 0.3 * start_sigma;
    NormalEquations equations = buildEquations(result, options, rows);
    result.free = findFreeSubspace(rows, options.space);
    result.information = equations.H;
    const Vector6d back = urban_nav_core::boxMinus(prior, result.T_odom_base);
    const Vector6d step = solveObserved(equations.H, equations.g, result.free, back);
    result.motion_change = result.motion_change + equations.solveMotion(step);
    result.T_odom_base = urban_nav_core::boxPlus(result.T_odom_base, step);
    result.solved = true;
    const bool is_small = step.head<3>().norm() < kSmallStep && step.tail<3>().norm() * result.free.lever < kSmallStep;
    if (is_small && level == 0 && is_narrow) break;
    if (level > 0 && (is_small || step.head<3>().norm() < 0.02)) --level;
  }
  result.covered = coveredShare(patches, result.matches);
  std::vector<double> distances;
  double agreeing = 0.0;
  for (const PatchMatch& match : result.matches) {
    distances.push_back(std::abs(match.residual));
    agreeing += match.robust;
  }
  result.share = result.matches.empty() ? 0.0 : agreeing / static_cast<double>(result.matches.size());
  result.residual_m = median(distances) / kNormalMedian;
  return result;
}

}  // namespace laser_odometry
