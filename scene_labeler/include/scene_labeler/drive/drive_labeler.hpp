// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <vector>

#include "scene_labeler/drive/drive_window.hpp"
#include "scene_labeler/labelling/class_frequencies.hpp"
#include "scene_labeler/labelling/labeler.hpp"
#include "scene_labeler/labelling/mounting_check.hpp"
#include "scene_labeler/parameters.hpp"

namespace scene_labeler {

/// Labels the returns of a drive, each from all frames that show it: the mean of their log probabilities, since views
/// of one surface err together. Class images of another source count as further views, right in the share
/// `class_accuracy`; corrected to the frequencies of classes where the robot is. Returns that no frame shows are
/// labelled by shape, with the nearest frame. Not thread-safe; the result does not depend on the number of threads.
class DriveLabeler : public DriveObserver {
 public:
  /// Takes the returns that have a label, in their order; `labels`: one row per return.
  using TakeLabels = std::function<void(const std::vector<DriveReturn>& returns, const SceneLabels& labels)>;
  /// Takes a frame and the classes of its superpixels (SceneLabels::image), which are empty without an image.
  using TakeImage = std::function<void(const DriveFrame& frame, const cv::Mat& classes)>;
  /// Takes the scene of a frame, with is_asked set where it gave labels.
  using TakeScene = std::function<void(DriveScene drive)>;
  /// The model must outlive the labeler.
  DriveLabeler(const LabelModel& model, const Parameters& parameters, TakeLabels take, TakeImage take_image = {},
               TakeScene take_scene = {})
      : model_(model),
        parameters_(parameters),
        take_(std::move(take)),
        take_image_(std::move(take_image)),
        take_scene_(std::move(take_scene)),
        mounting_(model),
        frequencies_(model) {}

  void observe(const DriveFrame& frame, const Stretch& nearest, std::size_t first,
               const std::vector<DriveReturn>& returns) override;
  void settle(std::size_t end) override;

  /// Returns the number of frames so far with and without an image, and of those with one.
  std::size_t frames() const { return frames_; }
  std::size_t imagedFrames() const { return imaged_frames_; }
  /// Returns how many images were black or saturated, as of a covered camera: they count as none.
  std::size_t blindFrames() const { return blind_frames_; }
  /// Returns how many images were those of a camera that seems to be mounted upside down: they count as none.
  std::size_t upsideDownFrames() const { return upside_down_frames_; }
  /// Returns the number of frames in a kind of place that the model was not trained in (isNewPlace).
  std::size_t newPlaceFrames() const { return new_place_frames_; }
  /// Returns the number of frames with a class image of another source (SideView::classes).
  std::size_t classFrames() const { return class_frames_; }

 private:
  /// What the frames so far say of one return.
  struct Votes {
    std::uint16_t views = 0, unsure = 0, in_new_place = 0;
    bool by_shape = false;  // the only view has no image of it
    std::uint32_t patch = 0;
  };
  /// Adds what a class image of another source says, as one more view of the returns that the frame shows.
  void addClasses(const DriveFrame& frame, const DriveScene& drive, std::size_t first);

  const LabelModel& model_;
  const Parameters parameters_;
  const TakeLabels take_;
  const TakeImage take_image_;
  const TakeScene take_scene_;
  MountingCheck mounting_;
  ClassFrequencies frequencies_;
  std::size_t first_ = 0;  // index of returns_[0]
  std::vector<DriveReturn> returns_;
  std::vector<Votes> votes_;
  std::vector<float> logs_;  // of each return one for each class, summed over views
  std::uint32_t patches_ = 0;
  std::size_t frames_ = 0, imaged_frames_ = 0, blind_frames_ = 0, upside_down_frames_ = 0, class_frames_ = 0;
  std::size_t new_place_frames_ = 0;
};

/// Returns which points of a scene get a label from a frame: those that its image shows, and those of the stretch that
/// it is nearest to.
std::vector<std::uint8_t> labelledPoints(const DriveScene& drive, const std::vector<DriveReturn>& returns,
                                         const DriveObserver::Stretch& nearest);

}  // namespace scene_labeler
