// SPDX-License-Identifier: BSD-3-Clause
#include "stereo/estimate.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "urban_nav_core/geometry/small_matrices.hpp"

namespace urban_nav_registration {

using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

namespace {

using Matrix7d = Eigen::Matrix<double, 7, 7>;
using Vector7d = Eigen::Matrix<double, 7, 1>;

constexpr double kHuber = 2.5;                              // standard deviations, as in swf_vo
constexpr double kGateTwo = 13.8, kGateThree = 16.3;        // chi-square, 99.9 %
constexpr double kMedianTwo = 1.386, kMedianThree = 2.366;  // of chi-square
constexpr double kExactOffset = 1e6;                        // 1/px: information of an offset that is not estimated
constexpr int kPartsAcross = 4, kPartsDown = 3;             // parts of the image, within which errors may be correlated
constexpr double kLeastDepthSigmas = 3.0;
constexpr double kSettledM = 1e-6, kSettledRad = 1e-7;
// Constrains the pose in undetermined directions; far below the information of any match.
constexpr double kAnchor = 1e-6;

/// One measurement linearised at its best depth, with the depth eliminated.
struct Reduced {
  bool visible = false;
  Matrix7d H;
  Vector7d b;
  double chi2 = 0.0, residual_px = 0.0;
};

Eigen::Matrix4d computeWeight(const PointMeasurement& measurement) {
  Eigen::Matrix4d W = Eigen::Matrix4d::Zero();
  W(0, 0) = 1.0 / (measurement.sigma_disparity * measurement.sigma_disparity);
  W.block<2, 2>(1, 1) = measurement.covariance.inverse();
  if (measurement.other_sigma > 0.0) W(3, 3) = 1.0 / (measurement.other_sigma * measurement.other_sigma);
  return W;
}

Reduced reduce(const PointMeasurement& measurement, const StereoCamera& camera, const Pose& T_a_b, double offset,
               double& rho) {
  Reduced result;
  const Eigen::Matrix4d W = computeWeight(measurement);
  MeasurementResidual r;
  constexpr int kMostSteps = 4;
  for (int step = 0; step < kMostSteps; ++step) {
    r = computeResidual(measurement, camera, T_a_b, offset, rho);
    if (!r.visible) return result;
    const Eigen::Vector4d along = W * r.J.col(kOfDepth);
    const double d = along.dot(r.e) / along.dot(r.J.col(kOfDepth));
    if (!std::isfinite(d)) return result;
    if (std::abs(d) < 1e-7 || step + 1 == kMostSteps) break;
    rho += d;
  }
  // The derivative with respect to a depth indistinguishable from infinity is noise, which would act as information on
  // the translation.
  if (rho * camera.left.fx * camera.baseline < kLeastDepthSigmas * measurement.sigma_disparity)
    r.J.leftCols<3>().setZero();
  const Eigen::Matrix<double, 8, 4> JW = r.J.transpose() * W;
  const Eigen::Matrix<double, 8, 8> H = JW * r.J;
  const Eigen::Matrix<double, 8, 1> b = JW * r.e;
  const double of_rho = H(kOfDepth, kOfDepth);
  const Vector7d cross = H.col(kOfDepth).head<7>();
  result.H = H.topLeftCorner<7, 7>() - cross * cross.transpose() / of_rho;
  result.b = b.head<7>() - cross * (b[kOfDepth] / of_rho);
  result.chi2 = r.e.dot(W * r.e) - b[kOfDepth] * b[kOfDepth] / of_rho;
  result.residual_px = r.e.segment<2>(1).norm() / measurement.size;
  result.visible = result.H.allFinite() && result.b.allFinite();
  return result;
}

double computeWeight(double chi2, double scale2) {
  const double chi = std::sqrt(std::max(chi2 / scale2, 0.0));
  return chi > kHuber ? kHuber / chi : 1.0;
}

/// Returns the ratio of squared residuals to their expected values, by the median, for robustness against outliers.
double estimateScale(const std::vector<PointMeasurement>& measurements, const std::vector<Reduced>& reduced,
                     std::vector<double>& ratios) {
  ratios.clear();
  for (std::size_t i = 0; i < measurements.size(); ++i)
    if (reduced[i].visible)
      ratios.push_back(reduced[i].chi2 / (measurements[i].coordinates() == 3 ? kMedianThree : kMedianTwo));
  if (ratios.empty()) return 1.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return std::max(1.0, *middle);
}

/// Ratio of the covariance to that for independent errors. Errors of neighbours are correlated by a common surface and
/// light, so the scores of each part of the image are summed before they are squared (Liang and Zeger 1986). One mean
/// over the directions of the translation and one over those of the rotation: for single directions about ten parts
/// would give an accuracy of a factor of two only.
struct Inflation {
  double translation = 1.0, rotation = 1.0;
};

Inflation inflation(const StereoCamera& camera, const std::vector<PointMeasurement>& measurements,
                    const std::vector<Reduced>& reduced, double scale2, const Matrix7d& H) {
  std::array<Vector7d, 2 * kPartsAcross * kPartsDown> scores;
  std::array<bool, 2 * kPartsAcross * kPartsDown> used{};
  scores.fill(Vector7d::Zero());
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    if (!reduced[i].visible) continue;
    const Eigen::Vector3d& ray = measurements[i].ray;
    const double u = (camera.left.fx * ray.x() + camera.left.cx) / camera.left.width,
                 v = (camera.left.fy * ray.y() + camera.left.cy) / camera.left.height;
    const int column = std::clamp(static_cast<int>(u * kPartsAcross), 0, kPartsAcross - 1),
              row = std::clamp(static_cast<int>(v * kPartsDown), 0, kPartsDown - 1);
    const auto part = static_cast<std::size_t>(((measurements[i].of_a ? 0 : kPartsDown) + row) * kPartsAcross + column);
    scores[part] += computeWeight(reduced[i].chi2, scale2) / scale2 * reduced[i].b;
    used[part] = true;
  }
  Matrix7d S = Matrix7d::Zero();
  int count = 0;
  for (std::size_t part = 0; part < scores.size(); ++part) {
    if (!used[part]) continue;
    S += scores[part] * scores[part].transpose();
    ++count;
  }
  if (count <= 7) return {};
  Matrix7d held = H;
  held.diagonal().array() += kAnchor;
  const Matrix7d C = urban_nav_core::solveByLdlt<7, 7>(held, Matrix7d::Identity()), V = C * S * C;
  const auto mean = [&](int first) {
    const Eigen::Matrix3d promised = C.block<3, 3>(first, first), found = V.block<3, 3>(first, first);
    const double ratio = promised.ldlt().solve(found).trace() / 3.0 * count / (count - 7.0);
    return std::isfinite(ratio) ? std::max(1.0, ratio) : 1.0;
  };
  return {mean(0), mean(3)};
}

/// Adds errors common to all measurements: apparent rotation and displacement of the other camera.
Matrix6d withCommonError(const StereoCamera& camera, const Pose& T_a_b, const EstimateOptions& options,
                         const Matrix6d& information) {
  Matrix6d spread = Matrix6d::Zero();
  spread.topLeftCorner<3, 3>() = options.common_m * Eigen::Matrix3d::Identity();
  spread.bottomRightCorner<3, 3>() = T_a_b.R() * (options.common_px / camera.left.fx);
  // (C + spread spread^T)^-1, without inverting the information, which may be singular
  const Matrix6d seen = information * spread;
  const Matrix6d inner = Matrix6d::Identity() + spread.transpose() * seen;
  // Eigen solves a transposed right side by rows, with another order of summation than solveByLdlt.
  const Matrix6d result = information - seen * inner.ldlt().solve(seen.transpose());
  return 0.5 * (result + result.transpose());
}

/// Sets the outcome of each measurement, the number of inliers and their mean residual.
void classifyMeasurements(const std::vector<PointMeasurement>& measurements, const std::vector<Reduced>& reduced,
                          double scale2, const EstimateOptions& options, Estimate& result) {
  result.measurements.resize(measurements.size());
  double total = 0.0;
  for (std::size_t i = 0; i < measurements.size(); ++i) {
    MeasurementOutcome& outcome = result.measurements[i];
    if (!reduced[i].visible) continue;
    outcome.chi2 = reduced[i].chi2;
    outcome.residual_px = reduced[i].residual_px;
    outcome.inlier = outcome.chi2 < scale2 * (measurements[i].coordinates() == 3 ? kGateThree : kGateTwo) &&
                     outcome.residual_px <= options.largest_residual_px;
    if (!outcome.inlier) continue;
    ++result.inliers;
    total += outcome.residual_px;
  }
  result.reprojection_px = result.inliers > 0 ? total / result.inliers : 0.0;
}

}  // namespace

