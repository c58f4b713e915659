// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pose_graph {

/// Revision of the graph at which each pose of a session last moved, for subscribers with an older revision. 8 bytes
/// per pose.
class PoseRevisions {
 public:
  /// Inclusive index range [first, last] of poses.
  using Range = std::pair<std::size_t, std::size_t>;

  /// Extends to `poses` poses. New ones get the revision after `revision`.
  void grow(std::size_t poses, std::int64_t revision) {
    if (poses > revisions_.size()) revisions_.resize(poses, revision + 1);
  }
  /// Records that a range moved at `revision`.
  void setMoved(const Range& range, std::int64_t revision) {
    for (std::size_t i = range.first; i <= range.second && i < revisions_.size(); ++i) revisions_[i] = revision;
  }
  /// Returns the ranges within [from, to) that moved or were added after `revision`.
  std::vector<Range> movedSince(std::int64_t revision, std::size_t from, std::size_t to) const {
    std::vector<Range> ranges;
    for (std::size_t i = from; i < to && i < revisions_.size(); ++i) {
      if (revisions_[i] <= revision) continue;
      if (!ranges.empty() && ranges.back().second + 1 == i) ranges.back().second = i;
      else ranges.push_back({i, i});
    }
    return ranges;
  }

 private:
  std::vector<std::int64_t> revisions_;
};

}  // namespace pose_graph
