// SPDX-License-Identifier: BSD-3-Clause
#include "recognition/logistic_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace fabmap_node {
namespace {

constexpr int kMostSteps = 200;
constexpr double kSufficientShare = 1e-4;     // of the decrease predicted by the gradient (Nocedal and Wright, 3.4)
constexpr double kDecreaseTolerance = 1e-14;  // nats per sample; the gradient is then below its square root

struct LogisticSlope {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd hessian;
};

/// log(1 + exp(x)), without overflow.
double softplus(double x) { return std::max(x, 0.0) + std::log1p(std::exp(-std::abs(x))); }

LogisticSlope computeSlope(const LogisticSamples& samples, double penalty, const Eigen::VectorXd& coefficients) {
  const Eigen::VectorXd p = (samples.x * coefficients).unaryExpr(&logistic);
  const Eigen::VectorXd residual = samples.weight.cwiseProduct(p - samples.target);
  const Eigen::VectorXd curvature = samples.weight.array() * p.array() * (1.0 - p.array());
  LogisticSlope slope;
  slope.gradient = samples.x.transpose() * residual + penalty * coefficients;
  slope.hessian = samples.x.transpose() * curvature.asDiagonal() * samples.x;
  slope.hessian.diagonal().array() += penalty;
  return slope;
}

/// Returns Newton's step of the free coefficients.
Eigen::VectorXd computeStep(LogisticSlope slope, const std::vector<bool>& is_held) {
  for (Eigen::Index i = 0; i < slope.gradient.size(); ++i) {
    if (!is_held[static_cast<std::size_t>(i)]) continue;
    slope.gradient(i) = 0.0;
    slope.hessian.row(i).setZero();
    slope.hessian.col(i).setZero();
    slope.hessian(i, i) = 1.0;
  }
  return slope.hessian.ldlt().solve(-slope.gradient);
}

/// Frees the bounded coefficient with the steepest decrease of the loss. Returns false if there is none.
bool releaseSteepest(const Eigen::VectorXd& gradient, double tolerance, std::vector<bool>& is_held) {
  std::size_t steepest = is_held.size();
  double slope = -tolerance;
  for (std::size_t i = 0; i < is_held.size(); ++i) {
    if (!is_held[i] || gradient(static_cast<Eigen::Index>(i)) >= slope) continue;
    slope = gradient(static_cast<Eigen::Index>(i));
    steepest = i;
  }
  if (steepest == is_held.size()) return false;
  is_held[steepest] = false;
  return true;
}

/// Returns the share of a step, up to one, until the first bounded coefficient reaches zero, and its index (-1: none).
std::pair<double, Eigen::Index> computeReach(const Eigen::VectorXd& coefficients, const Eigen::VectorXd& change) {
  std::pair<double, Eigen::Index> reach{1.0, -1};
  for (Eigen::Index i = 0; i + 1 < coefficients.size(); ++i)
    if (change(i) < 0.0 && coefficients(i) + reach.first * change(i) < 0.0) reach = {-coefficients(i) / change(i), i};
  return reach;
}

}  // namespace

double logistic(double x) { return x >= 0.0 ? 1.0 / (1.0 + std::exp(-x)) : std::exp(x) / (1.0 + std::exp(x)); }

double logisticLoss(const LogisticSamples& samples, double penalty, const Eigen::VectorXd& coefficients) {
  const Eigen::VectorXd logit = samples.x * coefficients;
  double loss = 0.5 * penalty * coefficients.squaredNorm();
  for (Eigen::Index i = 0; i < logit.size(); ++i)
    loss += samples.weight(i) * (softplus(logit(i)) - samples.target(i) * logit(i));
  return loss;
}

Eigen::VectorXd fitLogistic(const LogisticSamples& samples, double penalty) {
  Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(samples.x.cols());
  std::vector<bool> is_held(static_cast<std::size_t>(coefficients.size()), true);
  is_held.back() = false;
  const double tolerance = kDecreaseTolerance * std::max(1.0, samples.weight.sum());
  double loss = logisticLoss(samples, penalty, coefficients);
  for (int step = 0; step < kMostSteps; ++step) {
    const LogisticSlope slope = computeSlope(samples, penalty, coefficients);
    const Eigen::VectorXd change = computeStep(slope, is_held);
    const double decrease = -slope.gradient.dot(change);  // predicted by the quadratic model, for twice the loss
    if (decrease <= tolerance) {
      if (!releaseSteepest(slope.gradient, std::sqrt(tolerance), is_held)) break;
      continue;
    }
    const auto [reach, blocking] = computeReach(coefficients, change);
    double share = reach;
    const auto next_loss = [&] { return logisticLoss(samples, penalty, coefficients + share * change); };
    while (share > 0.0 && next_loss() > loss - kSufficientShare * share * decrease) share *= 0.5;
    coefficients += share * change;
    if (blocking >= 0 && share == reach) {
      coefficients(blocking) = 0.0;
      is_held[static_cast<std::size_t>(blocking)] = true;
    }
    loss = logisticLoss(samples, penalty, coefficients);
  }
  return coefficients;
}

}  // namespace fabmap_node
