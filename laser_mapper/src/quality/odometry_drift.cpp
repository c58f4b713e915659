// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/odometry_drift.hpp"

#include <algorithm>

namespace laser_mapper {

using urban_nav_core::Matrix6d;
using urban_nav_core::StampNs;

void OdometryDrift::add(const urban_nav_core::RelativePose& step, double scale) {
  const Matrix6d& covariance = step.drift_covariance.isZero(0.0) ? step.covariance : step.drift_covariance;
  if (step.to <= step.from || !covariance.allFinite()) return;
  if (!steps_.empty() && step.to <= steps_.back().to) return;
  Step added{step.from, step.to, urban_nav_core::secondsBetween(step.from, step.to), scale * covariance};
  if (!steps_.empty()) {
    added.seconds += steps_.back().seconds;
    added.covariance += steps_.back().covariance;
  }
  steps_.push_back(added);
}

Matrix6d OdometryDrift::rateDuring(StampNs begin, StampNs end) const {
  const auto first =
      std::partition_point(steps_.begin(), steps_.end(), [&](const Step& step) { return step.to <= begin; });
  const auto after = std::partition_point(first, steps_.end(), [&](const Step& step) { return step.from < end; });
  if (first == after) return Matrix6d::Zero();
  const Step& last = *(after - 1);
  if (first == steps_.begin()) return last.covariance / last.seconds;
  const Step& before = *(first - 1);
  return (last.covariance - before.covariance) / (last.seconds - before.seconds);
}

}  // namespace laser_mapper
