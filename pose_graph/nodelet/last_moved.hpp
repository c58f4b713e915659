// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pose_graph {

/// At which revision of the graph each pose of a session last moved, so that who has one revision can be told what is
/// new: 8 bytes a pose.
class LastMoved {
 public:
  /// A number [first, last] of poses.
  using Range = std::pair<std::size_t, std::size_t>;

  /// There are `poses` now; those that are new will be part of the revision behind `revision`.
  void grow(std::size_t poses, std::int64_t revision) {
    if (poses > revisions_.size()) revisions_.resize(poses, revision + 1);
  }
  void moved(const Range& range, std::int64_t revision) {
    for (std::size_t i = range.first; i <= range.second && i < revisions_.size(); ++i) revisions_[i] = revision;
  }
  /// Neighbours among [from, to) that moved, or came, after `revision`.
  std::vector<Range> since(std::int64_t revision, std::size_t from, std::size_t to) const {
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
