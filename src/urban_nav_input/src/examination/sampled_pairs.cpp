// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/sampled_pairs.hpp"

#include <algorithm>
#include <utility>

namespace urban_nav_input {

namespace {

constexpr std::int64_t kGuessedFrames = 500;  // if the length is unknown

}  // namespace

SampledPairs::SampledPairs(SourceInfo info, std::int64_t samples, std::int64_t least_step)
    : info_(std::move(info)),
      step_(std::max({std::int64_t{1}, least_step, (info_.frames > 0 ? info_.frames : kGuessedFrames) / samples})),
      most_(2 * samples),
      sight_(info_.camera, info_.T_base_camera) {}

void SampledPairs::add(const urban_nav_core::StereoPairWithMotion& pair) {
  constexpr std::size_t kIntervals = 200;
  ++count_;
  if (!last_.empty()) {
    repeated_.add(last_.back().pair, pair.pair);
    if (intervals_.size() < kIntervals) intervals_.push_back(pair.pair.stamp - last_.back().pair.stamp);
  }
  last_.push_back(pair);
  if (last_.size() > 3) last_.pop_front();
  if (last_.size() < 3 || count_ % step_ != step_ / 2 || images_.pairs() >= most_) return;
  images_.add(last_[1].pair.left, last_[1].pair.right, last_[0].pair.right, last_[2].pair.right);
  sight_.add(last_[0].pair, last_[2].pair);
}

std::vector<Finding> SampledPairs::findings() const {
  std::vector<urban_nav_core::StampNs> intervals = intervals_;
  std::sort(intervals.begin(), intervals.end());
  std::vector<Finding> findings = repeated_.findings();
  for (Finding& finding : images_.findings(info_, intervals.empty() ? 0 : intervals[intervals.size() / 2]))
    findings.push_back(std::move(finding));
  return findings;
}

}  // namespace urban_nav_input
