// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/sweep/sweep_labeler.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "features/growing_cloud.hpp"
#include "scene_labeler/model/calibration.hpp"
#include "scene_labeler/model/place_novelty.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace scene_labeler {
namespace {

constexpr float kSweepReach = 30.0F;  // m; rings of 1.33 deg are 0.7 m apart there, neighbours of cubes of 0.4 m 1.2 m
constexpr float kKeptReach = 45.0F;   // m: returns within reach have the ground within 15 m of them
constexpr float kForgetStep = 10.0F;  // m of travel between two removals of distant cubes
constexpr float kAnswersPerM = 2.5F;  // cubes of 0.4 m: the patches of scenes without an image
constexpr float kSureAnswer = 0.5F;   // as kSureWhenFused of DriveLabeler
constexpr float kLeastAnswer = 1e-6F;

}  // namespace

std::size_t SweepLabels::answered() const {
  const auto without = std::count(answer_of_return.begin(), answer_of_return.end(), kNoAnswer);
  return answer_of_return.size() - static_cast<std::size_t>(without);
}

struct SweepLabeler::Cloud {
  GrowingCloud cubes;
  std::optional<Eigen::Vector3f> cleared;  ///< place of the last removal
};

SweepLabeler::SweepLabeler(std::shared_ptr<const LabelModel> model, int superpixel)
    : model_(model->of_other_devices ? model->of_other_devices : std::move(model)),
      superpixel_(superpixel),
      frequencies_(*model_),
      cloud_(std::make_unique<Cloud>()) {}
SweepLabeler::~SweepLabeler() = default;
SweepLabeler::SweepLabeler(SweepLabeler&&) noexcept = default;
SweepLabeler& SweepLabeler::operator=(SweepLabeler&&) noexcept = default;

double SweepLabeler::reach() { return static_cast<double>(kSweepReach); }
std::size_t SweepLabeler::cloudSize() const { return cloud_->cubes.size(); }

SweepLabels SweepLabeler::label(const std::vector<urban_nav_core::LaserPoint>& returns, const Eigen::Vector3f& place) {
  if (!cloud_->cleared) cloud_->cleared = place;
  if ((place - *cloud_->cleared).head<2>().norm() > kForgetStep) {
    cloud_->cubes.keepAround(place, kKeptReach);
    cloud_->cleared = place;
  }
  SweepLabels labels;
  labels.answer_of_return.assign(returns.size(), SweepLabels::kNoAnswer);
  std::vector<Eigen::Vector3f> near;
  Scene scene;
  urban_nav_registration::CellTable table(returns.size() / 4 + 16);
  const Eigen::Vector3f origin = place.array().round();
  for (std::size_t i = 0; i < returns.size(); ++i) {
    const Eigen::Vector3f& p = returns[i].p;
    if (!p.allFinite()) continue;
    const float distance = (p - place).head<2>().norm();
    if (distance < kKeptReach) near.push_back(p);
    if (!(distance < kSweepReach)) continue;
    const std::uint32_t answer =
        table.insert(urban_nav_registration::toKey(urban_nav_registration::toCell(p - origin, kAnswersPerM)));
    if (answer == scene.points.size()) scene.points.push_back(p);
    labels.answer_of_return[i] = answer;
  }
  cloud_->cubes.add(near);
  labels.answers = labelScene(*model_, scene, superpixel_, cloud_->cubes.measure(scene.points, model_->features));
  correctFrequencies(labels.answers);
  return labels;
}

void SweepLabeler::correctFrequencies(SceneLabels& answers) {
  if (isNewPlace(answers.share_unlike)) return;
  const std::size_t classes = answers.classes.size();
  std::vector<float> logs;
  logs.reserve(answers.probabilities.size());
  for (const float p : answers.probabilities) logs.push_back(std::log(std::max(p, kLeastAnswer)));
  for (std::size_t at = 0; at < logs.size(); at += classes) normaliseLogs(logs.data() + at, classes);
  frequencies_.correct(logs);
  for (std::size_t i = 0; i < answers.labels.size(); ++i) {
    if (answers.labels[i] == SceneClass::None) continue;
    float* row = answers.probabilities.data() + i * classes;
    for (std::size_t k = 0; k < classes; ++k) row[k] = std::exp(logs[i * classes + k]);
    const auto best = static_cast<std::size_t>(std::max_element(row, row + classes) - row);
    answers.labels[i] = answers.classes[best];
    if (row[best] < kSureAnswer) answers.unsure[i] = 1;
  }
}

}  // namespace scene_labeler
