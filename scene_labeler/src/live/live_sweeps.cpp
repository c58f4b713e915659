// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_sweeps.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "scene_labeler/model/place_novelty.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace scene_labeler {

using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kMostCovered = 3;   // sweeps that wait for their labels: 0.3 s at 10 Hz
constexpr std::size_t kMostWaiting = 50;  // sweeps that wait for odometry: 5 s at 10 Hz, 120 MB of 32 beams
constexpr StampNs kLongestPoseGapOfSweeps = 500'000'000;
constexpr std::size_t kRecentSweeps = 50;

StampNs lastStamp(const urban_nav_core::Sweep& sweep) {
  return sweep.beams.empty() ? sweep.reference : std::max(sweep.reference, sweep.beams.back().stamp);
}

}  // namespace

bool LiveSweeps::isCovered(const WaitingSweep& waiting) const {
  return !T_odom_base_.empty() && lastStamp(waiting.sweep) <= T_odom_base_.back().stamp;
}

void LiveSweeps::note(bool is_dropped) {
  recent_.push_back(is_dropped);
  if (recent_.size() > kRecentSweeps) recent_.pop_front();
}

void LiveSweeps::dropOldest() {
  if (isCovered(waiting_.front())) {
    ++counts_.too_many;
    if (counts_.labelled > 0) note(true);  // the first ones arrive at once, when their conventions are known
  } else {
    ++counts_.unplaced;
  }
  waiting_.pop_front();
}

void LiveSweeps::add(const std::string& frame, urban_nav_core::Sweep sweep) {
  ++counts_.sweeps;
  waiting_.push_back({frame, std::move(sweep)});
  const auto covered =
      std::count_if(waiting_.begin(), waiting_.end(), [this](const auto& one) { return isCovered(one); });
  if (static_cast<std::size_t>(covered) > kMostCovered || waiting_.size() > kMostWaiting) dropOldest();
}

bool LiveSweeps::labelNext(const std::shared_ptr<const LabelModel>& model, int superpixel) {
  while (!waiting_.empty() && isCovered(waiting_.front())) {
    const auto begin = std::chrono::steady_clock::now();
    const WaitingSweep next = std::move(waiting_.front());
    waiting_.pop_front();
    const urban_nav_core::BeamRenderer fresh(T_odom_base_, places_.at(next.frame), urban_nav_core::Pose(),
                                             kLongestPoseGapOfSweeps);
    std::vector<urban_nav_core::LaserPoint> returns;
    renderers_.try_emplace(next.frame, fresh).first->second.render({next.sweep.reference, next.sweep.beams}, returns);
    if (returns.empty()) {
      ++counts_.unplaced;
      continue;
    }
    if (!labeler_) labeler_.emplace(model, superpixel);
    const SweepLabels labels = labeler_->label(returns, returns.back().origin);
    ++counts_.labelled;
    counts_.new_place += isNewPlace(labels.answers.share_unlike) ? 1U : 0U;
    note(false);
    take_(next.sweep.reference, returns, labels);
    counts_.last_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return true;
  }
  return false;
}

void LiveSweeps::clear() {
  waiting_.clear();
  renderers_.clear();
  labeler_.reset();
  recent_.clear();
}

std::string LiveSweeps::fault() const {
  const auto dropped = std::count(recent_.begin(), recent_.end(), true);
  if (10 * static_cast<std::size_t>(dropped) <= recent_.size()) return {};
  return std::to_string(dropped) + " of the last " + std::to_string(recent_.size()) +
         " sweeps have no labels, since a sweep takes " + urban_nav_core::formatNumber(counts_.last_ms, 3) +
         " ms: leave fewer beams to the stage, or give it more processor time";
}

}  // namespace scene_labeler
