// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace fabmap_node {

/// Samples of a logistic regression.
struct LogisticSamples {
  Eigen::MatrixXd x;       ///< a sample in each row; the last column is that of the intercept
  Eigen::VectorXd target;  ///< probability that the sample is of the first kind, 0 ... 1
  Eigen::VectorXd weight;  ///< not negative
};

/// 1 / (1 + exp(-x)), without overflow.
double logistic(double x);

/// Negative log posterior of coefficients: the weighted cross entropy of the samples in nats, and a Gaussian prior of
/// mean zero and precision `penalty` on every coefficient. Convex.
double logisticLoss(const LogisticSamples& samples, double penalty, const Eigen::VectorXd& coefficients);

/// Returns the coefficients that minimise logisticLoss() where all but the last are not negative, by Newton's method
/// on the coefficients that the bound does not hold (active set: Nocedal and Wright, section 16.5). Requires
/// penalty > 0. Deterministic.
Eigen::VectorXd fitLogistic(const LogisticSamples& samples, double penalty);

}  // namespace fabmap_node
