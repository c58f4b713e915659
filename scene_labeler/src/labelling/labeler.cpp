// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/labeler.hpp"

#include <algorithm>
#include <cmath>

#include "labelling/spread.hpp"
#include "labelling/sure_rule.hpp"
#include "scene_labeler/labelling/fuse.hpp"
#include "scene_labeler/labelling/superpixels.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace scene_labeler {
namespace {

double shareAmong(const std::vector<std::uint8_t>& members, const std::vector<std::uint8_t>& all) {
  const auto count = std::count(all.begin(), all.end(), std::uint8_t{1});
  return count == 0 ? 0.0
                    : static_cast<double>(std::count(members.begin(), members.end(), std::uint8_t{1})) /
                          static_cast<double>(count);
}

/// Fuses the log probabilities of the returns over patches, in place.
void fusePatches(const LabelModel& model, const std::vector<std::uint32_t>& patches, std::vector<float>& logs) {
  const std::size_t classes = model.classes.size();
  std::vector<double> sums;
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (patches[i] == kNoPatch) continue;
    if (patches[i] >= counts.size()) {
      counts.resize(patches[i] + std::size_t{1}, 0);
      sums.resize((patches[i] + std::size_t{1}) * classes, 0.0);
    }
    ++counts[patches[i]];
    for (std::size_t k = 0; k < classes; ++k)
      sums[patches[i] * classes + k] += static_cast<double>(logs[i * classes + k]);
  }
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (patches[i] == kNoPatch) continue;
    const double factor =
        effectiveCount(counts[patches[i]], model.correlation) / static_cast<double>(counts[patches[i]]);
    for (std::size_t k = 0; k < classes; ++k)
      logs[i * classes + k] = static_cast<float>(factor * sums[patches[i] * classes + k]);
    model.patch_calibration.apply(logs.data() + i * classes);
  }
}

void smoothInScene(const Scene& scene, std::size_t classes, std::vector<float>& logs) {
  std::vector<std::uint8_t> is_labelled = scene.view.is_visible;
  if (scene.view.image.empty()) is_labelled.assign(scene.points.size(), 1);
  for (std::size_t i = 0; i < is_labelled.size(); ++i)
    if (!scene.isAsked(i)) is_labelled[i] = 0;
  smoothLabels(scene.points, is_labelled, classes, logs);
}

void spreadInScene(const Scene& scene, const std::vector<SceneClass>& classes, std::vector<float>& logs) {
  std::vector<std::uint8_t> is_shown = scene.view.is_visible, is_hidden(is_shown.size(), 0);
  for (std::size_t i = 0; i < is_shown.size(); ++i) {
    is_hidden[i] = is_shown[i] == 0 && scene.isAsked(i) ? 1 : 0;
    if (!scene.isAsked(i)) is_shown[i] = 0;
  }
  spreadToHidden(scene.points, is_shown, is_hidden, classes, logs);
}

/// Assigns to each superpixel with labelled returns the class with the largest sum of probabilities.
cv::Mat paintSuperpixels(const Scene& scene, const Superpixels& superpixels, const SceneLabels& result) {
  const std::size_t classes = result.classes.size();
  const std::vector<std::uint8_t>& visible = scene.view.is_visible;
  std::vector<float> sums(static_cast<std::size_t>(superpixels.count) * classes, 0.0F);
  for (std::size_t i = 0; i < visible.size(); ++i) {
    if (visible[i] == 0 || result.labels[i] == SceneClass::None) continue;
    const auto number =
        static_cast<std::size_t>(superpixels.numbers.at<int>(static_cast<int>(std::lround(scene.view.pixels[i].y())),
                                                             static_cast<int>(std::lround(scene.view.pixels[i].x()))));
    for (std::size_t k = 0; k < classes; ++k) sums[number * classes + k] += result.probabilities[i * classes + k];
  }
  cv::Mat image(superpixels.numbers.size(), CV_8U, cv::Scalar(static_cast<double>(SceneClass::None)));
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const auto first = sums.begin() + superpixels.numbers.at<int>(y, x) * static_cast<std::ptrdiff_t>(classes);
      const auto best = std::max_element(first, first + static_cast<std::ptrdiff_t>(classes));
      if (*best > 0.0F)
        image.at<std::uint8_t>(y, x) =
            static_cast<std::uint8_t>(result.classes[static_cast<std::size_t>(best - first)]);
    }
  return image;
}

}  // namespace

