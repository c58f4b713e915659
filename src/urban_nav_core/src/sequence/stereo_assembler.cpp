// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/sequence/stereo_assembler.hpp"

#include <cstdlib>
#include <utility>

namespace urban_nav_core {

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

std::optional<AssembledPair> StereoAssembler::take() {
  if (ready_.empty()) return std::nullopt;
  AssembledPair pair = std::move(ready_.front());
  ready_.pop_front();
  return pair;
}

void StereoAssembler::release() {
  AssembledPair made;
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

}  // namespace urban_nav_core
