// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "scene_labeler/drive/drive_scene.hpp"
#include "scene_labeler/parameters.hpp"
#include "scene_labeler/training/teaching.hpp"

namespace scene_labeler {

/// Retrains a model with the classes that a user assigns to superpixels of recent frames, from the samples of the model
/// and all corrections so far, in a background thread. Used by one thread, which never blocks on the training.
class LiveTeaching {
 public:
  LiveTeaching(const Parameters& parameters, std::shared_ptr<const LabelModel> base);
  /// Aborts a running training.
  ~LiveTeaching();
  LiveTeaching(const LiveTeaching&) = delete;
  LiveTeaching& operator=(const LiveTeaching&) = delete;

  /// Stores the scene of a frame; the last 24 can be corrected.
  void keep(DriveScene drive);
  /// Corrects the superpixels at a position, m, in each frame in which it is visible, and begins to train, after a
  /// training that is running. Returns a description of the correction. Throws UserError if the model has no samples,
  /// and if no frame has a return within 0.3 m.
  std::string correct(const Eigen::Vector3f& place, SceneClass label);
  /// Returns the retrained model once it is ready. Throws DataError if the training failed.
  std::optional<LabelModel> takeTaught();

  bool isTraining() const { return is_training_; }
  /// Returns the progress of the training, 0...1.
  double progress() const { return progress_; }
  std::size_t corrections() const { return corrections_.size(); }
  /// Drops the scenes, but not the corrections: a new drive has another origin.
  void forgetScenes() { scenes_.clear(); }

 private:
  /// Correction in one frame.
  struct ShownCorrection {
    std::shared_ptr<const DriveScene> drive;
    PatchCorrection patch;
  };
  struct Stopped {};
  void begin();
  void train(const std::vector<ShownCorrection>& shown);

  const Parameters parameters_;
  const std::shared_ptr<const LabelModel> base_;
  std::deque<std::shared_ptr<const DriveScene>> scenes_;
  std::vector<std::vector<ShownCorrection>> corrections_;
  bool is_training_ = false, is_outdated_ = false;  // by corrections made since the training began
  std::thread thread_;
  std::atomic<double> progress_{0.0};
  std::atomic<bool> is_stopped_{false}, is_done_{false};
  std::mutex mutex_;  // guards all members below
  std::optional<LabelModel> taught_;
  std::string fault_;
};

}  // namespace scene_labeler