float SceneLabels::probability(std::size_t i) const {
  const auto first = probabilities.begin() + static_cast<std::ptrdiff_t>(i * classes.size());
  return *std::max_element(first, first + static_cast<std::ptrdiff_t>(classes.size()));
}

FeatureTable measureSceneFeatures(const LabelModel& model, const Scene& scene) {
  return measureFeatures(scene, model.features, scene.device == model.device);
}

SceneLabels labelScene(const LabelModel& model, const Scene& scene, int superpixel_size) {
  return labelScene(model, scene, superpixel_size, measureSceneFeatures(model, scene));
}

SceneLabels labelScene(const LabelModel& model, const Scene& scene, int superpixel_size, const FeatureTable& table) {
  const Superpixels superpixels = makeSuperpixels(scene.view.image, superpixel_size);
  const std::size_t classes = model.classes.size(), count = scene.points.size();
  std::vector<float> logs(count * classes);
  SceneLabels result;
  result.classes = model.classes;
  result.labels.assign(count, SceneClass::None);
  result.unsure.assign(count, 0);
  result.probabilities.assign(count * classes, 0.0F);
  std::vector<std::uint8_t> is_asked(count, 0), is_novel(count, 0);
  for (std::size_t i = 0; i < count; ++i) is_asked[i] = scene.points[i].allFinite() && scene.isAsked(i) ? 1 : 0;
  urban_nav_core::forEach(count, 256, [&](std::size_t i) {
    if (is_asked[i] == 0) return;
    model.logProbabilities(table.row(i), logs.data() + i * classes);
    is_novel[i] = model.countOutside(table.row(i)) > model.novelty.limit ? 1 : 0;
  });
  result.share_unlike = model.place_novelty.shareUnlike(model.bins, table, is_asked);
  const SureRule rule(model, {scene.device != model.device, result.share_unlike, shareAmong(is_novel, is_asked)});
  result.patches = makePatches(scene, superpixels);
  for (std::size_t i = 0; i < count; ++i)
    if (!scene.isAsked(i)) result.patches[i] = kNoPatch;
  fusePatches(model, result.patches, logs);
  smoothInScene(scene, classes, logs);
  if (!scene.view.image.empty()) spreadInScene(scene, model.classes, logs);
  std::vector<float> fused(classes);
  for (std::size_t i = 0; i < count; ++i) {
    if (is_asked[i] == 0) continue;
    float sum = 0.0F;
    float* probabilities = result.probabilities.data() + i * classes;
    for (std::size_t k = 0; k < classes; ++k) sum += probabilities[k] = std::exp(logs[i * classes + k]);
    for (std::size_t k = 0; k < classes; ++k) probabilities[k] /= sum;
    std::copy_n(probabilities, classes, fused.begin());
    doubtKinds(result.share_unlike, model.classes, probabilities);
    const auto best =
        static_cast<std::size_t>(std::max_element(probabilities, probabilities + classes) - probabilities);
    result.labels[i] = model.classes[best];
    result.unsure[i] = rule.isUnsure(fused[best], probabilities[best], is_novel[i] != 0) ? 1 : 0;
  }
  if (rule.testsNovelty())
    urban_nav_core::forEach(count, 64, [&](std::size_t i) {
      if (is_asked[i] != 0 && result.unsure[i] == 0)
        result.unsure[i] = model.place_novelty.isNovel(model.bins, table.row(i)) ? 1 : 0;
    });
  if (!superpixels.numbers.empty()) result.image = paintSuperpixels(scene, superpixels, result);
  return result;
}

}  // namespace scene_labeler
