// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/depth_comparison.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/normal_tail.hpp"

namespace urban_nav_trust {

using urban_nav_core::formatNumber;

namespace {

constexpr int kUnknowns = 7;  // scale, rotation, translation
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

constexpr std::size_t kLeastKeyframes = 8;
constexpr std::size_t kLeastMatches = 200;
constexpr int kDepthIterations = 10;
constexpr double kDepthHuber = 1.5;  // standard deviations
// Standard deviations of the priors: scale, rotation (rad) and translation (m) of the mounting in tf.
constexpr double kScalePrior = 0.2, kTurnPrior = 0.01, kShiftPrior = 0.02;
constexpr int kLeastPoints = 20;  // per keyframe, for the assignment of the lasers

Vector toRow(const SurfaceMatch& match) {
  const Eigen::Vector3d q = match.p - match.excess * match.normal;
  Vector row;
  row << match.normal.dot(q), q.cross(match.normal), match.normal;
  return row;
}

double medianAbsolute(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Matrix priorInformation() {
  Vector sigma;
  sigma << kScalePrior, Eigen::Vector3d::Constant(kTurnPrior), Eigen::Vector3d::Constant(kShiftPrior);
  return sigma.cwiseAbs2().cwiseInverse().asDiagonal();
}

Interval span(const std::vector<KeyframeMatches>& keyframes) {
  return {keyframes.front().stamp, keyframes.back().stamp};
}

bool addScaleTest(const std::vector<KeyframeMatches>& keyframes, double rig_scale,
                  std::vector<ConsistencyTest>& tests) {
  const DepthScale found = estimateDepthScale(keyframes);
  if (!(found.sigma > 0.0)) return false;
  const double z = found.scale / std::hypot(found.sigma, rig_scale);
  ConsistencyTest test;
  test.name = kDepthScaleTest;
  test.interval = span(keyframes);
  test.statistic = z * z;
  test.degrees_of_freedom = 1.0;
  test.p_value = urban_nav_core::normalTwoSidedTail(z);
  test.sentence = "Distances by stereo are " + formatNumber(100.0 * std::abs(found.scale)) + " % (+-" +
                  formatNumber(100.0 * found.sigma, 2) + ") " + (found.scale < 0.0 ? "shorter" : "longer") +
                  " than those by the lasers, at " + std::to_string(found.matches) + " points of " +
                  std::to_string(found.keyframes) + " keyframes.";
  test.remedy =
      "The baseline or the focal length of the stereo pair is wrong: calibrate it, or set "
      "input.baseline_scale to " +
      formatNumber(1.0 / (1.0 + found.scale), 4) + ".";
  tests.push_back(std::move(test));
  return true;
}

bool addExchangeTest(const std::vector<KeyframeMatches>& keyframes, std::vector<ConsistencyTest>& tests) {
  double sum = 0.0, squares = 0.0, stated = 0.0, exchanged = 0.0;
  int count = 0;
  for (const KeyframeMatches& keyframe : keyframes) {
    if (keyframe.points < kLeastPoints || keyframe.as_stated + keyframe.exchanged == 0) continue;
    const double difference =
        static_cast<double>(keyframe.exchanged - keyframe.as_stated) / (keyframe.exchanged + keyframe.as_stated);
    sum += difference;
    squares += difference * difference;
    stated += static_cast<double>(keyframe.as_stated) / keyframe.points;
    exchanged += static_cast<double>(keyframe.exchanged) / keyframe.points;
    ++count;
  }
  if (count < static_cast<int>(kLeastKeyframes)) return false;
  const double mean = sum / count, variance = std::max(1e-6, squares / count - mean * mean) / count;
  ConsistencyTest test;
  test.name = kExchangeTest;
  test.interval = span(keyframes);
  test.statistic = mean / std::sqrt(variance);
  test.degrees_of_freedom = count;
  test.p_value = urban_nav_core::normalUpperTail(test.statistic);
  test.sentence = formatNumber(100.0 * stated / count, 2) +
                  " % of the stereo points on walls lie on surfaces measured by the lasers, " +
                  formatNumber(100.0 * exchanged / count, 2) + " % if the left and right laser are exchanged.";
  test.remedy =
      "The left and right laser are exchanged: exchange the topics of laser_left and laser_right (--topic), or the "
      "cables.";
  tests.push_back(std::move(test));
  return true;
}

}  // namespace

DepthScale estimateDepthScale(const std::vector<KeyframeMatches>& keyframes) {
  DepthScale found;
  std::vector<double> residuals;
  for (const KeyframeMatches& keyframe : keyframes) {
    if (!keyframe.matches.empty()) ++found.keyframes;
    for (const SurfaceMatch& match : keyframe.matches) residuals.push_back(match.excess);
  }
  found.matches = residuals.size();
  if (found.keyframes < kLeastKeyframes || found.matches < kLeastMatches) return found;
  const Matrix prior = priorInformation();
  Vector x = Vector::Zero();
  Matrix information, scores;
  for (int i = 0; i < kDepthIterations; ++i) {
    const double scatter = std::max(1e-3, 1.4826 * medianAbsolute(residuals));
    residuals.clear();
    information = prior;
    scores.setZero();
    Vector right = Vector::Zero();
    for (const KeyframeMatches& keyframe : keyframes) {
      Vector score = Vector::Zero();
      for (const SurfaceMatch& match : keyframe.matches) {
        const Vector row = toRow(match);
        const double residual = match.excess - row.dot(x);
        const double sigma = std::hypot(scatter, match.sigma);
        const double weight =
            std::min(1.0, kDepthHuber * sigma / std::max(1e-12, std::abs(residual))) / (sigma * sigma);
        residuals.push_back(residual);
        information += weight * row * row.transpose();
        right += weight * match.excess * row;
        score += weight * residual * row;
      }
      scores += score * score.transpose();
    }
    x = information.ldlt().solve(right);
    if (!x.allFinite()) return found;
  }
  const Matrix inverse = information.inverse();
  found.scale = x[0];
  found.sigma = std::sqrt((inverse * (scores + prior) * inverse)(0, 0));
  return found;
}

void testDepths(const std::vector<KeyframeMatches>& keyframes, double rig_scale, std::vector<ConsistencyTest>& tests,
                std::vector<AbsentMeasurement>& absent) {
  const char* reason = keyframes.empty() ? "no keyframes with dense stereo and laser scans"
                                         : "too few surfaces were measured by both stereo and lasers";
  if (keyframes.empty() || !addScaleTest(keyframes, rig_scale, tests)) absent.push_back({kDepthScaleTest, reason});
  if (keyframes.empty() || !addExchangeTest(keyframes, tests)) absent.push_back({kExchangeTest, reason});
}

}  // namespace urban_nav_trust
