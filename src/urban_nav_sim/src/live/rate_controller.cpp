// SPDX-License-Identifier: BSD-3-Clause
#include "live/rate_controller.hpp"

namespace urban_nav_sim {

using std::chrono::duration;
using urban_nav_core::StampNs;

namespace {

// Rendering a panorama may take half a second, for which later frames compensate.
constexpr std::chrono::seconds kMaxLag{1};
constexpr std::chrono::milliseconds kBetweenMarks{250};
constexpr std::chrono::seconds kMostStamps{5};
constexpr double kMeasurable = 1.0;  // s
constexpr double kSlow = 0.95;       // share of the requested rate

double seconds(std::chrono::steady_clock::duration time) { return duration<double>(time).count(); }

}  // namespace

RateController::Wall RateController::due(StampNs taken, Wall now) {
  if (rate_ <= 0.0) return now;
  if (!anchor_) anchor_ = {now, taken};
  const duration<double> since(1e-9 * static_cast<double>(taken - anchor_->taken) / rate_);
  const Wall due = anchor_->wall + std::chrono::duration_cast<std::chrono::steady_clock::duration>(since);
  if (now - due <= kMaxLag) return due;
  slipped_ = true;
  anchor_ = {now, taken};
  return now;
}

void RateController::restart() {
  anchor_.reset();
  marks_.clear();
}

void RateController::passed(StampNs taken, Wall now) {
  if (!marks_.empty() && now - marks_.back().wall < kBetweenMarks) return;
  marks_.push_back({now, taken});
  while (marks_.size() > 2 && now - marks_[1].wall >= kMostStamps) marks_.pop_front();
}

std::optional<double> RateController::factor() const {
  if (marks_.size() < 2) return std::nullopt;
  const double wall = seconds(marks_.back().wall - marks_.front().wall);
  if (wall < kMeasurable) return std::nullopt;
  return 1e-9 * static_cast<double>(marks_.back().taken - marks_.front().taken) / wall;
}

bool RateController::isSlow() const {
  const std::optional<double> now = factor();
  return slipped_ && now && *now < kSlow * rate_;
}

}  // namespace urban_nav_sim
