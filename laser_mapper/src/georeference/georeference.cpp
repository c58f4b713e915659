// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/georeference/georeference.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "urban_nav_core/geometry/level_motion.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace laser_mapper {

using Eigen::Vector2d;
using Eigen::Vector3d;
using urban_nav_core::LevelMotion;
using urban_nav_core::LocalTangent;

namespace {

constexpr std::size_t kFewestFixes = 10;
constexpr double kMostHeadingSigma = 10.0 * M_PI / 180.0;  // then positions are no more accurate than the fixes
constexpr double kCorrelationTime = 180.0;                 // s: errors of ephemeris and ionosphere change over minutes
constexpr double kCauchyWidth = 2.4;                       // standard deviations: 95 % efficiency for normal errors
constexpr double kNarrower = 0.7;                          // per iteration, from the width that keeps all fixes
constexpr int kMostRounds = 60;
constexpr std::size_t kMostInSums = 500;  // fixes

double horizontalSigma(const AntennaFix& fix) {
  return std::max(0.01, std::hypot(fix.sigma.x(), fix.sigma.y()) / M_SQRT2);
}

double normalisedError(const LevelMotion& fit, const AntennaFix& fix, const Vector3d& local) {
  return (fit * fix.p_map - local).head<2>().norm() / horizontalSigma(fix);
}

double middleValue(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double medianSigma(const std::vector<AntennaFix>& fixes) {
  std::vector<double> sigmas;
  for (const AntennaFix& fix : fixes) sigmas.push_back(horizontalSigma(fix));
  return middleValue(std::move(sigmas));
}

std::string roundedText(double value, double step) {
  return urban_nav_core::printNumber(std::round(value / step) / std::round(1.0 / step));
}

/// Fits with all fixes, then with decreasing kernel width.
LevelMotion fitRobustly(const std::vector<AntennaFix>& fixes, const std::vector<Vector3d>& local,
                        std::vector<double>& weights) {
  std::vector<Vector3d> places;
  for (const AntennaFix& fix : fixes) places.push_back(fix.p_map);
  weights.assign(fixes.size(), 0.0);
  for (std::size_t i = 0; i < fixes.size(); ++i) weights[i] = 1.0 / std::pow(horizontalSigma(fixes[i]), 2);
  LevelMotion fit = urban_nav_core::fitLevelMotion(places, local, weights);
  double width = kCauchyWidth;
  for (std::size_t i = 0; i < fixes.size(); ++i) width = std::max(width, normalisedError(fit, fixes[i], local[i]));
  for (int round = 0; round < kMostRounds; ++round, width = std::max(kCauchyWidth, kNarrower * width)) {
    for (std::size_t i = 0; i < fixes.size(); ++i) {
      const double error = normalisedError(fit, fixes[i], local[i]) / width;
      weights[i] = 1.0 / (std::pow(horizontalSigma(fixes[i]), 2) * (1.0 + error * error));
    }
    fit = urban_nav_core::fitLevelMotion(places, local, weights);
  }
  return fit;
}

/// Uses the median of the heights, which do not depend on the heading.
void fitHeight(const std::vector<AntennaFix>& fixes, const std::vector<Vector3d>& local, LevelMotion& fit) {
  std::vector<double> differences;
  for (std::size_t i = 0; i < fixes.size(); ++i) differences.push_back(local[i].z() - fixes[i].p_map.z());
  fit.shift.z() = middleValue(differences);
}

/// Fix in the sums over pairs.
struct WeightedLever {
  double seconds = 0.0, weight = 0.0;
  Vector2d lever = Vector2d::Zero();  ///< m, from the centre of the fixes
};

/// Returns at most kMostInSums of the fixes, evenly subsampled, with weights that sum to 1.
std::vector<WeightedLever> weightedLevers(const std::vector<AntennaFix>& fixes, const std::vector<double>& weights) {
  std::vector<WeightedLever> levers;
  double all = 0.0;
  Vector2d mean = Vector2d::Zero();
  const std::size_t step = (fixes.size() + kMostInSums - 1) / kMostInSums;
  for (std::size_t i = 0; i < fixes.size(); i += step) {
    levers.push_back(
        {urban_nav_core::secondsBetween(fixes.front().stamp, fixes[i].stamp), weights[i], fixes[i].p_map.head<2>()});
    all += weights[i];
    mean += weights[i] * levers.back().lever;
  }
  for (WeightedLever& each : levers) {
    each.weight /= all;
    each.lever -= mean / all;
  }
  return levers;
}

/// Propagates the covariance of errors with the receiver's sigmas, correlated over kCorrelationTime, through the fit.
void stateUncertainty(const std::vector<AntennaFix>& fixes, const std::vector<double>& weights, GeoReference& made) {
  const std::vector<WeightedLever> levers = weightedLevers(fixes, weights);
  double spread = 0.0, position = 0.0, turn = 0.0;  // m^2; relative variance of position for one fix; m^2
  for (const WeightedLever& a : levers) {
    spread += a.weight * a.lever.squaredNorm();
    for (const WeightedLever& b : levers) {
      const double shared = a.weight * b.weight * std::exp(-std::abs(a.seconds - b.seconds) / kCorrelationTime);
      position += shared;
      turn += shared * a.lever.dot(b.lever);
    }
  }
  std::vector<double> heights;
  for (const AntennaFix& fix : fixes) heights.push_back(fix.sigma.z());
  made.position_sigma = medianSigma(fixes) * std::sqrt(position);
  made.height_sigma = middleValue(std::move(heights)) * std::sqrt(position);
  made.heading_sigma = medianSigma(fixes) * std::sqrt(std::max(turn, 1e-12)) / std::max(spread, 1e-6);
}

}  // namespace

GeoFit fitGeoReference(const std::vector<AntennaFix>& fixes) {
  if (fixes.size() < kFewestFixes)
    return {std::nullopt, std::to_string(fixes.size()) + " GPS fixes at times with a pose, " +
                              std::to_string(kFewestFixes) + " are needed"};
  GeoReference made;
  std::vector<double> latitudes, longitudes, heights;
  for (const AntennaFix& fix : fixes) {
    latitudes.push_back(fix.measured.latitude);
    longitudes.push_back(std::remainder(fix.measured.longitude - fixes.front().measured.longitude, 2.0 * M_PI));
    heights.push_back(fix.measured.height);
  }
  made.origin = {middleValue(latitudes), fixes.front().measured.longitude + middleValue(longitudes),
                 middleValue(heights)};
  const LocalTangent tangent(made.origin);
  std::vector<Vector3d> local;
  for (const AntennaFix& fix : fixes) local.push_back(tangent.toLocal(fix.measured));
  std::vector<double> weights, residuals;
  LevelMotion fit = fitRobustly(fixes, local, weights);
  fitHeight(fixes, local, fit);
  for (std::size_t i = 0; i < fixes.size(); ++i)
    residuals.push_back((fit * fixes[i].p_map - local[i]).head<2>().norm());
  made.T_local_map = urban_nav_core::Pose(Eigen::Quaterniond(Eigen::AngleAxisd(fit.yaw, Vector3d::UnitZ())), fit.shift);
  made.fixes = fixes.size();
  made.residual = middleValue(residuals);
  stateUncertainty(fixes, weights, made);
  if (made.heading_sigma > kMostHeadingSigma)
    return {std::nullopt, "the path is too short for fixes with a standard deviation of " +
                              roundedText(medianSigma(fixes), 0.1) + " m: the heading would be uncertain by " +
                              roundedText(made.heading_sigma * 180.0 / M_PI, 0.1) + " deg"};
  return {made, ""};
}

}  // namespace laser_mapper
