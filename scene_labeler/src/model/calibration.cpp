// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/calibration.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/dense.hpp"

namespace scene_labeler {
namespace {

constexpr double kPriorWeight = 20.0;  // samples: a class with fewer held-out samples keeps a bias near 0
constexpr double kNoScore = -1e3;      // of a class without held-out samples: its frequency is unknown
constexpr double kLeastScale = 0.05, kMostScale = 5.0;
constexpr int kNewtonSteps = 40;

/// Gradient and Gauss-Newton matrix of the negative log likelihood; parameters: scale, then the biases.
struct LikelihoodTerms {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
  double cost = 0.0;
};

LikelihoodTerms evaluateLikelihood(const HeldOutScores& samples, const std::vector<bool>& is_present,
                                   const Eigen::VectorXd& parameters) {
  const auto classes = static_cast<Eigen::Index>(samples.classes);
  LikelihoodTerms terms{Eigen::VectorXd::Zero(classes + 1), Eigen::MatrixXd::Zero(classes + 1, classes + 1), 0.0};
  Eigen::VectorXd z(classes), score(classes);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    for (Eigen::Index k = 0; k < classes; ++k)
      score[k] = static_cast<double>(samples.scores[i * samples.classes + static_cast<std::size_t>(k)]);
    z = parameters[0] * score + parameters.tail(classes);
    for (Eigen::Index k = 0; k < classes; ++k)
      if (!is_present[static_cast<std::size_t>(k)]) z[k] = kNoScore;
    z.array() -= z.maxCoeff();
    const double logsum = std::log(z.array().exp().sum());
    const Eigen::VectorXd p = (z.array() - logsum).exp();
    const double weight = static_cast<double>(samples.weights[i]);
    const auto label = static_cast<Eigen::Index>(samples.labels[i]);
    terms.cost -= weight * (z[label] - logsum);
    Eigen::VectorXd residual = p;
    residual[label] -= 1.0;
    const double mean_score = p.dot(score);
    terms.gradient[0] += weight * residual.dot(score);
    terms.gradient.tail(classes) += weight * residual;
    terms.curvature(0, 0) += weight * (p.dot(score.cwiseProduct(score)) - mean_score * mean_score);
    const Eigen::VectorXd cross = weight * p.cwiseProduct((score.array() - mean_score).matrix());
    terms.curvature.block(1, 0, classes, 1) += cross;
    terms.curvature.block(1, 1, classes, classes) += weight * (Eigen::MatrixXd(p.asDiagonal()) - p * p.transpose());
  }
  terms.curvature.block(0, 1, 1, classes) = terms.curvature.block(1, 0, classes, 1).transpose();
  const Eigen::VectorXd bias = parameters.tail(classes);
  terms.cost += 0.5 * kPriorWeight * bias.squaredNorm() + 0.5 * (parameters[0] - 1.0) * (parameters[0] - 1.0);
  terms.gradient.tail(classes) += kPriorWeight * bias;
  terms.gradient[0] += parameters[0] - 1.0;
  terms.curvature.diagonal().tail(classes).array() += kPriorWeight;
  terms.curvature(0, 0) += 1.0;
  return terms;
}

}  // namespace

void normaliseLogs(float* logs, std::size_t count) {
  const float highest = *std::max_element(logs, logs + count);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) sum += std::exp(static_cast<double>(logs[i] - highest));
  const float logsum = highest + static_cast<float>(std::log(sum));
  for (std::size_t i = 0; i < count; ++i) logs[i] -= logsum;
}

void Calibration::apply(float* scores) const {
  for (std::size_t k = 0; k < bias.size(); ++k) scores[k] = static_cast<float>(scale) * scores[k] + bias[k];
  normaliseLogs(scores, bias.size());
}

void Calibration::archive(urban_nav_core::Archive& archive) { archive(scale, bias); }

Calibration fitCalibration(const HeldOutScores& samples) {
  const auto classes = static_cast<Eigen::Index>(samples.classes);
  Eigen::VectorXd parameters = Eigen::VectorXd::Zero(classes + 1);
  parameters[0] = 1.0;
  std::vector<bool> is_present(samples.classes, false);
  for (const std::uint8_t label : samples.labels) is_present[label] = true;
  LikelihoodTerms terms = evaluateLikelihood(samples, is_present, parameters);
  for (int step = 0; step < kNewtonSteps; ++step) {
    Eigen::VectorXd change = -terms.curvature.ldlt().solve(terms.gradient);
    bool is_better = false;
    for (int halving = 0; halving < 12 && !is_better; ++halving, change *= 0.5) {
      Eigen::VectorXd next = parameters + change;
      next[0] = std::clamp(next[0], kLeastScale, kMostScale);
      LikelihoodTerms candidate = evaluateLikelihood(samples, is_present, next);
      if (!(candidate.cost < terms.cost)) continue;
      is_better = true;
      parameters = next;
      terms = std::move(candidate);
    }
    if (!is_better || change.norm() < 1e-6) break;
  }
  Calibration calibration;
  calibration.scale = parameters[0];
  for (Eigen::Index k = 0; k < classes; ++k) calibration.bias.push_back(static_cast<float>(parameters[k + 1]));
  return calibration;
}

}  // namespace scene_labeler
