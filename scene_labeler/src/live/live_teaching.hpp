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

/// Teaches a model the classes that a person gives to superpixels of the last frames. Trains on a thread of its own,
/// from the samples of the model and all corrections so far. Called by one thread, which never waits for the training.
class LiveTeaching {
 public:
  LiveTeaching(const Parameters& parameters, std::shared_ptr<const LabelModel> base);
  /// Stops a training.
  ~LiveTeaching();
  LiveTeaching(const LiveTeaching&) = delete;
  LiveTeaching& operator=(const LiveTeaching&) = delete;

  /// Keeps the scene of a frame, of which the last 24 can be corrected.
  void keep(DriveScene drive);
  /// Corrects the superpixels at a place, m, in each frame that shows it, and begins to train, unless a training runs:
  /// the next one then begins after it. Returns what was corrected. Throws UserError if the model holds no samples, and
  /// if no frame has a return within 0.3 m.
  std::string correct(const Eigen::Vector3f& place, SceneClass label);
  /// Returns the taught model once it is trained. Throws DataError if the training failed.
  std::optional<LabelModel> takeTaught();

  bool isTraining() const { return is_training_; }
  /// Returns the share of the training that is done.
  double progress() const { return progress_; }
  std::size_t corrections() const { return corrections_.size(); }
  /// Forgets the scenes, not the corrections: a new drive has its own origin.
  void forgetScenes() { scenes_.clear(); }

 private:
  /// A correction as one frame shows it.
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
  bool is_training_ = false, is_outdated_ = false;  // by corrections since the training began
  std::thread thread_;
  std::atomic<double> progress_{0.0};
  std::atomic<bool> is_stopped_{false}, is_done_{false};
  std::mutex mutex_;  // guards what follows
  std::optional<LabelModel> taught_;
  std::string fault_;
};

}  // namespace scene_labeler
