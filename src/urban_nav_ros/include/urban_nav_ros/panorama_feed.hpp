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
  urban_nav_core::StampNs stamp = 0;  ///< of its earliest image, ns
  std::vector<RecordedImage> images;  ///< one per camera; an empty one is missing
};

/// Groups the images of a panoramic head by stamp, for nodelets and the bag reader alike, so that both hand a stage the
/// same panoramas in the same order. All images have one scale of 16-bit pixels; others are not decoded. Not
/// thread-safe.
///
/// A panorama is returned as soon as each camera has an image of its time, or it is known that the others are missing:
/// when images more than max_lateness younger have arrived.
class PanoramaFeed {
 public:
  struct Options {
    std::size_t cameras = 5;                             ///< at least 1
    urban_nav_core::StampNs tolerance = 20'000'000;      ///< between stamps of one panorama, ns
    urban_nav_core::StampNs max_lateness = 200'000'000;  ///< by stamps, ns
    urban_nav_core::DeliveryOrder delivery = urban_nav_core::DeliveryOrder::Shuffled;
  };
  explicit PanoramaFeed(const Options& options);

  /// Adds an image of a camera, 0 ... cameras - 1.
  void add(std::size_t camera, RecordedImage image);
  /// Ends the input: take() then returns all that is held.
  void finish();
  /// States the range of 16-bit pixels; otherwise it is that of the first images that arrive, of all cameras.
  void expectRange(const GreyRange& range) { range_ = range; }
  /// Returns the next panorama, in order of stamps; nullopt while its images may still arrive.
  std::optional<Panorama> take();

  /// Reads or writes the state between two images.
  void archive(urban_nav_core::Archive& archive);

  /// Images of a camera that arrived, and those dropped because they were late or duplicates.
  const urban_nav_core::TimeOrderedQueueCounts& counts(std::size_t camera) const;
  /// Panoramas that left without an image of this camera.
  std::int64_t missing(std::size_t camera) const { return missing_[camera]; }
  std::int64_t panoramas() const { return panoramas_; }

 private:
  bool isComplete() const;
  Panorama release();

  const Options options_;
  urban_nav_core::TimeOrderedQueue<RecordedImage> queue_;
  std::vector<RecordedImage> group_;  // images of the panorama that is being completed, per camera
  std::optional<urban_nav_core::StampNs> group_stamp_;
  GreyRange range_;  // 16-bit pixels of all cameras
  std::vector<std::int64_t> missing_;
  std::int64_t panoramas_ = 0;
  bool finished_ = false;
};

}  // namespace urban_nav_ros
