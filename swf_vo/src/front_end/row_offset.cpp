// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/row_offset.hpp"

#include <algorithm>

namespace swf_vo {

namespace {

constexpr std::size_t kEnoughMatches = 20;  // differences required for a median
constexpr int kOffsetMemory = 100;          // frames; mounts of cameras drift slowly

}  // namespace

void RowOffset::learn() {
  if (differences_.size() >= kEnoughMatches) {
    const auto middle = differences_.begin() + static_cast<std::ptrdiff_t>(differences_.size() / 2);
    std::nth_element(differences_.begin(), middle, differences_.end());
    frames_ = std::min(frames_ + 1, kOffsetMemory);
    px_ += (*middle - px_) / frames_;
  }
  differences_.clear();
}

void RowOffset::archive(urban_nav_core::Archive& archive) {
  archive(px_, frames_);
  archive.require(frames_ >= 0 && frames_ <= kOffsetMemory, "invalid number of frames");
}

}  // namespace swf_vo
