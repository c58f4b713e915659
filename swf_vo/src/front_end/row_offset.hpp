// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// Vertical offset of the right image relative to the left one, px of level 0: rectification errors of some tenths,
/// more after a shock to a camera. Every match measures it, so that it is accurate to a hundredth after the first frame
/// and does not need a state in the filter: rows refer to the left image, and those of the right one are corrected
/// first.
class RowOffset {
 public:
  /// `capacity`: differences of a frame, for which memory is allocated at construction.
  explicit RowOffset(int capacity) { differences_.reserve(static_cast<std::size_t>(capacity)); }

  /// Adds the row in the right image minus that in the left one, of one landmark.
  void see(double difference_px) {
    if (differences_.size() < differences_.capacity()) differences_.push_back(difference_px);
  }
  /// Updates the estimate at the end of a frame.
  void learn();

  double px() const { return px_; }
  bool isKnown() const { return frames_ > 0; }
  void archive(urban_nav_core::Archive& archive);

 private:
  std::vector<double> differences_;
  double px_ = 0.0;
  int frames_ = 0;
};

}  // namespace swf_vo
