// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "urban_nav_core/io/archive.hpp"

namespace swf_vo {

/// By how many pixels (of level 0) the right image shows everything lower than the left one. Rectification means none;
/// real ones leave some tenths, and a knock to a camera more. Each match says it anew, so it is known to a hundredth
/// after the first frame, and need not be a state of the filter: rows are measured in the left image's, and what the
/// right one says is brought there first.
class RowOffset {
 public:
  /// `capacity`: of differences in a frame, for which memory is taken at once.
  explicit RowOffset(int capacity) { differences_.reserve(static_cast<std::size_t>(capacity)); }

  /// A row in the right image minus that in the left one, of one landmark.
  void see(double difference_px) {
    if (differences_.size() < differences_.capacity()) differences_.push_back(difference_px);
  }
  /// At the end of a frame.
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
