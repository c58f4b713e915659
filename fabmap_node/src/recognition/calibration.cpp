// SPDX-License-Identifier: BSD-3-Clause
#include "fabmap_node/recognition/calibration.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "recognition/logistic_fit.hpp"

namespace fabmap_node {
namespace {

constexpr double kSimilarConsecutive = 20.0;  // number of similar consecutive samples that count as one: 10 m of
                                              // panoramas at 2 Hz and 1 m/s
constexpr double kConstantDeviation = 1e-9;   // for evidence that is constant over all samples
constexpr auto kEvidenceSize = static_cast<Eigen::Index>(PlaceEvidence::kSize);

std::size_t countRight(const std::vector<CalibrationSample>& samples) {
  return static_cast<std::size_t>(
      std::count_if(samples.begin(), samples.end(), [](const CalibrationSample& s) { return s.is_same_place; }));
}

/// Returns samples with the targets `yes` and `no` of the two kinds, with equal total weights.
LogisticSamples asLogistic(const std::vector<CalibrationSample>& samples, double yes, double no) {
  const auto count = static_cast<Eigen::Index>(samples.size());
  double right_weight = 0.0, wrong_weight = 0.0;
  for (const CalibrationSample& sample : samples) (sample.is_same_place ? right_weight : wrong_weight) += sample.weight;
  LogisticSamples made{Eigen::MatrixXd::Ones(count, kEvidenceSize + 1), Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const CalibrationSample& sample = samples[static_cast<std::size_t>(i)];
    const auto values = sample.evidence.values();
    for (Eigen::Index k = 0; k < kEvidenceSize; ++k) made.x(i, k) = values[static_cast<std::size_t>(k)];
    made.target(i) = sample.is_same_place ? yes : no;
    made.weight(i) =
        sample.weight * static_cast<double>(count) / (2.0 * (sample.is_same_place ? right_weight : wrong_weight));
  }
  return made;
}

/// Returns the standard deviation of each column but the last; infinite for a constant one.
Eigen::VectorXd computeDeviations(const Eigen::MatrixXd& x) {
  const auto evidence = x.leftCols(kEvidenceSize);
  const Eigen::RowVectorXd mean = evidence.colwise().mean();
  Eigen::VectorXd deviation = (evidence.rowwise() - mean).cwiseAbs2().colwise().mean().cwiseSqrt();
  for (double& each : deviation)
    if (each < kConstantDeviation) each = std::numeric_limits<double>::infinity();
  return deviation;
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

PlaceCalibration fitCalibration(const std::vector<CalibrationSample>& samples, double prior_deviation) {
  const std::size_t right = countRight(samples), wrong = samples.size() - right;
  PlaceCalibration calibration;
  if (right == 0 || wrong == 0) return calibration;
  // Targets of Platt (1999): a sample is evidence for its kind, not certainty.
  calibration.ceiling = (static_cast<double>(right) + 1.0) / (static_cast<double>(right) + 2.0);
  calibration.floor = 1.0 / (static_cast<double>(wrong) + 2.0);
  LogisticSamples logistic_samples = asLogistic(samples, calibration.ceiling, calibration.floor);
  const Eigen::VectorXd deviation = computeDeviations(logistic_samples.x);
  for (Eigen::Index k = 0; k < kEvidenceSize; ++k) logistic_samples.x.col(k) /= deviation(k);
  const Eigen::VectorXd fitted =
      fitLogistic(logistic_samples, kSimilarConsecutive / (prior_deviation * prior_deviation));
  for (Eigen::Index k = 0; k < kEvidenceSize; ++k)
    calibration.weights[static_cast<std::size_t>(k)] = fitted(k) / deviation(k);
  calibration.bias = fitted(kEvidenceSize);
  return calibration;
}

}  // namespace fabmap_node
