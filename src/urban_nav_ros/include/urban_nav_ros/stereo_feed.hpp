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

/// Rectified grey pair with its motion inputs, and the faults of its images. An image that is missing or cannot be
/// decoded is an empty view and is named in `faults`.
struct DecodedPair {
  urban_nav_core::StereoPairWithMotion assembled;
  std::vector<std::string> faults;
};

/// Converts messages to stereo pairs: converters, TimeOrderedQueue, pairing and rectification, common to nodelets and
/// the bag reader, so that both deliver identical data. For one session and one calibration: create a new object for
/// the next. Not thread-safe.
class StereoFeed {
 public:
  struct Options {
    urban_nav_core::StampNs max_lateness = 50'000'000;
    urban_nav_core::StampNs longest_wait = 0;  ///< for a stream with early stamps (TimeOrderedQueue)
    urban_nav_core::DeliveryOrder delivery = urban_nav_core::DeliveryOrder::Shuffled;
    urban_nav_core::StampNs pairing_tolerance = 5'000'000;
    /// Expected motion inputs: in live order the feed waits for them as for an image, unless they are optional and
    /// silent. If no sensor is selected, the first one received is used.
    urban_nav_core::MotionChoice motion;
  };
  StereoFeed(const Options& options, std::shared_ptr<const StereoCalibration> calibration);

  void add(Side side, const sensor_msgs::ImageConstPtr& image);
  void add(Side side, const sensor_msgs::CompressedImageConstPtr& image);
  void add(const urban_nav_core::MotionInput& input);
  /// Sets the range of 16-bit pixels if it is known in advance.
  void expectRange(const GreyRange& range) { range_ = range; }
  /// Ends the input: take() then returns all remaining pairs.
  void finish();

  /// Returns the next pair that is complete, or known to remain incomplete. Images are decoded and rectified here, not
  /// when they are added.
  std::optional<DecodedPair> take();

  /// Reads or writes the state between two messages, when take() returns nothing more: pending messages and counters.
  void archive(urban_nav_core::Archive& archive);

  /// Returns the number of images of a side, and of those dropped as late or duplicate.
  const urban_nav_core::TimeOrderedQueueCounts& counts(Side side) const;
  /// Returns the number of motion inputs, and of those dropped as late or duplicate; zero for a sensor not selected.
  urban_nav_core::TimeOrderedQueueCounts counts(urban_nav_core::MotionSource source) const;
  /// Returns the number of pairs without an image of this side.
  std::int64_t missing(Side side) const;
  /// Returns the number of images rectified by this object.
  std::int64_t rectified() const { return rectified_; }
  /// Returns the latest stamp of a side so far.
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
  GreyRange range_;  // 16-bit pixels of both cameras
  std::vector<std::string> faults_;
  bool finished_ = false, drained_ = false;
  std::int64_t rectified_ = 0;  // images; not part of the archived state
};

}  // namespace urban_nav_ros
