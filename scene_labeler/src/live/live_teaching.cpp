// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_teaching.hpp"

#include <algorithm>
#include <limits>

#include "scene_labeler/training/train.hpp"
#include "urban_nav_core/parallel/named_thread.hpp"
#include "urban_nav_core/types/error.hpp"

namespace scene_labeler {
namespace {

constexpr std::size_t kMostScenes = 24;
constexpr float kFarthestReturn = 0.3F;  // m, from the clicked position

/// Returns the labelled point nearest to a position; nullopt beyond kFarthestReturn.
std::optional<std::size_t> nearestPoint(const DriveScene& drive, const Eigen::Vector3f& place) {
  const Eigen::Vector3f local = place - drive.origin;
  float nearest = kFarthestReturn * kFarthestReturn;
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < drive.scene.points.size(); ++i) {
    const float square = (drive.scene.points[i] - local).squaredNorm();
    if (!drive.scene.isAsked(i) || !(square < nearest)) continue;
    nearest = square;
    found = i;
  }
  return found;
}

}  // namespace

LiveTeaching::LiveTeaching(const Parameters& parameters, std::shared_ptr<const LabelModel> base)
    : parameters_(parameters), base_(std::move(base)) {}

LiveTeaching::~LiveTeaching() {
  is_stopped_ = true;
  if (thread_.joinable()) thread_.join();
}

void LiveTeaching::keep(DriveScene drive) {
  scenes_.push_back(std::make_shared<const DriveScene>(std::move(drive)));
  if (scenes_.size() > kMostScenes) scenes_.pop_front();
}

std::string LiveTeaching::correct(const Eigen::Vector3f& place, SceneClass label) {
  if (base_->samples.empty())
    throw urban_nav_core::UserError(parameters_.model, "has no training samples",
                                    "a model that labels train wrote with samples (version 3)");
  std::vector<ShownCorrection> shown;
  for (const std::shared_ptr<const DriveScene>& drive : scenes_)
    if (const auto point = nearestPoint(*drive, place)) shown.push_back({drive, {*point, label}});
  if (shown.empty())
    throw urban_nav_core::UserError(
        "",
        "none of the last " + std::to_string(scenes_.size()) + " frames has a return within 0.3 m of the clicked point",
        "a point of labels/cloud");
  const std::size_t frames = shown.size();
  corrections_.push_back(std::move(shown));
  if (is_training_) is_outdated_ = true;
  else begin();
  return std::string(toString(label)) + " in " + std::to_string(frames) + " frames; " +
         std::to_string(corrections_.size()) + " corrections, training" + (is_outdated_ ? " follows" : " begins");
}

void LiveTeaching::begin() {
  if (thread_.joinable()) thread_.join();
  std::vector<ShownCorrection> all;
  for (const std::vector<ShownCorrection>& shown : corrections_) all.insert(all.end(), shown.begin(), shown.end());
  is_training_ = true;
  is_outdated_ = is_done_ = false;
  progress_ = 0.0;
  thread_ = urban_nav_core::namedThread("teaching", [this, all] { train(all); });
}

void LiveTeaching::train(const std::vector<ShownCorrection>& shown) {
  std::optional<LabelModel> taught;
  std::string fault;
  try {
    TrainingFold fold;
    fold.name = "corrections";
    std::vector<std::shared_ptr<const DriveScene>> done;
    for (const ShownCorrection& first : shown) {
      if (std::find(done.begin(), done.end(), first.drive) != done.end()) continue;
      done.push_back(first.drive);
      std::vector<PatchCorrection> patches;
      for (const ShownCorrection& one : shown)
        if (one.drive == first.drive) patches.push_back(one.patch);
      addPatchCorrections(*base_, first.drive->scene, patches, parameters_.superpixel, fold);
    }
    std::vector<TrainingFold> folds = restoreFolds(*base_);
    folds.push_back(std::move(fold));
    TrainingOptions options;
    options.kind = base_->kind;
    options.features = base_->features;
    options.samples_per_class = static_cast<std::size_t>(parameters_.samples);
    options.device = base_->device;
    options.base = base_.get();
    options.adds_trees = true;
    taught = trainModel(std::move(folds), options, [this](double share) {
               progress_ = share;
               if (is_stopped_) throw Stopped();
             }).model;
  } catch (const Stopped&) {
    return;
  } catch (const urban_nav_core::Error& error) {
    fault = error.what();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  taught_ = std::move(taught);
  fault_ = fault;
  is_done_ = true;
}

std::optional<LabelModel> LiveTeaching::takeTaught() {
  if (!is_training_ || !is_done_) return std::nullopt;
  thread_.join();
  is_training_ = false;
  std::optional<LabelModel> taught;
  std::string fault;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    taught.swap(taught_);
    fault.swap(fault_);
  }
  if (is_outdated_) begin();
  if (!taught) throw urban_nav_core::DataError("", fault, "corrections that a model can be trained with");
  return taught;
}

}  // namespace scene_labeler
