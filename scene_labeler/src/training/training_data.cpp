// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/training/training_data.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

#include "scene_labeler/labelling/superpixels.hpp"

namespace scene_labeler {
namespace {

void addRow(const TrainingScene& scene, std::size_t i, std::uint32_t patch, FoldRows& rows) {
  rows.values.insert(rows.values.end(), scene.features.row(i), scene.features.row(i) + scene.features.columns());
  rows.labels.push_back(scene.labels[i]);
  rows.patches.push_back(patch);
  rows.weights.push_back(1.0F);
}

/// Hashes numbers, so that patches are drawn from the whole scene.
std::uint32_t scatter(std::uint32_t number) { return number * 2654435761U; }  // Knuth 1973, 6.4

std::uint32_t firstFreePatch(const FoldRows& rows) {
  std::uint32_t first = 0;
  for (const std::uint32_t patch : rows.patches)
    if (patch != kNoPatch) first = std::max(first, patch + 1);
  return first;
}

void addHeldOut(const TrainingScene& scene, std::size_t limit, FoldRows& rows) {
  std::size_t labelled = 0;
  for (const SceneClass label : scene.labels) labelled += label != SceneClass::None ? 1U : 0U;
  if (labelled == 0 || limit == 0) return;
  const double share = std::min(1.0, static_cast<double>(limit) / static_cast<double>(labelled));
  const auto threshold = static_cast<std::uint32_t>(share * 4294967295.0);
  const std::uint32_t first = firstFreePatch(rows);
  for (std::uint32_t i = 0; i < scene.labels.size(); ++i) {
    if (scene.labels[i] == SceneClass::None) continue;
    const bool has_patch = scene.patches[i] != kNoPatch;
    if (scatter(has_patch ? scene.patches[i] : i) > threshold) continue;
    addRow(scene, i, has_patch ? first + scene.patches[i] : kNoPatch, rows);
  }
}

void appendRows(const FoldRows& from, FoldRows& to) {
  const std::uint32_t first = firstFreePatch(to);
  to.values.insert(to.values.end(), from.values.begin(), from.values.end());
  to.labels.insert(to.labels.end(), from.labels.begin(), from.labels.end());
  to.weights.insert(to.weights.end(), from.weights.begin(), from.weights.end());
  for (const std::uint32_t patch : from.patches) to.patches.push_back(patch == kNoPatch ? kNoPatch : first + patch);
}

}  // namespace

void mergeFold(TrainingFold fold, std::vector<TrainingFold>& folds) {
  const auto known =
      std::find_if(folds.begin(), folds.end(), [&](const TrainingFold& f) { return f.name == fold.name; });
  if (known == folds.end()) {
    folds.push_back(std::move(fold));
    return;
  }
  appendRows(fold.samples, known->samples);
  appendRows(fold.held_out, known->held_out);
}

void addScene(const TrainingScene& scene, const SamplingLimits& limits, std::vector<TrainingFold>& folds) {
  auto fold = std::find_if(folds.begin(), folds.end(), [&](const TrainingFold& f) { return f.name == scene.fold; });
  if (fold == folds.end()) fold = folds.insert(folds.end(), TrainingFold{scene.fold, {}, {}});
  std::array<std::vector<std::size_t>, kClassCount> members;
  for (std::size_t i = 0; i < scene.labels.size(); ++i)
    if (scene.labels[i] != SceneClass::None) members[toIndex(scene.labels[i])].push_back(i);
  for (const std::vector<std::size_t>& of_class : members) {
    const std::size_t wanted = std::min(of_class.size(), limits.samples_per_class);
    for (std::size_t i = 0; i < wanted; ++i)
      addRow(scene, of_class[i * of_class.size() / wanted], kNoPatch, fold->samples);
  }
  addHeldOut(scene, limits.held_out, fold->held_out);
}

void addHalves(const TrainingScene& training, const Scene& scene, const SamplingLimits& limits,
               std::vector<TrainingFold>& folds) {
  Eigen::AlignedBox2f extent;
  for (std::size_t i = 0; i < training.labels.size(); ++i)
    if (training.labels[i] != SceneClass::None) extent.extend(scene.points[i].head<2>());
  if (extent.isEmpty()) return addScene(training, limits, folds);
  const Eigen::Index axis = extent.sizes().y() > extent.sizes().x() ? 1 : 0;
  const float middle = extent.center()[axis];
  for (const int half : {1, 2}) {
    TrainingScene part = training;
    part.fold += "/" + std::to_string(half);
    for (std::size_t i = 0; i < part.labels.size(); ++i) {
      const bool is_second = scene.points[i][axis] > middle;
      if (is_second != (half == 2)) part.labels[i] = SceneClass::None;
    }
    addScene(part, limits, folds);
  }
}

}  // namespace scene_labeler
