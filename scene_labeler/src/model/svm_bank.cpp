// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/model/svm_bank.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace scene_labeler {
namespace {

constexpr double kLeastLog = -12.0;
constexpr std::size_t kMomentCount = 8;  // two groups, mean and deviation of two features

double logSigmoid(double x) { return x < -30.0 ? x : -std::log1p(std::exp(-x)); }

/// Returns the log density of height above ground and normal; a missing value is neutral.
double logDensity(const float* row, const std::vector<std::uint8_t>& columns, const float* moments) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 2; ++i) {
    const float value = row[columns[i]];
    if (std::isnan(value)) continue;
    const double deviation = static_cast<double>(moments[2 * i + 1]);
    const double distance = static_cast<double>(value - moments[2 * i]) / deviation;
    sum -= 0.5 * distance * distance + std::log(deviation);
  }
  return sum;
}

}  // namespace

double KernelMachine::evaluate(const float* features, std::size_t size) const {
  double sum = -rho;
  const float* vector = vectors.data();
  for (const float weight : weights) {
    float square = 0.0F;
    for (std::size_t i = 0; i < size; ++i) square += (features[i] - vector[i]) * (features[i] - vector[i]);
    sum += static_cast<double>(weight * std::exp(-static_cast<float>(gamma) * square));
    vector += size;
  }
  return sum;
}

void KernelMachine::archive(urban_nav_core::Archive& archive) { archive(gamma, rho, vectors, weights); }

void SvmBank::evaluate(const float* row, float* scores) const {
  const std::size_t size = means.size();
  std::vector<float> scaled(size);
  for (std::size_t i = 0; i < size; ++i)
    scaled[i] = std::isnan(row[i]) ? 0.0F : std::clamp((row[i] - means[i]) * inverse_deviations[i], -10.0F, 10.0F);
  const double odds = std::log(ground_prior) - std::log(1.0 - ground_prior) +
                      logDensity(row, ground_columns, ground_moments.data()) -
                      logDensity(row, ground_columns, ground_moments.data() + kMomentCount / 2);
  const std::array<double, 2> group_log = {logSigmoid(-odds), logSigmoid(odds)};
  for (std::size_t k = 0; k < machines.size(); ++k) {
    const double margin = machines[k].evaluate(scaled.data(), size);
    scores[k] = static_cast<float>(std::max(kLeastLog, logSigmoid(margin) + group_log[is_ground[k] != 0 ? 1 : 0]));
  }
}

void SvmBank::archive(urban_nav_core::Archive& archive, std::size_t features, std::size_t classes) {
  archive(means, inverse_deviations, machines, is_ground, ground_moments, ground_columns, ground_prior);
  if (!archive.isReading()) return;
  bool is_sound = means.size() == features && inverse_deviations.size() == features && machines.size() == classes &&
                  is_ground.size() == classes && ground_moments.size() == kMomentCount && ground_columns.size() == 2 &&
                  ground_prior > 0.0 && ground_prior < 1.0;
  for (const std::uint8_t column : ground_columns) is_sound = is_sound && column < features;
  for (const KernelMachine& machine : machines)
    is_sound = is_sound && machine.vectors.size() == machine.weights.size() * features;
  for (std::size_t i = 1; is_sound && i < kMomentCount; i += 2) is_sound = ground_moments[i] > 0.0F;
  archive.require(is_sound, "its machines do not match features and classes");
}

}  // namespace scene_labeler
