// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/training/teaching.hpp"

#include <algorithm>
#include <cmath>

#include "scene_labeler/labelling/labeler.hpp"
#include "scene_labeler/labelling/superpixels.hpp"

namespace scene_labeler {
namespace {

/// Weights of a superpixel in one frame: large ones must not outweigh all other samples.
constexpr float kPatchWeight = 50.0F, kKnownPatchWeight = 20.0F;  // the latter where most answers are right

/// Returns whether a scene shows a kind of place without training data, where most uncorrected answers may be wrong.
bool showsNewPlace(const LabelModel& model, const Scene& scene, const FeatureTable& table) {
  std::vector<std::uint8_t> is_asked(scene.points.size(), 0);
  for (std::size_t i = 0; i < is_asked.size(); ++i)
    is_asked[i] = scene.points[i].allFinite() && scene.isAsked(i) ? 1 : 0;
  return isNewPlace(model.place_novelty.shareUnlike(model.bins, table, is_asked));
}

constexpr std::size_t kMostAnchors = 300;  // per scene

SceneClass findAnswer(const LabelModel& model, const float* row) {
  std::vector<float> logs(model.classes.size());
  model.logProbabilities(row, logs.data());
  return model.classes[static_cast<std::size_t>(std::max_element(logs.begin(), logs.end()) - logs.begin())];
}

/// Adds returns whose answer is not among the corrected classes; rows from `first` on.
void addAnchors(const LabelModel& model, const Scene& scene, const FeatureTable& table, std::size_t first,
                FoldRows& rows) {
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < scene.points.size(); ++i)
    if (scene.points[i].allFinite() && scene.isAsked(i)) asked.push_back(i);
  std::vector<SceneClass> wrong;
  for (std::size_t i = first; i < rows.labels.size(); ++i)
    wrong.push_back(findAnswer(model, rows.values.data() + i * table.columns()));
  const std::size_t drawn = std::min(kMostAnchors, asked.size());
  for (std::size_t n = 0; n < drawn; ++n) {
    const float* row = table.row(asked[n * asked.size() / drawn]);
    const SceneClass answer = findAnswer(model, row);
    if (std::find(wrong.begin(), wrong.end(), answer) != wrong.end()) continue;
    rows.values.insert(rows.values.end(), row, row + table.columns());
    rows.labels.push_back(answer);
    rows.patches.push_back(kNoPatch);
    rows.weights.push_back(kAnchorWeight);
  }
}

}  // namespace

std::vector<TrainingFold> restoreFolds(const LabelModel& model) {
  const ModelSamples& stored = model.samples;
  const std::size_t columns = model.bins.columns();
  std::vector<TrainingFold> folds;
  for (const std::string& name : stored.folds) folds.push_back({name, {}, {}});
  std::vector<float> counts(model.classes.size(), 0.0F);
  for (std::size_t i = 0; i < stored.size(); ++i)
    if (stored.weights[i] == 1) counts[stored.labels[i]] += 1.0F;
  const auto add = [&](std::size_t i, float weight, FoldRows& rows) {
    for (std::size_t column = 0; column < columns; ++column)
      rows.values.push_back(model.bins.decode(column, stored.codes[i * columns + column]));
    rows.labels.push_back(model.classes[stored.labels[i]]);
    rows.patches.push_back(kNoPatch);
    rows.weights.push_back(weight);
  };
  for (std::size_t i = 0; i < stored.size(); ++i) {
    TrainingFold& fold = folds[stored.places[i]];
    add(i, stored.weights[i], fold.samples);
    const float frequency = stored.frequencies[stored.labels[i]];
    if (stored.weights[i] == 1 && frequency > 0.0F) add(i, frequency / counts[stored.labels[i]], fold.held_out);
  }
  return folds;
}

CorrectionCount addCorrections(const LabelModel& model, const Scene& scene, std::vector<SceneClass> labels,
                               int superpixel_size, const std::string& fold, std::vector<TrainingFold>& folds) {
  const FeatureTable table = measureSceneFeatures(model, scene);
  return addCorrections(model, table, labelScene(model, scene, superpixel_size, table), std::move(labels), fold, folds);
}

CorrectionCount addCorrections(const LabelModel& model, const FeatureTable& table, const SceneLabels& answer,
                               std::vector<SceneClass> labels, const std::string& fold,
                               std::vector<TrainingFold>& folds) {
  const bool has_one_wall =
      std::find(model.classes.begin(), model.classes.end(), SceneClass::Wall) != model.classes.end();
  CorrectionCount count;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (has_one_wall) labels[i] = withOneWall(labels[i]);
    if (answer.labels[i] == SceneClass::None) labels[i] = SceneClass::None;
    count.labelled += labels[i] != SceneClass::None ? 1U : 0U;
    if (labels[i] == answer.labels[i]) labels[i] = SceneClass::None;
    count.corrected += labels[i] != SceneClass::None ? 1U : 0U;
  }
  if (count.corrected == 0) return count;
  SamplingLimits limits;
  limits.held_out = 0;  // wrong answers only are not representative for calibration
  std::vector<TrainingFold> made;
  addScene({fold, table, labels, std::vector<std::uint32_t>(labels.size(), kNoPatch)}, limits, made);
  for (float& weight : made.front().samples.weights) weight = kCorrectionWeight;
  folds.push_back(std::move(made.front()));
  return count;
}

std::size_t addPatchCorrections(const LabelModel& model, const Scene& scene,
                                const std::vector<PatchCorrection>& corrections, int superpixel_size,
                                TrainingFold& fold) {
  if (corrections.empty()) return 0;
  const std::vector<std::uint32_t> patches = makePatches(scene, makeSuperpixels(scene.view.image, superpixel_size));
  const FeatureTable table = measureSceneFeatures(model, scene);
  const bool has_one_wall =
      std::find(model.classes.begin(), model.classes.end(), SceneClass::Wall) != model.classes.end();
  std::size_t added = 0;
  FoldRows& rows = fold.samples;
  const std::size_t first = rows.labels.size();
  const bool is_new_place = showsNewPlace(model, scene, table);
  for (const PatchCorrection& correction : corrections) {
    const std::size_t before = rows.labels.size();
    for (std::size_t i = 0; i < patches.size(); ++i) {
      const bool is_member =
          i == correction.point || (patches[i] == patches[correction.point] && patches[i] != kNoPatch);
      if (!is_member) continue;
      rows.values.insert(rows.values.end(), table.row(i), table.row(i) + table.columns());
      rows.labels.push_back(has_one_wall ? withOneWall(correction.label) : correction.label);
      rows.patches.push_back(kNoPatch);
    }
    const std::size_t members = rows.labels.size() - before;
    const float weight = std::round((is_new_place ? kPatchWeight : kKnownPatchWeight) / static_cast<float>(members));
    rows.weights.resize(rows.labels.size(), std::clamp(weight, 2.0F, kCorrectionWeight));
    added += members;
  }
  if (model.kind == ClassifierKind::Boosted && !is_new_place) addAnchors(model, scene, table, first, rows);
  return added;
}

}  // namespace scene_labeler
