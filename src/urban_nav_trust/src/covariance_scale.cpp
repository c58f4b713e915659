// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_trust/covariance_scale.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace urban_nav_trust {

namespace {

// Largest prior factor, 400 as a variance, the prior range of the disparity offset (docs/derivations/rig_constants.md).
// Factors below 1 are excluded: variances are never reduced.
constexpr double kMostScale = 20.0;

ScaleWeights normalise(const ScaleWeights& log_weights) {
  const double largest = *std::max_element(log_weights.begin(), log_weights.end());
  ScaleWeights weights{};
  double sum = 0.0;
  for (std::size_t i = 0; i < kScaleCount; ++i) sum += weights[i] = std::exp(log_weights[i] - largest);
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// Returns the log likelihood of a normally distributed difference, up to a constant.
double logLikelihood(double squares, double axes, double variance) {
  return -0.5 * (squares / variance + axes * std::log(variance));
}

}  // namespace

const ScaleWeights& covarianceScales() {
  static const ScaleWeights scales = [] {
    ScaleWeights values{};
    for (std::size_t i = 0; i < kScaleCount; ++i)
      values[i] = std::pow(kMostScale, (static_cast<double>(i) + 0.5) / static_cast<double>(kScaleCount));
    return values;
  }();
  return scales;
}

void ScaleEvidence::add(const ScaleWeights& log_likelihoods) {
  if (!std::all_of(log_likelihoods.begin(), log_likelihoods.end(), [](double each) { return std::isfinite(each); }))
    return;
  is_empty_ = false;
  for (std::size_t i = 0; i < kScaleCount; ++i) log_likelihoods_[i] += log_likelihoods[i];
}

void ScaleEvidence::add(const Eigen::VectorXd& difference, const Eigen::MatrixXd& odometry,
                        const Eigen::MatrixXd& other) {
  if (difference.size() == 0 || !difference.allFinite()) return;
  ScaleWeights log_likelihoods{};
  for (std::size_t i = 0; i < kScaleCount; ++i) {
    const double scale = covarianceScales()[i];
    const Eigen::LLT<Eigen::MatrixXd> factor(scale * scale * odometry + other);
    if (factor.info() != Eigen::Success) return;
    const double log_determinant = 2.0 * factor.matrixLLT().diagonal().array().log().sum();
    log_likelihoods[i] = -0.5 * (difference.dot(factor.solve(difference)) + log_determinant);
  }
  add(log_likelihoods);
}

void ScaleEvidence::add(const ScaleEvidence& other) {
  if (!other.is_empty_) add(other.log_likelihoods_);
}

ScaleWeights ScaleEvidence::probabilities() const { return normalise(log_likelihoods_); }

void WindowEvidence::add(double squares, double axes, double odometry, double other, double unit) {
  if (!std::isfinite(squares) || !std::isfinite(other) || !(odometry > 0.0) || !std::isfinite(odometry)) return;
  is_empty_ = false;
  for (std::size_t f = 0; f < kFloors; ++f) {
    const double floor = unit * floor_ * static_cast<double>(f) / static_cast<double>(kFloors - 1);
    for (std::size_t i = 0; i < kScaleCount; ++i) {
      const double scale = covarianceScales()[i];
      log_likelihoods_[f][i] += logLikelihood(squares, axes, scale * scale * odometry + other + floor * floor);
    }
  }
}

ScaleEvidence WindowEvidence::evidence() const {
  ScaleEvidence evidence;
  if (is_empty_) return evidence;
  ScaleWeights averaged{};
  for (std::size_t i = 0; i < kScaleCount; ++i) {
    double largest = log_likelihoods_[0][i], sum = 0.0;
    for (const ScaleWeights& each : log_likelihoods_) largest = std::max(largest, each[i]);
    for (const ScaleWeights& each : log_likelihoods_) sum += std::exp(each[i] - largest);
    averaged[i] = largest + std::log(sum);
  }
  evidence.add(averaged);
  return evidence;
}

ScaleWeights largerScale(const ScaleWeights& a, const ScaleWeights& b) {
  ScaleWeights larger{};
  double below_a = 0.0, below_b = 0.0;
  for (std::size_t i = 0; i < kScaleCount; ++i) {
    const double to_a = below_a + a[i], to_b = below_b + b[i];
    larger[i] = to_a * to_b - below_a * below_b;
    below_a = to_a;
    below_b = to_b;
  }
  return larger;
}

}  // namespace urban_nav_trust
