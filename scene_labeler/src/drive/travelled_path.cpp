// SPDX-License-Identifier: BSD-3-Clause
#include "scene_labeler/drive/travelled_path.hpp"

namespace scene_labeler {
namespace {

constexpr double least_step = 0.05;  // m

}  // namespace

TravelledPath::TravelledPath(const urban_nav_core::Trajectory& T_world_base) : T_world_base_(T_world_base) {
  travelled_.reserve(T_world_base.size());
  double sum = 0.0;
  std::size_t anchor = 0;
  for (std::size_t i = 0; i < T_world_base.size(); ++i) {
    const double step = (T_world_base[i].pose.t() - T_world_base[anchor].pose.t()).norm();
    if (step >= least_step) {
      sum += step;
      anchor = i;
    }
    travelled_.push_back(sum);
  }
}

std::optional<double> TravelledPath::at(urban_nav_core::StampNs stamp) const {
  if (T_world_base_.empty() || stamp < T_world_base_.front().stamp || stamp > T_world_base_.back().stamp)
    return std::nullopt;
  return travelled_[T_world_base_.nearest(stamp)];
}

}  // namespace scene_labeler
