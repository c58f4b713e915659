// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/term_equations.hpp"

#include <cmath>
#include <utility>

#include "urban_nav_core/geometry/dense.hpp"

namespace laser_mapper {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kConverged = 0.05;  // of a standard deviation

}  // namespace

TermEquations& TermEquations::operator+=(const TermEquations& other) {
  information += other.information;
  gradient += other.gradient;
  scatter += other.scatter;
  patches += other.patches;
  return *this;
}

TermEquations zeroEquations(std::size_t devices) {
  const auto terms = static_cast<Index>(kCalibrationTerms * devices);
  return {MatrixXd::Zero(terms, terms), VectorXd::Zero(terms), MatrixXd::Zero(terms, terms), 0};
}

std::optional<TermStep> solveTerms(TermEquations equations, const VectorXd& terms, const std::vector<bool>& wanted) {
  for (Index i = 0; i < terms.size(); ++i) {
    const double prior = 1.0 / std::pow(priorSigmas()(i % kCalibrationTerms), 2);
    equations.information(i, i) += prior;
    equations.scatter(i, i) += prior;
    equations.gradient(i) -= prior * terms(i);
    if (wanted[static_cast<std::size_t>(i)]) continue;
    for (MatrixXd* matrix : {&equations.information, &equations.scatter}) {
      matrix->row(i).setZero();
      matrix->col(i).setZero();
      (*matrix)(i, i) = prior;
    }
    equations.gradient(i) = 0.0;
  }
  const auto covariance = urban_nav_core::invertPositiveDefinite(equations.information);
  if (!covariance) return std::nullopt;
  TermStep step;
  step.change = *covariance * equations.gradient;
  step.estimate.mean = terms;
  for (Index first = 0; first < terms.size(); first += kCalibrationTerms)
    step.estimate.mean.segment<kCalibrationTerms>(first) =
        changedTerms(terms.segment<kCalibrationTerms>(first), step.change.segment<kCalibrationTerms>(first));
  const MatrixXd by_scatter = *covariance * equations.scatter * *covariance;
  const VectorXd inflation = (by_scatter.diagonal().array() / covariance->diagonal().array()).max(1.0).sqrt().matrix();
  step.estimate.covariance = inflation.asDiagonal() * *covariance * inflation.asDiagonal();
  step.estimate.conditional_sigma = equations.information.diagonal().cwiseSqrt().cwiseInverse();
  return step;
}

bool isConverged(const TermStep& step) {
  for (Index i = 0; i < step.change.size(); ++i)
    if (std::abs(step.change(i)) > kConverged * step.estimate.sigma(i)) return false;
  return true;
}

}  // namespace laser_mapper
