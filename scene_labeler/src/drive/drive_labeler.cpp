// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/drive/drive_labeler.hpp"

#include <algorithm>
#include <cmath>

#include "labelling/class_votes.hpp"
#include "scene_labeler/labelling/superpixels.hpp"

namespace scene_labeler {
namespace {

/// Below it, another class may be as probable; whether a view is sure is decided by the model's precision.
constexpr float kSureWhenFused = 0.5F;
constexpr float kLeastProbability = 1e-6F;

}  // namespace

std::vector<std::uint8_t> labelledPoints(const DriveScene& drive, const std::vector<DriveReturn>& returns,
                                         const DriveObserver::Stretch& nearest) {
  std::vector<std::uint8_t> is_labelled = drive.scene.view.is_visible;
  is_labelled.resize(drive.scene.points.size(), 0);
  for (std::size_t i = 0; i < returns.size(); ++i)
    if (nearest.holds(returns[i].travelled)) is_labelled[drive.point_of_return[i]] = 1;
  return is_labelled;
}

void DriveLabeler::observe(const DriveFrame& frame, const Stretch& nearest, std::size_t first,
                           const std::vector<DriveReturn>& returns) {
  const std::size_t classes = model_.classes.size(), known = first_ + returns_.size();
  for (std::size_t i = known > first ? known - first : 0; i < returns.size(); ++i) returns_.push_back(returns[i]);
  votes_.resize(returns_.size());
  logs_.resize(returns_.size() * classes, 0.0F);
  const bool is_blind = !frame.view.image.empty() && !isUsable(frame.view.image);
  blind_frames_ += is_blind ? 1U : 0U;
  DriveScene drive = makeDriveScene(returns, is_blind ? SideView() : frame.view);
  FeatureTable table = measureSceneFeatures(model_, drive.scene);
  mounting_.add(drive.scene, table);
  if (!drive.scene.view.image.empty() && mounting_.isUpsideDown()) {
    ++upside_down_frames_;
    drive.scene.view = {};
    measureImageFeatures(drive.scene, model_.features, table);
  }
  drive.scene.is_asked = labelledPoints(drive, returns, nearest);
  const SceneLabels labels = labelScene(model_, drive.scene, parameters_.superpixel, table);
  if (take_image_) take_image_(frame, labels.image);
  ++frames_;
  const bool is_new_place = isNewPlace(labels.share_unlike);
  new_place_frames_ += is_new_place ? 1U : 0U;
  imaged_frames_ += drive.scene.view.image.empty() ? 0U : 1U;
  const std::vector<std::uint8_t>& is_shown = drive.scene.view.is_visible;
  std::uint32_t patches = 0;
  for (std::size_t i = 0; i < returns.size(); ++i) {
    const std::size_t point = drive.point_of_return[i], at = first + i - first_;
    Votes& votes = votes_[at];
    const bool is_shown_here = !is_shown.empty() && is_shown[point] != 0;
    if (labels.labels[point] == SceneClass::None || (!is_shown_here && !nearest.holds(returns[i].travelled))) continue;
    if (!is_shown_here && votes.views > 0) continue;
    if (is_shown_here && votes.by_shape) {
      votes = {};
      std::fill_n(logs_.begin() + static_cast<std::ptrdiff_t>(at * classes), classes, 0.0F);
    }
    votes.by_shape = !is_shown_here;
    ++votes.views;
    if (labels.unsure[point] != 0) ++votes.unsure;
    if (is_new_place) ++votes.in_new_place;
    votes.patch = labels.patches[point] == kNoPatch ? kNoPatch : patches_ + labels.patches[point];
    if (labels.patches[point] != kNoPatch) patches = std::max(patches, labels.patches[point] + 1);
    for (std::size_t k = 0; k < classes; ++k)
      logs_[at * classes + k] += std::log(std::max(labels.probabilities[point * classes + k], kLeastProbability));
  }
  patches_ += patches;
  if (!frame.view.classes.empty()) addClasses(frame, drive, first);
  if (take_scene_) take_scene_(std::move(drive));
}

void DriveLabeler::addClasses(const DriveFrame& frame, const DriveScene& drive, std::size_t first) {
  const SceneView& view = drive.scene.view;
  if (view.image.empty() || frame.view.classes.size() != view.image.size()) return;
  ++class_frames_;
  const ClassVotes votes(model_.classes, parameters_.class_accuracy);
  for (std::size_t i = 0; i < drive.point_of_return.size(); ++i) {
    const std::size_t point = drive.point_of_return[i], at = first + i - first_;
    if (view.is_visible[point] == 0 || votes_[at].views == 0) continue;
    if (votes.add(frame.view.classes, view.pixels[point], &logs_[at * model_.classes.size()])) ++votes_[at].views;
  }
}

void DriveLabeler::settle(std::size_t end) {
  const std::size_t classes = model_.classes.size(), count = std::min(end - first_, returns_.size());
  SceneLabels labels;
  labels.classes = model_.classes;
  std::vector<DriveReturn> answered;
  std::vector<float>& p = labels.probabilities;
  std::vector<std::uint8_t> is_in_new_place;
  for (std::size_t i = 0; i < count; ++i) {
    if (votes_[i].views == 0) continue;
    answered.push_back(returns_[i]);
    labels.patches.push_back(votes_[i].patch);
    is_in_new_place.push_back(2 * votes_[i].in_new_place > votes_[i].views ? 1 : 0);
    for (std::size_t k = 0; k < classes; ++k) p.push_back(logs_[i * classes + k] / static_cast<float>(votes_[i].views));
    normaliseLogs(p.data() + p.size() - classes, classes);
  }
  frequencies_.correct(p, is_in_new_place);
  for (float& value : p) value = std::exp(value);
  auto row = p.begin();
  for (std::size_t i = 0; i < count; ++i) {
    const Votes& votes = votes_[i];
    if (votes.views == 0) continue;
    const auto best = std::max_element(row, row + static_cast<std::ptrdiff_t>(classes));
    labels.labels.push_back(model_.classes[static_cast<std::size_t>(best - row)]);
    labels.unsure.push_back(*best < kSureWhenFused || 2 * votes.unsure > votes.views ? 1 : 0);
    row += static_cast<std::ptrdiff_t>(classes);
  }
  if (!answered.empty()) take_(answered, labels);
  const auto gone = static_cast<std::ptrdiff_t>(count);
  returns_.erase(returns_.begin(), returns_.begin() + gone);
  votes_.erase(votes_.begin(), votes_.begin() + gone);
  logs_.erase(logs_.begin(), logs_.begin() + gone * static_cast<std::ptrdiff_t>(classes));
  first_ = end;
}

}  // namespace scene_labeler
