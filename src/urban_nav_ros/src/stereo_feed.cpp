// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_ros/stereo_feed.hpp"

#include <algorithm>
#include <utility>

#include "archive_image.hpp"
#include "archive_message.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_ros {

using urban_nav_core::ImageView;
using urban_nav_core::MotionInput;
using urban_nav_core::OwnedImage;
using urban_nav_core::StampNs;

namespace {

/// Owner of the pixels of a view.
struct Pixels {
  sensor_msgs::ImageConstPtr message;  // mono8 is not copied
  cv::Mat grey;
  std::vector<std::uint8_t> rectified;
};

int motionStreams(const urban_nav_core::MotionChoice& motion) {
  return (motion.gyroscope ? 1 : 0) + (motion.wheels ? 1 : 0);
}

std::string toSize(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

}  // namespace

StereoFeed::StereoFeed(const Options& options, std::shared_ptr<const StereoCalibration> calibration)
    : calibration_(std::move(calibration)),
      motion_(options.motion),
      first_image_stream_(motionStreams(options.motion)),
      queue_(first_image_stream_ + 2, options.max_lateness, options.delivery,
             options.motion.is_required ? 0 : first_image_stream_, first_image_stream_, options.longest_wait),
      assembler_(options.pairing_tolerance),
      pairing_tolerance_(options.pairing_tolerance) {}

int StereoFeed::toStream(Side side) const { return first_image_stream_ + (side == Side::Left ? 0 : 1); }

void StereoFeed::add(Side side, const sensor_msgs::ImageConstPtr& image) {
  queue_.put(toStream(side), toStampNs(image->header.stamp), image);
}

void StereoFeed::add(Side side, const sensor_msgs::CompressedImageConstPtr& image) {
  queue_.put(toStream(side), toStampNs(image->header.stamp), image);
}

int StereoFeed::toStream(urban_nav_core::MotionSource source) const {
  return source == urban_nav_core::MotionSource::Wheels && motion_.gyroscope && motion_.wheels ? 1 : 0;
}

void StereoFeed::add(const MotionInput& input) {
  if (motion_.any()) queue_.put(toStream(input.source), input.to, input);
}

void StereoFeed::finish() {
  queue_.finish();
  finished_ = true;
}

void StereoFeed::widen(const Input& input) {
  const auto* raw = std::get_if<sensor_msgs::ImageConstPtr>(&input);
  const auto* packed = std::get_if<sensor_msgs::CompressedImageConstPtr>(&input);
  if (raw != nullptr) range_.add(**raw);
  if (packed != nullptr) range_.add(**packed);
}

/// Adds the partner of an image to the range of 16-bit pixels before decoding, since the range is common to both
/// cameras.
void StereoFeed::widenByPair(StampNs stamp, const Input& input) {
  if (range_.isSettled()) return;
  widen(input);
  queue_.forEachUntil(stamp + pairing_tolerance_, [this](const Input& waiting) { widen(waiting); });
}

OwnedImage StereoFeed::decode(Side side, StampNs stamp, const Input& input) {
  widenByPair(stamp, input);
  auto pixels = std::make_shared<Pixels>();
  GreyImage image;
  if (const auto* raw = std::get_if<sensor_msgs::ImageConstPtr>(&input)) {
    pixels->message = *raw;
    image = toDeepGrey(**raw);
  } else {
    image = toDeepGrey(*std::get<sensor_msgs::CompressedImageConstPtr>(input));
  }
  if (!image.pixels.empty() && image.pixels.depth() == CV_16U) {
    if (range_.isSettled()) range_.add(image.pixels);
    image.pixels = toEightBits(image.pixels, range_.scale());
  }
  const char* name = side == Side::Left ? "left image: " : "right image: ";
  if (!image.fault.empty()) {
    faults_.push_back(name + image.fault);
    return {stamp, {}, nullptr};
  }
  pixels->grey = image.pixels;
  const ImageView view = calibration_->rectify(side, toView(pixels->grey), pixels->rectified);
  if (view.empty()) {
    faults_.push_back(name + toSize(image.pixels.cols, image.pixels.rows) + ", which is not the size in camera_info");
    return {stamp, {}, nullptr};
  }
  if (view.data != pixels->grey.data) {
    ++rectified_;
    pixels->grey.release();
    pixels->message.reset();
  }
  return {stamp, view, pixels};
}

std::optional<DecodedPair> StereoFeed::take() {
  for (;;) {
    if (auto ready = assembler_.take()) return DecodedPair{std::move(*ready), std::exchange(faults_, {})};
    auto entry = queue_.take();
    if (!entry) {
      if (!finished_ || drained_) return std::nullopt;
      drained_ = true;
      assembler_.finish();
      continue;
    }
    if (const auto* motion = std::get_if<MotionInput>(&entry->item)) {
      assembler_.addMotion(*motion);
    } else if (entry->stream == toStream(Side::Left)) {
      assembler_.addLeft(decode(Side::Left, entry->stamp, entry->item));
    } else {
      assembler_.addRight(decode(Side::Right, entry->stamp, entry->item));
    }
  }
}

const urban_nav_core::TimeOrderedQueueCounts& StereoFeed::counts(Side side) const {
  return queue_.counts(toStream(side));
}

urban_nav_core::TimeOrderedQueueCounts StereoFeed::counts(urban_nav_core::MotionSource source) const {
  const bool is_selected = source == urban_nav_core::MotionSource::Wheels ? motion_.wheels : motion_.gyroscope;
  return is_selected ? queue_.counts(toStream(source)) : urban_nav_core::TimeOrderedQueueCounts();
}

std::int64_t StereoFeed::missing(Side side) const {
  return side == Side::Left ? assembler_.leftsMissing() : assembler_.rightsMissing();
}

std::optional<StampNs> StereoFeed::reached(Side side) const { return queue_.reached(toStream(side)); }

void StereoFeed::archive(urban_nav_core::Archive& archive) {
  queue_.archive(archive, [](urban_nav_core::Archive& items, Input& input) {
    std::size_t kind = input.index();
    items(kind);
    items.require(kind < std::variant_size_v<Input>, "a kind of message is unknown");
    if (items.isReading() && kind == 1) input = sensor_msgs::CompressedImageConstPtr();
    if (items.isReading() && kind == 2) input = MotionInput();
    if (auto* raw = std::get_if<sensor_msgs::ImageConstPtr>(&input)) archiveImage(items, *raw);
    if (auto* packed = std::get_if<sensor_msgs::CompressedImageConstPtr>(&input)) archiveMessage(items, *packed);
    if (auto* motion = std::get_if<MotionInput>(&input)) items(*motion);
  });
  archive(assembler_, faults_, finished_, drained_);
  range_.archive(archive);
}

}  // namespace urban_nav_ros
