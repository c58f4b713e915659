// SPDX-License-Identifier: BSD-3-Clause
#include "live/specific_force_buffer.hpp"

#include <algorithm>
#include <utility>

#include "urban_nav_live/time_jump.hpp"

namespace pose_graph {

using urban_nav_core::StampNs;

namespace {

constexpr StampNs kSecond = 1'000'000'000;
constexpr StampNs kFinal = 10 * kSecond, kKept = 600 * kSecond;

void append(const SpecificForce& sample, std::vector<SpecificForce>& samples) {
  samples.push_back(sample);
  // At twice the kept duration, half of the samples is erased at once.
  if (samples.front().stamp > sample.stamp - 2 * kKept) return;
  samples.erase(samples.begin(), std::find_if(samples.begin(), samples.end(), [&](const SpecificForce& each) {
                  return each.stamp > sample.stamp - kKept;
                }));
}

}  // namespace

void SpecificForceBuffer::add(const SpecificForce& sample) {
  const bool back = !samples_.empty() && sample.stamp < samples_.back().stamp - urban_nav_live::kMaxStepBack;
  append(sample, back || !next_session_.empty() ? next_session_ : samples_);
}

void SpecificForceBuffer::beginSession() {
  open_ = 0;
  if (!next_session_.empty()) samples_ = std::exchange(next_session_, {});
}

std::vector<SpecificForce> SpecificForceBuffer::meansAt(const std::vector<StampNs>& stamps) {
  if (samples_.empty() || stamps.empty()) return {};
  open_ = std::min(open_, stamps.size());
  const std::size_t before = open_ > 0 ? open_ - 1 : 0;  // the samples in between are divided among the neighbours
  const StampNs from = stamps[before] - kSecond;
  std::vector<SpecificForce> near;
  std::copy_if(samples_.begin(), samples_.end(), std::back_inserter(near),
               [&](const SpecificForce& sample) { return sample.stamp >= from; });
  std::vector<SpecificForce> made =
      forcesAt({stamps.begin() + static_cast<std::ptrdiff_t>(before), stamps.end()}, std::move(near));
  if (open_ > 0 && !made.empty() && made.front().stamp == stamps[before]) made.erase(made.begin());
  const auto first_open = std::upper_bound(stamps.begin() + static_cast<std::ptrdiff_t>(open_), stamps.end(),
                                           samples_.back().stamp - kFinal);
  open_ = static_cast<std::size_t>(first_open - stamps.begin());
  // The mean at the last pose depends on the stamp of the next one.
  if (open_ == stamps.size()) --open_;
  return made;
}

}  // namespace pose_graph
