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

/// Labels the returns of a drive, each from all frames in which it is visible: the mean of their log probabilities,
/// because errors of views of one surface are correlated. Class images of another source are further views, correct
/// with probability `class_accuracy`; frequencies of classes are adapted to the robot's surroundings. Returns that are
/// visible in no frame are labelled by shape, with the nearest frame. Not thread-safe; the result does not depend on
/// the number of threads.
class DriveLabeler : public DriveObserver {
 public:
  /// Receives the labelled returns, in order; `labels`: one row per return.
  using TakeLabels = std::function<void(const std::vector<DriveReturn>& returns, const SceneLabels& labels)>;
  /// Receives a frame and the classes of its superpixels (SceneLabels::image), which are empty without an image.
  using TakeImage = std::function<void(const DriveFrame& frame, const cv::Mat& classes)>;
  /// Receives the scene of a frame, with is_asked set for the returns that it labelled.
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

  /// Return the number of frames so far, and of those with an image.
  std::size_t frames() const { return frames_; }
  std::size_t imagedFrames() const { return imaged_frames_; }
  /// Returns the number of images that were black or saturated, as from a covered camera, and were not used.
  std::size_t blindFrames() const { return blind_frames_; }
  /// Returns the number of images of a camera that appears to be mounted upside down, which were not used.
  std::size_t upsideDownFrames() const { return upside_down_frames_; }
  /// Returns the number of frames in places of a kind that is not in the training data (isNewPlace).
  std::size_t newPlaceFrames() const { return new_place_frames_; }
  /// Returns the number of frames with a class image of another source (SideView::classes).
  std::size_t classFrames() const { return class_frames_; }

 private:
  /// Accumulated evidence of the frames on one return.
  struct Votes {
    std::uint16_t views = 0, unsure = 0, in_new_place = 0;
    bool by_shape = false;  // the only view has no image of it
    std::uint32_t patch = 0;
  };
  /// Adds a class image of another source, as a further view of the returns visible in the frame.
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
  std::vector<float> logs_;  // per return and class, summed over views
  std::uint32_t patches_ = 0;
  std::size_t frames_ = 0, imaged_frames_ = 0, blind_frames_ = 0, upside_down_frames_ = 0, class_frames_ = 0;
  std::size_t new_place_frames_ = 0;
};

/// Returns which points of a scene are labelled by a frame: those visible in its image, and those of the interval to
/// which it is nearest.
std::vector<std::uint8_t> labelledPoints(const DriveScene& drive, const std::vector<DriveReturn>& returns,
                                         const DriveObserver::Stretch& nearest);

}  // namespace scene_labeler
