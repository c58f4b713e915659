// SPDX-License-Identifier: BSD-3-Clause
#include "training/patch_fusion.hpp"

#include <algorithm>
#include <cmath>

#include "scene_labeler/labelling/fuse.hpp"
#include "scene_labeler/labelling/superpixels.hpp"

namespace scene_labeler {
namespace {

struct PatchSums {
  std::vector<double> sums;  // per patch and class
  std::vector<std::size_t> counts;
};

PatchSums sumPatches(const HeldOutPatches& held_out) {
  PatchSums result;
  const std::size_t classes = held_out.points.classes;
  for (std::size_t i = 0; i < held_out.patches.size(); ++i) {
    const std::size_t patch = held_out.patches[i];
    if (patch == kNoPatch) continue;
    if (patch >= result.counts.size()) {
      result.counts.resize(patch + 1, 0);
      result.sums.resize((patch + 1) * classes, 0.0);
    }
    ++result.counts[patch];
    for (std::size_t k = 0; k < classes; ++k)
      result.sums[patch * classes + k] += static_cast<double>(held_out.points.scores[i * classes + k]);
  }
  return result;
}

HeldOutScores fuseScores(const HeldOutPatches& held_out, const PatchSums& sums, double correlation) {
  HeldOutScores fused = held_out.points;
  for (std::size_t i = 0; i < held_out.patches.size(); ++i) {
    const std::size_t patch = held_out.patches[i];
    if (patch == kNoPatch) continue;
    const double factor = effectiveCount(sums.counts[patch], correlation) / static_cast<double>(sums.counts[patch]);
    for (std::size_t k = 0; k < fused.classes; ++k)
      fused.scores[i * fused.classes + k] = static_cast<float>(factor * sums.sums[patch * fused.classes + k]);
  }
  return fused;
}

double meanLogLoss(const HeldOutScores& samples) {
  double sum = 0.0;
  std::vector<float> logs(samples.classes);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    std::copy_n(samples.scores.begin() + static_cast<std::ptrdiff_t>(i * samples.classes), samples.classes,
                logs.begin());
    normaliseLogs(logs.data(), logs.size());
    sum -= static_cast<double>(logs[samples.labels[i]]);
  }
  return sum;
}

}  // namespace

void fitPatchFusion(const HeldOutPatches& held_out, LabelModel& model) {
  const PatchSums sums = sumPatches(held_out);
  double best = 0.0;
  bool has_best = false;
  for (const double correlation : {0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0}) {
    const double loss = meanLogLoss(fuseScores(held_out, sums, correlation));
    if (has_best && loss >= best) continue;
    has_best = true;
    best = loss;
    model.correlation = correlation;
  }
  model.patch_calibration = fitCalibration(fuseScores(held_out, sums, model.correlation));
}

HeldOutScores fusedAsByModel(const HeldOutPatches& held_out, const LabelModel& model) {
  HeldOutScores fused = fuseScores(held_out, sumPatches(held_out), model.correlation);
  for (std::size_t i = 0; i < held_out.patches.size(); ++i)
    if (held_out.patches[i] != kNoPatch) model.patch_calibration.apply(fused.scores.data() + i * fused.classes);
  return fused;
}

}  // namespace scene_labeler
