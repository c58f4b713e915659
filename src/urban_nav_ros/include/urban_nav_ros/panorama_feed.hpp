// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "urban_nav_core/sequence/time_ordered_queue.hpp"
#include "urban_nav_ros/recorded_image.hpp"

namespace urban_nav_ros {

/// Images of all cameras of a panoramic head at one time.
struct Panorama {
  urban_nav_core::StampNs stamp = 0;  ///< earliest stamp of its images, ns
  std::vector<RecordedImage> images;  ///< one per camera; a missing one is empty
};

/// Groups the images of a panoramic head by stamp, in nodelets and in the bag reader, so that both deliver the same
/// panoramas in the same order. All images share one scale of 16-bit pixels; other images are not decoded. Not
/// thread-safe.
///
/// A panorama is returned as soon as each camera has an image of its time, or the missing ones are known: when images
/// more than max_lateness later have arrived.
class PanoramaFeed {
 public:
  struct Options {
    std::size_t cameras = 5;                             ///< at least 1
    urban_nav_core::StampNs tolerance = 20'000'000;      ///< between stamps within a panorama, ns
    urban_nav_core::StampNs max_lateness = 200'000'000;  ///< by stamps, ns
    urban_nav_core::DeliveryOrder delivery = urban_nav_core::DeliveryOrder::Shuffled;
  };
  explicit PanoramaFeed(const Options& options);

  /// Adds an image of a camera, 0 ... cameras - 1.
  void add(std::size_t camera, RecordedImage image);
  /// Ends the input: take() then returns all remaining images.
  void finish();
  /// Sets the range of 16-bit pixels; otherwise it is determined from the first images of all cameras.
  void expectRange(const GreyRange& range) { range_ = range; }
  /// Returns the next panorama, in order of stamps; nullopt while its images may still arrive.
  std::optional<Panorama> take();

  /// Reads or writes the state between two images.
  void archive(urban_nav_core::Archive& archive);

  /// Returns the number of images of a camera, and of those dropped as late or duplicate.
  const urban_nav_core::TimeOrderedQueueCounts& counts(std::size_t camera) const;
  /// Returns the number of panoramas without an image of this camera.
  std::int64_t missing(std::size_t camera) const { return missing_[camera]; }
  std::int64_t panoramas() const { return panoramas_; }

 private:
  bool isComplete() const;
  Panorama release();

  const Options options_;
  urban_nav_core::TimeOrderedQueue<RecordedImage> queue_;
  std::vector<RecordedImage> group_;  // images of the panorama being assembled, per camera
  std::optional<urban_nav_core::StampNs> group_stamp_;
  GreyRange range_;  // 16-bit pixels of all cameras
  std::vector<std::int64_t> missing_;
  std::int64_t panoramas_ = 0;
  bool finished_ = false;
};

}  // namespace urban_nav_ros
