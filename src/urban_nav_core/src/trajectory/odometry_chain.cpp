// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/odometry_chain.hpp"

#include <algorithm>
#include <cstdlib>

#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/trajectory/interpolate.hpp"

namespace urban_nav_core {
namespace {

constexpr StampNs kLongestGap = 1'000'000'000;  // ns between frames that are interpolated
constexpr StampNs kOutside = 100'000'000;       // ns before the first and after the last frame that are extrapolated
constexpr std::size_t kBlock = 256;             // steps per block; a path requires one matrix product per block

Pose along(const StampedPose& a, const StampedPose& b, StampNs stamp) {
  return interpolate(a.pose, b.pose, static_cast<double>(stamp - a.stamp) / static_cast<double>(b.stamp - a.stamp));
}

}  // namespace

bool OdometryChain::append(const RelativePose& step) {
  if (!step.T_from_to.isFinite() || !step.covariance.allFinite() || !step.drift_covariance.allFinite()) return false;
  if (step.to <= step.from || (!empty() && trajectory_.back().stamp != step.from)) return false;
  if (empty()) {
    trajectory_.append(step.from, Pose());
    distances_.push_back(0.0);
    own_.push_back(Matrix6d::Zero());
  }
  const Pose T_first_from = trajectory_.back().pose;
  const std::size_t number = own_.size() - 1;  // index of the step
  if (number % kBlock == 0) blocks_.push_back({T_first_from, {}});
  Block& block = blocks_.back();
  const bool has_drift = !step.drift_covariance.isZero(0.0);
  const Matrix6d to_origin = adjoint(block.T_first_origin.inverse() * T_first_from) * leftFromBox(step.T_from_to);
  const Matrix6d moved = transformCovariance(to_origin, has_drift ? step.drift_covariance : step.covariance);
  block.sums.push_back(block.sums.empty() ? moved : Matrix6d(block.sums.back() + moved));
  trajectory_.append(step.to, T_first_from * step.T_from_to);
  distances_.push_back(distances_.back() + step.T_from_to.t().norm());
  own_.push_back(has_drift ? step.covariance : Matrix6d(Matrix6d::Zero()));
  return true;
}

std::optional<OdometryChain::NearestFrame> OdometryChain::nearestFrame(StampNs stamp) const {
  if (empty()) return std::nullopt;
  const StampedPose& nearest = trajectory_[findIndex(stamp)];
  if (nearest.stamp == stamp) return NearestFrame{stamp, Pose()};
  std::optional<Pose> there = trajectory_.at(stamp, kLongestGap);
  const std::size_t size = trajectory_.size();
  if (!there && size >= 2 && (stamp < trajectory_.front().stamp || stamp > trajectory_.back().stamp) &&
      std::abs(stamp - nearest.stamp) <= kOutside)
    there = stamp < nearest.stamp ? along(trajectory_[0], trajectory_[1], stamp)
                                  : along(trajectory_[size - 2], trajectory_[size - 1], stamp);
  if (!there) return std::nullopt;
  return NearestFrame{nearest.stamp, nearest.pose.inverse() * *there};
}

std::optional<Pose> OdometryChain::at(StampNs stamp) const {
  const std::optional<NearestFrame> nearest = nearestFrame(stamp);
  if (!nearest) return std::nullopt;
  return trajectory_[findIndex(nearest->frame)].pose * nearest->T_frame_pose;
}

double OdometryChain::distance(StampNs stamp) const {
  if (empty()) return 0.0;
  const std::size_t frame = findIndex(stamp);
  const std::optional<NearestFrame> nearest = nearestFrame(stamp);
  if (!nearest) return distances_[frame];
  const double beside = nearest->T_frame_pose.t().norm();
  return distances_[frame] + (stamp < nearest->frame ? -beside : beside);
}

Matrix6d OdometryChain::drift(std::size_t from, std::size_t to) const {
  Matrix6d sum = Matrix6d::Zero();
  const Pose T_from_first = trajectory_[from].pose.inverse();
  for (std::size_t step = from; step < to;) {
    const std::size_t block = step / kBlock, first = step % kBlock;
    const std::size_t last = std::min(to - block * kBlock, blocks_[block].sums.size()) - 1;
    Matrix6d part = blocks_[block].sums[last];
    if (first > 0) part -= blocks_[block].sums[first - 1];
    sum += transformCovariance(adjoint(T_from_first * blocks_[block].T_first_origin), part);
    step = block * kBlock + last + 1;
  }
  return sum;
}

std::optional<PoseWithCovariance> OdometryChain::between(StampNs a, StampNs b) const {
  const std::optional<NearestFrame> at_a = nearestFrame(a), at_b = nearestFrame(b);
  if (!at_a || !at_b) return std::nullopt;
  const std::size_t from = findIndex(at_a->frame), to = findIndex(at_b->frame);
  if (from > to) {
    const std::optional<PoseWithCovariance> back = between(b, a);
    return back ? std::optional<PoseWithCovariance>(invert(*back)) : std::nullopt;
  }
  const Pose T_first_from = trajectory_[from].pose;
  PoseWithCovariance way;
  way.pose = T_first_from.inverse() * trajectory_[to].pose;
  way.covariance.setZero();
  if (from < to) {
    Matrix6d left = drift(from, to);
    for (const std::size_t step : {from + 1, to}) {
      const Pose T_from_begin = T_first_from.inverse() * trajectory_[step - 1].pose;
      const Pose T_step = trajectory_[step - 1].pose.inverse() * trajectory_[step].pose;
      left += 0.5 * transformCovariance(adjoint(T_from_begin) * leftFromBox(T_step), own_[step]);
    }
    way.covariance = transformCovariance(boxFromLeft(way.pose), left);
  }
  const Matrix6d none = Matrix6d::Zero();
  const PoseWithCovariance before{at_a->T_frame_pose, none}, after{at_b->T_frame_pose, none};
  return compose(invert(before), compose(way, after));
}

}  // namespace urban_nav_core
