// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/labelling/mounting_check.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

namespace scene_labeler {
namespace {

constexpr std::size_t kMostFrames = 4;                             // frames after which the result is final
constexpr std::size_t kLeastCompared = 200, kMostCompared = 2000;  // returns per frame
constexpr float kSureByShape = 0.7F;                               // least probability of a class by shape
constexpr float kLeastImageLog = -4.0F;                            // limits the influence of a single return

/// Kinds that shape distinguishes reliably; lawn and path differ little, and less with inaccurate poses.
enum class ShapeKind { Ground, Wall, Foliage, Other };

ShapeKind shapeKind(SceneClass label) {
  switch (label) {
    case SceneClass::Grass:
    case SceneClass::Paved:
    case SceneClass::DirtPath: return ShapeKind::Ground;
    case SceneClass::TexturedWall:
    case SceneClass::SmoothWall:
    case SceneClass::Wall: return ShapeKind::Wall;
    case SceneClass::Foliage: return ShapeKind::Foliage;
    default: return ShapeKind::Other;
  }
}

/// Returns the log probability that a return is of that kind, at least kLeastImageLog.
double logOfKind(const LabelModel& model, ShapeKind kind, const std::vector<float>& logs) {
  float sum = 0.0F;
  for (std::size_t k = 0; k < logs.size(); ++k)
    if (shapeKind(model.classes[k]) == kind) sum += std::exp(logs[k]);
  return std::max(std::log(std::max(sum, 1e-30F)), kLeastImageLog);
}

}  // namespace

void MountingCheck::add(const Scene& scene, const FeatureTable& table) {
  if (frames_ >= kMostFrames || scene.view.image.empty()) return;
  Scene turned = scene;
  turned.view.image = cv::Mat();  // the copy shares the pixels
  cv::rotate(scene.view.image, turned.view.image, cv::ROTATE_180);
  FeatureTable upside_down = table;
  measureImageFeatures(turned, model_.features, upside_down);
  const std::size_t first_of_image = firstImageFeature(model_.features), classes = model_.classes.size();
  std::vector<float> row(table.columns()), by_shape(classes), by_image(classes), by_turned(classes);
  double sum = 0.0;
  std::size_t returns = 0;
  const auto visible =
      static_cast<std::size_t>(std::count(scene.view.is_visible.begin(), scene.view.is_visible.end(), std::uint8_t{1}));
  const std::size_t step = visible / kMostCompared + 1;
  std::size_t number = 0;
  for (std::size_t i = 0; i < scene.points.size(); ++i) {
    if (scene.view.is_visible[i] == 0 || number++ % step != 0) continue;
    std::copy_n(table.row(i), first_of_image, row.begin());
    std::fill(row.begin() + static_cast<std::ptrdiff_t>(first_of_image), row.end(), kMissingFeature);
    model_.logProbabilities(row.data(), by_shape.data());
    const auto best = static_cast<std::size_t>(std::max_element(by_shape.begin(), by_shape.end()) - by_shape.begin());
    if (by_shape[best] < std::log(kSureByShape)) continue;
    model_.logProbabilities(table.row(i), by_image.data());
    model_.logProbabilities(upside_down.row(i), by_turned.data());
    const ShapeKind kind = shapeKind(model_.classes[best]);
    sum += logOfKind(model_, kind, by_turned) - logOfKind(model_, kind, by_image);
    ++returns;
  }
  if (returns < kLeastCompared) return;
  evidence_ += sum / static_cast<double>(returns);
  ++frames_;
}

}  // namespace scene_labeler
