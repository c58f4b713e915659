// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "live/keyframe_images.hpp"
#include "urban_nav_live/round_gate.hpp"

namespace fabmap_node {

/// Source of the images of a live session's places.
enum class ImageSource { Unknown, Head, Left };

/// Images of the places of live sessions: panoramas, each image of one camera, or those of the left camera at keyframes
/// if no panoramic head sends any. `Feed` assembles images of the cameras of a head (urban_nav_ros::PanoramaFeed). Not
/// thread-safe.
template <typename Image, typename Feed>
class PlaceImages {
 public:
  using StampNs = urban_nav_core::StampNs;
  struct Options {
    std::size_t cameras = 5;  ///< of the head; images of camera number `cameras` are those of the left camera
    /// Uses the left camera if the head sends no image within the time that the images of the left camera span, ns.
    std::optional<StampNs> head_patience;
    std::function<std::unique_ptr<Feed>()> make_feed;
  };
  struct Listener {
    std::function<void(StampNs, const std::vector<Image>&)> place;
    std::function<void(ImageSource)> chosen;
  };

  PlaceImages(Options options, Listener listener) : options_(std::move(options)), listener_(std::move(listener)) {
    reset();
  }

  /// Adds an image of a camera. Images of the cameras have separate connections: their stamps jump back one after the
  /// other.
  void add(std::size_t camera, StampNs stamp, Image image) {
    images_->add(static_cast<int>(camera), stamp, {camera, stamp, std::move(image)});
  }
  void addPose(const urban_nav_core::StampedPose& T_odom_base) {
    if (left_) left_->addPose(T_odom_base);
    takeKeyframes(false);
  }
  /// Completes a pending panorama with the images received, and passes on the keyframes that wait for a head.
  void finish() {
    feed_->finish();
    takePanoramas();
    takeKeyframes(true);
  }
  /// Begins anew, from the same source.
  void reset() {
    if (options_.head_patience && source_ != ImageSource::Head)
      left_.emplace(urban_nav_registration::Parameters(), *options_.head_patience);
    feed_ = options_.make_feed();
    typename Images::Options sorting;
    for (std::size_t camera = 0; camera < options_.cameras; ++camera) sorting.leading.insert(static_cast<int>(camera));
    if (left_) sorting.leading.insert(static_cast<int>(options_.cameras));
    typename Images::Listener sorted;
    sorted.item = [this](CameraImage& image) { take(image); };
    sorted.next_round = [this] {
      finish();
      feed_ = options_.make_feed();
      if (left_) left_->restart();
    };
    images_ = std::make_unique<Images>(sorting, sorted);
  }
  ImageSource source() const { return source_; }

 private:
  struct CameraImage {
    std::size_t camera = 0;
    StampNs stamp = 0;
    Image image;
  };
  using Images = urban_nav_live::RoundGate<CameraImage>;

  void take(CameraImage& image) {
    if (image.camera == options_.cameras) {
      if (left_) left_->addImage(image.stamp, std::move(image.image));  // otherwise received before the head was found
      return takeKeyframes(false);
    }
    choose(ImageSource::Head);
    left_.reset();
    feed_->add(image.camera, std::move(image.image));
    takePanoramas();
  }
  void takePanoramas() {
    while (const auto panorama = feed_->take()) listener_.place(panorama->stamp, panorama->images);
  }
  void takeKeyframes(bool all) {
    if (!left_) return;
    if (left_->isPatienceOver()) choose(ImageSource::Left);
    while (const auto keyframe = left_->take(all)) listener_.place(keyframe->stamp, {keyframe->image});
  }
  void choose(ImageSource source) {
    if (source_ == source) return;
    source_ = source;
    listener_.chosen(source);
  }

  const Options options_;
  const Listener listener_;
  ImageSource source_ = ImageSource::Unknown;
  std::optional<KeyframeImages<Image>> left_;  // none once the head was found
  std::unique_ptr<Feed> feed_;
  std::unique_ptr<Images> images_;
};

}  // namespace fabmap_node
