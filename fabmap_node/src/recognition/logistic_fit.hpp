// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace fabmap_node {

/// Samples of a logistic regression.
struct LogisticSamples {
  Eigen::MatrixXd x;       ///< one sample per row; the last column is the intercept
  Eigen::VectorXd target;  ///< probability of the first kind, 0 ... 1
  Eigen::VectorXd weight;  ///< non-negative
};

/// Returns 1 / (1 + exp(-x)), without overflow.
double logistic(double x);

/// Returns the negative log posterior of coefficients: the weighted cross entropy of the samples in nats, and a
/// Gaussian prior of mean zero and precision `penalty` on every coefficient. Convex.
double logisticLoss(const LogisticSamples& samples, double penalty, const Eigen::VectorXd& coefficients);

/// Returns the coefficients that minimise logisticLoss() with all but the last non-negative, by Newton's method on the
/// free coefficients (active set: Nocedal and Wright, section 16.5). Requires penalty > 0. Deterministic.
Eigen::VectorXd fitLogistic(const LogisticSamples& samples, double penalty);

}  // namespace fabmap_node
