// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/drive/travelled_path.hpp"

namespace scene_labeler {
namespace {

constexpr double kLeastStep = 0.05;  // m

}  // namespace

void TravelledPath::update() {
  for (std::size_t i = travelled_.size(); i < T_world_base_.size(); ++i) {
    const double before = i == 0 ? 0.0 : travelled_.back();
    const double step = (T_world_base_[i].pose.t() - T_world_base_[anchor_].pose.t()).norm();
    if (step >= kLeastStep) anchor_ = i;
    travelled_.push_back(step >= kLeastStep ? before + step : before);
  }
}

std::optional<double> TravelledPath::at(urban_nav_core::StampNs stamp) const {
  if (T_world_base_.empty() || stamp < T_world_base_.front().stamp || stamp > T_world_base_.back().stamp)
    return std::nullopt;
  return travelled_[T_world_base_.nearest(stamp)];
}

}  // namespace scene_labeler
