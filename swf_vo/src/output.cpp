// SPDX-License-Identifier: BSD-3-Clause
#include "output.hpp"

#include <algorithm>
#include <cmath>

#include "health/health.hpp"
#include "prediction.hpp"
#include "urban_nav_core/geometry/compose.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/io/archive_types.hpp"

namespace swf_vo {

using urban_nav_core::compose;
using urban_nav_core::Matrix6d;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::StampNs;
using urban_nav_core::Status;

namespace {

bool isProper(const urban_nav_core::Matrix6d& covariance) {
  return urban_nav_core::SmallCholesky<6>(covariance).succeeded();
}

Matrix6d moved(const Matrix6d& covariance, const Matrix6d& jacobian) {
  const Matrix6d result = jacobian * covariance * jacobian.transpose();
  return 0.5 * (result + result.transpose());
}

// Landmarks beyond this depth are not written: it is not significant.
constexpr double kFarAway = 200.0;  // m

// Landmarks whose first frame is stored; beyond this number, those that are no longer in the map are removed.
constexpr std::size_t kLargestMemory = 16384;

}  // namespace

Output::Output(const Pose& T_base_camera) : T_base_camera_(T_base_camera), T_camera_base_(T_base_camera.inverse()) {
  born_.reserve(kLargestMemory);
  frame_.features.reserve(1024);
  frame_.landmarks.reserve(1024);
  frame_.settled.reserve(4);
  waiting_.reserve(64);
}

int Output::computeAge(LandmarkId landmark, FrameId frame) {
  const auto at = std::lower_bound(born_.begin(), born_.end(), landmark,
                                   [](const auto& entry, LandmarkId id) { return entry.first < id; });
  if (at != born_.end() && at->first == landmark) return static_cast<int>(frame - at->second);
  born_.insert(at, {landmark, frame});
  return 0;
}

void Output::list(const Window& window, const FrontEndResult* seen) {
  frame_.features.clear();
  frame_.landmarks.clear();
  const Pose T_camera_odom = window.newest().pose.inverse();
  for (const MapPoint& point : window.map()) {
    const double w = point.p_odom.w();
    if (!(w > 0.0)) continue;
    const Eigen::Vector3d p_odom = point.p_odom.head<3>() / w;
    const double depth = (T_camera_odom * p_odom).z();
    if (depth > 0.0 && depth < kFarAway) frame_.landmarks.push_back({point.landmark, p_odom, 0.0F});
  }
  if (seen == nullptr) return;
  double ages = 0.0;
  for (const auto* group : {&seen->tracked, &seen->fresh}) {
    for (const Observation& observation : *group) {
      const int age = computeAge(observation.landmark, frame_.frame);
      ages += age + 1;
      frame_.features.push_back({observation.landmark, observation.z, age, window.weight(observation.landmark) >= 0.5});
    }
  }
  // Landmarks that are no longer in the map are at the front, since ids increase.
  if (born_.size() + 1024 > kLargestMemory) {
    const auto& map = window.map();
    born_.erase(std::remove_if(born_.begin(), born_.end(),
                               [&](const auto& entry) {
                                 return std::none_of(map.begin(), map.end(), [&](const MapPoint& point) {
                                   return point.landmark == entry.first;
                                 });
                               }),
                born_.end());
  }
  frame_.statistics.corners = seen->corners;
  frame_.statistics.features = static_cast<int>(frame_.features.size());
  frame_.statistics.tracked = static_cast<int>(seen->tracked.size());
  frame_.statistics.track_length_mean =
      frame_.features.empty() ? 0.0 : ages / static_cast<double>(frame_.features.size());
}

Velocity Output::velocity(FrameId frame, StampNs stamp, bool lost, const Window& window, const ProcessInput& u) const {
  Velocity velocity;
  velocity.covariance.diagonal() << Eigen::Vector3d::Constant(kUnknownSpeed * kUnknownSpeed),
      Eigen::Vector3d::Constant(kUnknownAngularSpeed * kUnknownAngularSpeed);
  if (waiting_.empty()) return velocity;
  const double seconds = urban_nav_core::secondsBetween(waiting_.back().stamp, stamp);
  const Pose last = window.hasPose(frame - 1) ? window.pose(frame - 1) : last_T_odom_camera_;
  const Pose step = last.inverse() * window.newest().pose;
  const auto inner = compose(T_base_camera_, step);
  const auto outer = compose(inner.T_a_c, T_camera_base_);
  velocity.twist = urban_nav_core::logSe3(outer.T_a_c) / seconds;
  // Successive steps have similar covariances, so that of the last settled step is used, unless nothing was measured:
  // then that of the process model.
  const bool settled = !lost && !step_covariance_.isZero();
  const Matrix6d covariance =
      settled ? step_covariance_ : moved(urban_nav_core::inverseByLu<6>(u.information), outer.J1 * inner.J2);
  velocity.covariance = covariance / (seconds * seconds);
  return velocity;
}

const Frame& Output::write(FrameId frame, StampNs stamp, const Status& status, const Window& window,
                           const ProcessInput& u, const FrontEndResult* seen, const UpdateReport& update) {
  frame_.velocity = velocity(frame, stamp, status.health == urban_nav_core::Health::Lost, window, u);
  frame_.frame = frame;
  frame_.stamp = stamp;
  frame_.accepted = true;
  frame_.status = status;
  const double row_offset = seen != nullptr ? seen->row_offset_px : frame_.statistics.row_offset_px;
  const double noise_scale = seen != nullptr ? seen->noise_scale : frame_.statistics.noise_scale;
  frame_.statistics = {};
  const PoseWithCovariance newest = window.newest();
  last_T_odom_camera_ = newest.pose;
  const auto base = compose(newest.pose, T_camera_base_);
  frame_.T_odom_base = {base.T_a_c, moved(newest.covariance, base.J1)};
  list(window, seen);
  frame_.statistics.reprojection_px = update.reprojection_px;
  frame_.statistics.iterations = update.iterations;
  frame_.statistics.landmarks = update.landmarks;
  frame_.statistics.landmarks_in_prior = update.landmarks_in_prior;
  frame_.statistics.disparity_offset_px = window.disparityOffset();
  frame_.statistics.disparity_offset_sigma_px = window.disparityOffsetSigma();
  frame_.statistics.row_offset_px = row_offset;
  frame_.statistics.noise_scale = noise_scale;
  if (seen != nullptr) {
    frame_.rig = seen->rig;
    frame_.statistics.disparity_step = seen->disparity_step;
  }
  frame_.rig.scale_sigma = window.scaleSigma();
  frame_.statistics.right_turn_rad = frame_.rig.right_turn_rad;
  Waiting waiting;
  waiting.frame = frame;
  waiting.stamp = stamp;
  waiting.status = status;
  waiting_.push_back(waiting);
  frame_.settled.clear();
  for (const SettledPose& pose : window.settled()) frame_.settled.push_back(settle(pose));
  return frame_;
}

const Frame& Output::refused(StampNs stamp) {
  frame_.stamp = stamp;
  frame_.accepted = false;
  frame_.status = {urban_nav_core::Health::Degraded, static_cast<int>(Reason::BadStamp), sentence(Reason::BadStamp)};
  frame_.statistics.disparity_step = {};
  frame_.settled.clear();
  frame_.features.clear();
  return frame_;
}

Settled Output::settle(const SettledPose& pose) {
  Settled settled;
  const auto at =
      std::find_if(waiting_.begin(), waiting_.end(), [&](const Waiting& w) { return w.frame == pose.frame; });
  settled.frame = pose.frame;
  settled.stamp = at->stamp;
  settled.status = at->status;
  waiting_.erase(waiting_.begin(), at + 1);

  const auto base = compose(pose.T_odom_camera.pose, T_camera_base_);
  settled.T_odom_base = {base.T_a_c, moved(pose.T_odom_camera.covariance, base.J1)};
  const auto inner = compose(T_base_camera_, pose.T_previous_camera);
  const auto outer = compose(inner.T_a_c, T_camera_base_);
  settled.from_previous.from = any_settled_ ? last_settled_ : settled.stamp;
  settled.from_previous.to = settled.stamp;
  settled.from_previous.T_from_to = any_settled_ ? outer.T_a_c : Pose();
  settled.from_previous.covariance = moved(pose.relative_covariance, outer.J1 * inner.J2);
  // The difference of two poses far from the first one can lose all significant digits in some direction; successive
  // steps have similar covariances.
  if (!step_covariance_.isZero() && !isProper(settled.from_previous.covariance))
    settled.from_previous.covariance = step_covariance_;
  settled.from_previous.drift_covariance = moved(pose.drift_covariance, outer.J1 * inner.J2);
  settled.from_previous.constants = pose.constants;
  for (urban_nav_core::ConsideredConstant& constant : settled.from_previous.constants)
    constant.sensitivity = outer.J1 * (inner.J2 * constant.sensitivity);
  settled.from_previous.status = settled.status;
  settled.from_previous.source = "swf_vo";
  if (any_settled_) step_covariance_ = settled.from_previous.covariance;
  last_settled_ = settled.stamp;
  any_settled_ = true;
  return settled;
}

void Output::Waiting::archive(urban_nav_core::Archive& archive) { archive(frame, stamp, status); }

void Output::archive(urban_nav_core::Archive& archive, const Window& window) {
  archive(frame_, waiting_, last_settled_, any_settled_, last_T_odom_camera_, step_covariance_, born_);
  archive.require(std::all_of(waiting_.begin(), waiting_.end(),
                              [&](const Waiting& waiting) { return window.hasPose(waiting.frame); }) &&
                      waiting_.size() == window.poses(),
                  "frames differ from those of the window");
  const auto out_of_order =
      std::adjacent_find(born_.begin(), born_.end(), [](const auto& a, const auto& b) { return a.first >= b.first; });
  archive.require(out_of_order == born_.end(), "landmark ids are not increasing");
}

}  // namespace swf_vo