Estimate estimate(const StereoCamera& camera, const std::vector<PointMeasurement>& measurements, const Pose& start,
                  const EstimateOptions& options) {
  Estimate result;
  result.T_a_b = start;
  std::vector<double> rho(measurements.size()), ratios;
  for (std::size_t i = 0; i < measurements.size(); ++i) rho[i] = inverseDepth(measurements[i], camera);
  std::vector<Reduced> reduced(measurements.size());
  const double offset_weight =
      options.sigma_offset > 0.0 ? 1.0 / (options.sigma_offset * options.sigma_offset) : kExactOffset * kExactOffset;
  const auto linearise = [&] {
    for (std::size_t i = 0; i < measurements.size(); ++i)
      reduced[i] = reduce(measurements[i], camera, result.T_a_b, result.offset, rho[i]);
    return options.scaled ? estimateScale(measurements, reduced, ratios) : 1.0;
  };
  const auto sum = [&](double scale2, Matrix7d& H, Vector7d& b) {
    H.setZero();
    b.setZero();
    for (const Reduced& r : reduced) {
      if (!r.visible) continue;
      const double weight = computeWeight(r.chi2, scale2) / scale2;
      H += weight * r.H;
      b += weight * r.b;
    }
    H(kOfOffset, kOfOffset) += offset_weight;
    b[kOfOffset] -= offset_weight * result.offset;
  };
  Matrix7d H;
  Vector7d b;
  double scale2 = 1.0;
  for (int step = 0; step < options.steps; ++step) {
    scale2 = linearise();
    sum(scale2, H, b);
    H.diagonal().array() += kAnchor;
    const Vector7d d = urban_nav_core::solveByLdlt<7, 1>(H, b);
    if (!d.allFinite()) return result;
    result.T_a_b = urban_nav_core::boxPlus(result.T_a_b, d.head<6>());
    result.offset += d[kOfOffset];
    if (d.head<3>().norm() < kSettledM && d.segment<3>(3).norm() < kSettledRad) break;
  }
  scale2 = linearise();
  sum(scale2, H, b);
  if (options.scaled) {
    const Inflation larger = inflation(camera, measurements, reduced, scale2, H);
    Vector7d by = Vector7d::Ones();
    by.head<3>().setConstant(1.0 / std::sqrt(larger.translation));
    by.segment<3>(3).setConstant(1.0 / std::sqrt(larger.rotation));
    H = (by.asDiagonal() * H * by.asDiagonal()).eval();
  }
  result.noise_factor = std::sqrt(scale2);
  const Eigen::Matrix<double, 6, 1> cross = H.block<6, 1>(0, kOfOffset);
  result.information = H.topLeftCorner<6, 6>() - cross * cross.transpose() / H(kOfOffset, kOfOffset);
  result.information = withCommonError(camera, result.T_a_b, options, result.information);
  classifyMeasurements(measurements, reduced, scale2, options, result);
  result.found = result.inliers >= 3 && result.T_a_b.isFinite() && result.information.allFinite();
  return result;
}

}  // namespace urban_nav_registration
