// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/drive/drive_window.hpp"

#include <algorithm>
#include <limits>

namespace scene_labeler {
namespace {

constexpr std::size_t kMostReturns = 4'000'000;

}  // namespace

void DriveWindow::add(const DriveReturn& one) {
  if (returns_.size() >= kMostReturns && one.travelled <= returns_.back().travelled) return;
  returns_.push_back(one);
  work(false);
}

void DriveWindow::add(DriveFrame frame) {
  frames_.push_back(std::move(frame));
  work(false);
}

void DriveWindow::finish() {
  work(true);
  first_ += returns_.size();
  returns_.clear();
  observer_.settle(first_);
}

void DriveWindow::work(bool is_end) {
  while (!frames_.empty()) {
    const bool is_last = frames_.size() == 1;
    const double travelled = frames_.front().travelled;
    const bool is_complete = !is_last && !returns_.empty() && returns_.back().travelled > travelled + reach_;
    if (!is_complete && !is_end) return;
    const DriveFrame frame = std::move(frames_.front());
    frames_.pop_front();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const DriveObserver::Stretch nearest{has_previous_ ? 0.5 * (previous_ + travelled) : -kInfinity,
                                         is_last ? kInfinity : 0.5 * (travelled + frames_.front().travelled)};
    drop(travelled - reach_);
    const auto end = std::find_if(returns_.begin(), returns_.end(),
                                  [&](const DriveReturn& one) { return one.travelled > travelled + reach_; });
    if (end != returns_.begin())
      observer_.observe(frame, nearest, first_, std::vector<DriveReturn>(returns_.begin(), end));
    has_previous_ = true;
    previous_ = travelled;
    if (!is_last) drop(frames_.front().travelled - reach_);
  }
}

void DriveWindow::drop(double before) {
  const auto end = std::find_if(returns_.begin(), returns_.end(),
                                [before](const DriveReturn& one) { return one.travelled >= before; });
  if (end == returns_.begin()) return;
  first_ += static_cast<std::size_t>(end - returns_.begin());
  returns_.erase(returns_.begin(), end);
  observer_.settle(first_);
}

}  // namespace scene_labeler
