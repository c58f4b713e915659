// SPDX-License-Identifier: BSD-3-Clause
#include "robust/inlier_likelihood.hpp"

#include <algorithm>
#include <cmath>

namespace pose_graph {

namespace {

constexpr double kAsStated = 0.05;  // share; a hundredth or a fifth moves what is gained by less than two

}  // namespace

double logInlierLikelihood(double log_at_zero, int rank, double chi2, double variance) {
  const double narrow = log_at_zero - 0.5 * rank * std::log(variance) - 0.5 * chi2 / variance;
  if (!(variance < 1.0)) return narrow;
  const double a = std::log(1.0 - kAsStated) + narrow, b = std::log(kAsStated) + log_at_zero - 0.5 * chi2;
  return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b)));
}

}  // namespace pose_graph
