// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/class_frequencies.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scene_labeler/model/calibration.hpp"

namespace scene_labeler {
namespace {

constexpr double kTrainedWeight = 8000.0;  // returns, weight of the training frequencies
constexpr double kMemory = 1e5;            // returns, about 15 s of one laser at short range
constexpr double kUsedShare = 0.5;         // of the logarithm of frequencies
constexpr int kIterations = 5;

double sumOf(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

}  // namespace

ClassFrequencies::ClassFrequencies(const LabelModel& model) : classes_(model.classes.size()) {
  const std::vector<float>& counts = model.samples.frequencies;
  const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
  if (counts.size() != classes_ || !(total > 0.0)) return;
  for (const float count : counts) trained_.push_back(static_cast<double>(count) / total);
  seen_.assign(classes_, 0.0);
}

std::vector<float> ClassFrequencies::shifts(const std::vector<double>& sums) const {
  const double total = sumOf(sums) + kTrainedWeight;
  std::vector<float> made(classes_, 0.0F);
  for (std::size_t k = 0; k < classes_; ++k) {
    if (!(trained_[k] > 0.0)) continue;  // a class added later, of unknown frequency
    const double here = (sums[k] + kTrainedWeight * trained_[k]) / total;
    made[k] = static_cast<float>(kUsedShare * std::log(here / trained_[k]));
  }
  return made;
}

void ClassFrequencies::correct(std::vector<float>& logs, const std::vector<std::uint8_t>& is_left_out) {
  if (trained_.empty() || logs.empty()) return;
  std::vector<double> sums = seen_;
  std::vector<float> row(classes_);
  for (int iteration = 0; iteration <= kIterations; ++iteration) {
    std::vector<double> next = seen_;
    const std::vector<float> shift = shifts(sums);
    const bool is_last = iteration == kIterations;
    for (std::size_t i = 0; i < logs.size(); i += classes_) {
      if (!is_left_out.empty() && is_left_out[i / classes_] != 0) continue;
      for (std::size_t k = 0; k < classes_; ++k) row[k] = logs[i + k] + shift[k];
      normaliseLogs(row.data(), classes_);
      for (std::size_t k = 0; k < classes_; ++k) next[k] += std::exp(static_cast<double>(row[k]));
      if (is_last) std::copy(row.begin(), row.end(), logs.begin() + static_cast<std::ptrdiff_t>(i));
    }
    sums = std::move(next);
  }
  seen_ = std::move(sums);
  const double total = sumOf(seen_);
  if (total > kMemory)
    for (double& sum : seen_) sum *= kMemory / total;
}

}  // namespace scene_labeler
