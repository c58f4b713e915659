// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/stereo_assembler.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <utility>

#include "urban_nav_core/io/archive_types.hpp"

namespace urban_nav_core {

namespace {

/// Reads or writes the pixels without gaps between rows; the image then owns them.
void archiveImage(Archive& archive, OwnedImage& image) {
  int width = image.view.width, height = image.view.height;
  auto pixels = std::make_shared<std::vector<std::uint8_t>>();
  for (int v = 0; v < height && !archive.isReading(); ++v)
    pixels->insert(pixels->end(), image.view.row(v), image.view.row(v) + width);
  archive(image.stamp, width, height, *pixels);
  archive.require(
      width >= 0 && height >= 0 && pixels->size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
      "an image has another size");
  if (!archive.isReading()) return;
  image.view = pixels->empty() ? ImageView{} : ImageView{pixels->data(), width, height, width};
  image.owner = pixels;
}

void archiveImage(Archive& archive, std::optional<OwnedImage>& image) {
  bool is_there = image.has_value();
  archive(is_there);
  if (archive.isReading()) image = is_there ? std::optional(OwnedImage()) : std::nullopt;
  if (is_there) archiveImage(archive, *image);
}

}  // namespace

StereoAssembler::StereoAssembler(StampNs tolerance) : tolerance_(tolerance) {}

void StereoAssembler::addLeft(OwnedImage image) {
  if (left_ || (right_ && std::abs(right_->stamp - image.stamp) > tolerance_)) release();
  left_ = std::move(image);
  if (right_) release();
}

void StereoAssembler::addRight(OwnedImage image) {
  if (right_ || (left_ && std::abs(left_->stamp - image.stamp) > tolerance_)) release();
  right_ = std::move(image);
  if (left_) release();
}

void StereoAssembler::addMotion(const MotionInput& input) { motion_.push_back(input); }

void StereoAssembler::finish() {
  if (left_ || right_) release();
}

std::optional<StereoPairWithMotion> StereoAssembler::take() {
  if (ready_.empty()) return std::nullopt;
  StereoPairWithMotion pair = std::move(ready_.front());
  ready_.pop_front();
  return pair;
}

void StereoAssembler::release() {
  StereoPairWithMotion made;
  made.pair.stamp = left_ ? left_->stamp : right_->stamp;
  if (left_) {
    made.pair.left = left_->view;
    made.left_owner = std::move(left_->owner);
  } else {
    ++lefts_missing_;
  }
  if (right_) {
    made.pair.right = right_->view;
    made.right_owner = std::move(right_->owner);
  } else {
    ++rights_missing_;
  }
  left_.reset();
  right_.reset();
  while (!motion_.empty() && motion_.front().to <= made.pair.stamp) {
    made.inputs.push_back(motion_.front());
    motion_.pop_front();
  }
  ready_.push_back(std::move(made));
}

void StereoAssembler::archive(Archive& archive) {
  assert(ready_.empty());
  archiveImage(archive, left_);
  archiveImage(archive, right_);
  std::vector<MotionInput> motion(motion_.begin(), motion_.end());
  archive(motion, lefts_missing_, rights_missing_);
  motion_.assign(motion.begin(), motion.end());
}

}  // namespace urban_nav_core
