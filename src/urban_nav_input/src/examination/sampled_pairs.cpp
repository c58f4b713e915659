// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/examination/sampled_pairs.hpp"

#include <algorithm>

namespace urban_nav_input {

namespace {

constexpr std::int64_t kGuessedFrames = 500;  // if the length is unknown

}  // namespace

SampledPairs::SampledPairs(std::int64_t frames, std::int64_t samples, std::int64_t least_step)
    : step_(std::max({std::int64_t{1}, least_step, (frames > 0 ? frames : kGuessedFrames) / samples})),
      most_(2 * samples) {}

void SampledPairs::add(const urban_nav_core::StereoPairWithMotion& pair) {
  ++count_;
  last_.push_back(pair);
  if (last_.size() > 3) last_.pop_front();
  if (last_.size() == 3 && count_ % step_ == step_ / 2 && images_.pairs() < most_)
    images_.add(last_[1].pair.left, last_[1].pair.right, last_[0].pair.right, last_[2].pair.right);
}

}  // namespace urban_nav_input
