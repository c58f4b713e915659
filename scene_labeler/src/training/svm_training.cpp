// SPDX-License-Identifier: BSD-3-Clause
#include "training/svm_training.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/ml.hpp>

#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

constexpr int kMostIterations = 20000;
constexpr std::size_t kMostPerClass = 600;  // limits the number of support vectors, and hence the time per frame

/// Returns mean and deviation of a column over the samples that `take` accepts.
template <typename Take>
std::pair<float, float> momentsWhere(const ValueSamples& samples, std::size_t column, const Take& take) {
  double sum = 0.0, square = 0.0, count = 0.0;
  for (std::size_t i = 0; i < samples.labels.size(); ++i) {
    const auto value = static_cast<double>(samples.values[i * samples.features + column]);
    if (std::isnan(value) || !take(samples.labels[i])) continue;
    sum += value;
    square += value * value;
    count += 1.0;
  }
  if (count < 1.0) return {0.0F, 1.0F};
  const double mean = sum / count;
  return {static_cast<float>(mean), static_cast<float>(std::sqrt(std::max(square / count - mean * mean, 1e-6)))};
}

cv::Mat scaleValues(const ValueSamples& samples, const SvmBank& bank) {
  cv::Mat scaled(static_cast<int>(samples.labels.size()), static_cast<int>(samples.features), CV_32F);
  for (std::size_t i = 0; i < samples.labels.size(); ++i)
    for (std::size_t f = 0; f < samples.features; ++f) {
      const float value = samples.values[i * samples.features + f];
      scaled.at<float>(static_cast<int>(i), static_cast<int>(f)) =
          std::isnan(value) ? 0.0F : std::clamp((value - bank.means[f]) * bank.inverse_deviations[f], -10.0F, 10.0F);
    }
  return scaled;
}

/// Trains one class against the others of its group.
KernelMachine trainMachine(const ValueSamples& samples, const cv::Mat& scaled, std::size_t of_class,
                           const SvmSettings& settings) {
  cv::Mat rows, answers;
  std::vector<std::size_t> taken(samples.classes, 0);
  for (std::size_t i = 0; i < samples.labels.size(); ++i) {
    const std::size_t label = samples.labels[i];
    if (samples.is_ground[label] != samples.is_ground[of_class] || ++taken[label] > kMostPerClass) continue;
    rows.push_back(scaled.row(static_cast<int>(i)));
    answers.push_back(label == of_class ? 1 : 0);
  }
  KernelMachine machine;
  machine.gamma = settings.gamma / static_cast<double>(samples.features);
  const int positive = cv::countNonZero(answers);
  if (positive == 0 || positive == answers.rows) {  // the only class of its group
    machine.rho = positive == 0 ? 1.0 : -1.0;
    return machine;
  }
  const cv::Ptr<cv::ml::SVM> svm = cv::ml::SVM::create();
  svm->setType(cv::ml::SVM::C_SVC);
  svm->setKernel(cv::ml::SVM::RBF);
  svm->setC(settings.c);
  svm->setGamma(machine.gamma);
  svm->setTermCriteria({cv::TermCriteria::MAX_ITER + cv::TermCriteria::EPS, kMostIterations, 1e-3});
  svm->train(rows, cv::ml::ROW_SAMPLE, answers);
  cv::Mat alphas, numbers;
  machine.rho = svm->getDecisionFunction(0, alphas, numbers);
  const cv::Mat vectors = svm->getSupportVectors();
  for (int i = 0; i < numbers.cols * numbers.rows; ++i) {
    const cv::Mat vector = vectors.row(numbers.at<int>(i));
    machine.vectors.insert(machine.vectors.end(), vector.begin<float>(), vector.end<float>());
    machine.weights.push_back(static_cast<float>(alphas.at<double>(i)));
  }
  // OpenCV's decision function is positive for the class with the smaller label: flip it for this class.
  for (float& weight : machine.weights) weight = -weight;
  machine.rho = -machine.rho;
  return machine;
}

}  // namespace

SvmBank trainSvmBank(const ValueSamples& samples, const SvmSettings& settings) {
  SvmBank bank;
  bank.is_ground = samples.is_ground;
  bank.ground_columns = samples.ground_columns;
  for (std::size_t f = 0; f < samples.features; ++f) {
    const auto [mean, deviation] = momentsWhere(samples, f, [](std::uint8_t) { return true; });
    bank.means.push_back(mean);
    bank.inverse_deviations.push_back(1.0F / deviation);
  }
  double ground = 1.0;
  for (const std::uint8_t label : samples.labels) ground += samples.is_ground[label] != 0 ? 1.0 : 0.0;
  bank.ground_prior = ground / static_cast<double>(samples.labels.size() + 2);
  for (const std::uint8_t group : {std::uint8_t{1}, std::uint8_t{0}})
    for (std::size_t f = 0; f < 2; ++f) {
      const auto [mean, deviation] = momentsWhere(
          samples, samples.ground_columns[f], [&](std::uint8_t label) { return samples.is_ground[label] == group; });
      bank.ground_moments.push_back(mean);
      bank.ground_moments.push_back(std::max(deviation, 0.02F));
    }
  const cv::Mat scaled = scaleValues(samples, bank);
  bank.machines.resize(samples.classes);
  urban_nav_core::forEach(samples.classes, 1,
                          [&](std::size_t k) { bank.machines[k] = trainMachine(samples, scaled, k, settings); });
  return bank;
}

}  // namespace scene_labeler
