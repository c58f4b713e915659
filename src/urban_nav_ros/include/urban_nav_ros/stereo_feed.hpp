// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "urban_nav_core/sequence/stereo_assembler.hpp"
#include "urban_nav_core/sequence/time_ordered_queue.hpp"
#include "urban_nav_ros/grey_range.hpp"
#include "urban_nav_ros/motion.hpp"
#include "urban_nav_ros/stereo_calibration.hpp"

namespace urban_nav_ros {

/// A rectified grey pair with its motion inputs, and the faults of its images. An image that is missing or cannot be
/// decoded is an empty view, and a sentence in `faults` names it.
struct DecodedPair {
  urban_nav_core::StereoPairWithMotion assembled;
  std::vector<std::string> faults;
};

/// Messages in, stereo pairs out: converters, TimeOrderedQueue, pairing and rectification in the one way that nodelet
/// and bag reader share, so that both hand a stage the same bytes. One session and one calibration: begin the next with
/// a new object. Not thread-safe.
class StereoFeed {
 public:
  struct Options {
    urban_nav_core::StampNs max_lateness = 50'000'000;
    urban_nav_core::DeliveryOrder delivery = urban_nav_core::DeliveryOrder::Shuffled;
    urban_nav_core::StampNs pairing_tolerance = 5'000'000;
    /// Motion inputs that may come: in live order the feed waits for them as for an image, unless they are optional and
    /// silent. Inputs of no sensor come with the first of them.
    urban_nav_core::MotionChoice motion;
  };
  StereoFeed(const Options& options, std::shared_ptr<const StereoCalibration> calibration);

  void add(Side side, const sensor_msgs::ImageConstPtr& image);
  void add(Side side, const sensor_msgs::CompressedImageConstPtr& image);
  void add(const urban_nav_core::MotionInput& input);
  /// States the range of 16-bit pixels as far as it is known in advance.
  void expectRange(const GreyRange& range) { range_ = range; }
  /// Nothing more will come: all that waits may leave.
  void finish();

  /// The next pair that is complete, or known to stay incomplete. Images are decoded and rectified here, not when they
  /// are added.
  std::optional<DecodedPair> take();

  /// Where it stands between two messages, as take() has nothing more: what waits, as it came, and what has been
  /// counted.
  void archive(urban_nav_core::Archive& archive);

  /// What came on a side, too late or twice.
  const urban_nav_core::TimeOrderedQueueCounts& counts(Side side) const;
  /// Pairs that left without an image of this side.
  std::int64_t missing(Side side) const;
  /// Number of images rectified by this object.
  std::int64_t rectified() const { return rectified_; }
  /// The latest stamp of a side so far.
  std::optional<urban_nav_core::StampNs> reached(Side side) const;

 private:
  using Input =
      std::variant<sensor_msgs::ImageConstPtr, sensor_msgs::CompressedImageConstPtr, urban_nav_core::MotionInput>;
  int toStream(Side side) const;
  int toStream(urban_nav_core::MotionSource source) const;
  void widen(const Input& input);
  void widenByPair(urban_nav_core::StampNs stamp, const Input& input);
  urban_nav_core::OwnedImage decode(Side side, urban_nav_core::StampNs stamp, const Input& input);

  std::shared_ptr<const StereoCalibration> calibration_;
  urban_nav_core::MotionChoice motion_;
  int first_image_stream_;
  urban_nav_core::TimeOrderedQueue<Input> queue_;
  urban_nav_core::StereoAssembler assembler_;
  urban_nav_core::StampNs pairing_tolerance_;
  GreyRange range_;  // for the 16-bit pixels of both cameras
  std::vector<std::string> faults_;
  bool finished_ = false, drained_ = false;
  std::int64_t rectified_ = 0;  // images; no part of the archived state
};

}  // namespace urban_nav_ros
