// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/calibration.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace fabmap_node {
namespace {

constexpr int unknowns = static_cast<int>(PlaceEvidence::size) + 1;  // the weights, then the bias
constexpr double alike = 20.0;          // neighbouring samples that count as one: 10 m of panoramas at 2 Hz and 1 m/s
constexpr double prior_deviation = 5.0;  // of weights of standardised evidence (Gelman et al. 2008, section 3)
constexpr double ridge = alike / (prior_deviation * prior_deviation);
constexpr int newton_steps = 60;
using Unknowns = Eigen::Matrix<double, unknowns, 1>;

double logistic(double x) { return x >= 0.0 ? 1.0 / (1.0 + std::exp(-x)) : std::exp(x) / (1.0 + std::exp(x)); }

struct WeightedRow {
  Unknowns x;
  double target = 0.0, weight = 1.0;
};

/// Newton's method on the penalised log likelihood; unknowns that are not `free` stay zero.
Unknowns fitFree(const std::vector<WeightedRow>& rows, const std::array<bool, PlaceEvidence::size>& free) {
  Unknowns beta = Unknowns::Zero();
  for (int step = 0; step < newton_steps; ++step) {
    Unknowns gradient = Unknowns::Zero();
    Eigen::Matrix<double, unknowns, unknowns> hessian = Eigen::Matrix<double, unknowns, unknowns>::Zero();
    for (const WeightedRow& row : rows) {
      const double p = logistic(row.x.dot(beta));
      gradient += row.weight * (row.target - p) * row.x;
      hessian += row.weight * std::max(1e-9, p * (1.0 - p)) * row.x * row.x.transpose();
    }
    for (int i = 0; i < unknowns; ++i) {
      hessian(i, i) += ridge;
      gradient(i) -= ridge * beta(i);
      if (i + 1 == unknowns || free[static_cast<std::size_t>(i)]) continue;
      hessian.row(i).setZero();
      hessian.col(i).setZero();
      hessian(i, i) = 1.0;
      gradient(i) = 0.0;
    }
    Unknowns change = hessian.ldlt().solve(gradient);
    const double largest = change.cwiseAbs().maxCoeff();
    if (largest > 1.0) change /= largest;  // the curvature vanishes far from the solution
    beta += change;
    if (largest < 1e-10) break;
  }
  return beta;
}

}  // namespace

double PlaceCalibration::logit(const PlaceEvidence& evidence) const {
  double sum = bias;
  const auto values = evidence.values();
  for (std::size_t i = 0; i < values.size(); ++i) sum += weights[i] * values[i];
  return sum;
}

double PlaceCalibration::probability(const PlaceEvidence& evidence) const {
  return floor + (ceiling - floor) * logistic(logit(evidence));
}

PlaceCalibration fitCalibration(const std::vector<CalibrationSample>& samples) {
  const auto right = static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [](const CalibrationSample& s) { return s.is_same_place; }));
  const std::size_t wrong = samples.size() - right;
  PlaceCalibration calibration;
  if (right == 0 || wrong == 0) return calibration;
  // Targets as Platt (1999) has them: a sample is evidence of its kind, not certainty.
  const double yes = (static_cast<double>(right) + 1.0) / (static_cast<double>(right) + 2.0);
  const double no = 1.0 / (static_cast<double>(wrong) + 2.0);
  double right_weight = 0.0, wrong_weight = 0.0;
  for (const CalibrationSample& sample : samples)
    (sample.is_same_place ? right_weight : wrong_weight) += sample.weight;
  Unknowns mean = Unknowns::Zero(), deviation = Unknowns::Zero();
  std::vector<WeightedRow> rows;
  for (const CalibrationSample& sample : samples) {
    WeightedRow row;
    const auto values = sample.evidence.values();
    for (std::size_t i = 0; i < values.size(); ++i) row.x(static_cast<Eigen::Index>(i)) = values[i];
    row.x(unknowns - 1) = 1.0;
    row.target = sample.is_same_place ? yes : no;
    row.weight = sample.weight * static_cast<double>(samples.size()) /
                 (2.0 * (sample.is_same_place ? right_weight : wrong_weight));
    mean += row.x / static_cast<double>(samples.size());
    rows.push_back(row);
  }
  for (const WeightedRow& row : rows) deviation += (row.x - mean).cwiseAbs2() / static_cast<double>(samples.size());
  deviation = deviation.cwiseSqrt().cwiseMax(1e-9);
  for (WeightedRow& row : rows) row.x.head<unknowns - 1>().array() /= deviation.head<unknowns - 1>().array();
  std::array<bool, PlaceEvidence::size> free{};
  for (std::size_t i = 0; i < free.size(); ++i) free[i] = deviation(static_cast<Eigen::Index>(i)) > 1e-8;
  Unknowns beta;
  for (bool again = true; again;) {
    beta = fitFree(rows, free);
    again = false;
    for (std::size_t i = 0; i < free.size(); ++i) {
      if (!free[i] || beta(static_cast<Eigen::Index>(i)) >= 0.0) continue;
      free[i] = false;
      again = true;
    }
  }
  for (std::size_t i = 0; i < free.size(); ++i)
    calibration.weights[i] = beta(static_cast<Eigen::Index>(i)) / deviation(static_cast<Eigen::Index>(i));
  calibration.bias = beta(unknowns - 1);
  calibration.floor = no;
  calibration.ceiling = yes;
  return calibration;
}

}  // namespace fabmap_node
