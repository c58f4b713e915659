// SPDX-License-Identifier: BSD-3-Clause
#include "fusion/interval_motion.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/trajectory/interpolate.hpp"

namespace urban_nav_core {

namespace {

constexpr StampNs kLongestStep = 1'000'000'000;  // ns: longest step that is interpolated

/// Returns the drift covariance of a step: its whole covariance if the odometry does not provide the drift.
const Matrix6d& driftPart(const RelativePose& step) {
  return step.drift_covariance.isZero(0.0) ? step.covariance : step.drift_covariance;
}

/// Returns the covariance of a step minus its drift, without negative eigenvalues.
Matrix6d endPart(const RelativePose& step) {
  const SmallEigen<6> eigen = smallEigen<6>(Matrix6d(step.covariance - driftPart(step)));
  return eigen.vectors * eigen.values.cwiseMax(0.0).asDiagonal() * eigen.vectors.transpose();
}

void addConstant(std::vector<ConstantShare>& shares, const ConsideredConstant& constant, const Matrix6d& J) {
  auto share = std::find_if(shares.begin(), shares.end(),
                            [&constant](const ConstantShare& each) { return each.name == constant.name; });
  if (share == shares.end()) {
    ConstantShare first;
    first.name = constant.name;
    share = shares.insert(share, first);
  }
  const Vector6d moved = J * constant.sensitivity;
  share->sensitivity += moved;
  share->used += constant.used * moved;
}

}  // namespace

InterpolatedOdometry::InterpolatedOdometry(const std::vector<RelativePose>& steps, double acceleration,
                                           double angular_acceleration)
    : steps_(steps), acceleration_(acceleration), angular_acceleration_(angular_acceleration) {}

std::optional<InterpolatedOdometry::Place> InterpolatedOdometry::find(StampNs stamp) const {
  if (steps_.empty() || stamp < steps_.front().from || stamp > steps_.back().to) return std::nullopt;
  const auto step = std::partition_point(steps_.begin(), steps_.end() - 1,
                                         [stamp](const RelativePose& each) { return each.to < stamp; });
  const Place place{static_cast<std::size_t>(step - steps_.begin()),
                    static_cast<double>(stamp - step->from) / static_cast<double>(step->to - step->from)};
  const bool is_within = place.share > 0.0 && place.share < 1.0;
  if (is_within && step->to - step->from > kLongestStep) return std::nullopt;
  return place;
}

Matrix6d InterpolatedOdometry::endError(const Place& place) const {
  const RelativePose& step = steps_[place.step];
  const double seconds = 1e-9 * static_cast<double>(step.to - step.from);
  const double bend = 0.5 * seconds * seconds * place.share * (1.0 - place.share);
  Matrix6d error = 0.5 * endPart(step);
  error.diagonal().head<3>().array() += std::pow(bend * acceleration_, 2);
  error.diagonal().tail<3>().array() += std::pow(bend * angular_acceleration_, 2);
  return error;
}

std::optional<IntervalMotion> InterpolatedOdometry::over(StampNs from, StampNs to) const {
  std::optional<Place> a = find(from);
  const std::optional<Place> b = find(to);
  if (!a || !b) return std::nullopt;
  if (a->share == 1.0 && a->step + 1 < steps_.size()) a = Place{a->step + 1, 0.0};
  IntervalMotion motion;
  std::vector<Pose> begins;  // T_from_begin of the overlapping steps
  Pose T_from_end = interpolate(Pose(), steps_[a->step].T_from_to, a->share).inverse();
  for (std::size_t k = a->step; k <= b->step; ++k) {
    begins.push_back(T_from_end);
    const double share = k == b->step ? b->share : 1.0;
    motion.T_from_to = T_from_end * interpolate(Pose(), steps_[k].T_from_to, share);
    T_from_end = T_from_end * steps_[k].T_from_to;
  }
  const Matrix6d to_box = boxFromLeft(motion.T_from_to);
  for (std::size_t k = a->step; k <= b->step; ++k) {
    const RelativePose& step = steps_[k];
    const double part = (k == b->step ? b->share : 1.0) - (k == a->step ? a->share : 0.0);
    const Matrix6d J = to_box * adjoint(begins[k - a->step]) * leftFromBox(step.T_from_to);
    motion.drift += part * transformCovariance(J, driftPart(step));
    for (const ConsideredConstant& constant : step.constants) addConstant(motion.constants, constant, part * J);
    motion.is_lost = motion.is_lost || step.status.health == Health::Lost;
    if (k == a->step) motion.covariance += transformCovariance(J, endError(*a));
    if (k == b->step) motion.covariance += transformCovariance(J, endError(*b));
  }
  motion.covariance += motion.drift;
  return motion;
}

}  // namespace urban_nav_core
