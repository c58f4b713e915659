// SPDX-License-Identifier: BSD-3-Clause
#include "window/history.hpp"

#include <algorithm>

namespace swf_vo {

using Eigen::Map;
using Eigen::Vector3d;
using urban_nav_core::boxMinus;
using urban_nav_core::boxPlus;
using urban_nav_core::Pose;
using urban_nav_core::Vector6d;

std::map<FrameId, Pose> History::solve(const State& state) const {
  std::map<FrameId, Pose> poses;
  std::map<LandmarkId, Vector3d> landmarks;
  for (const PoseBlock& pose : state.poses) poses[pose.frame] = pose.estimate;
  for (const LandmarkBlock& landmark : state.landmarks)
    if (landmark.used) landmarks[landmark.id] = landmark.estimate;
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    const Eigen::Index size = static_cast<Eigen::Index>(row->offset.size());
    Eigen::VectorXd step = Map<const Eigen::VectorXd>(row->offset.data(), size);
    const double* gain = row->gain.data();
    for (const Row::Tie& tie : row->ties) {
      const Eigen::Index width = tie.is_pose ? 6 : 3;
      Eigen::VectorXd moved(width);
      if (tie.is_pose) moved = boxMinus(poses.at(tie.id), tie.pose);
      else moved = landmarks.at(tie.id) - tie.landmark;
      step += Map<const Eigen::MatrixXd>(gain, size, width) * moved;
      gain += size * width;
    }
    step +=
        Map<const Eigen::VectorXd>(row->disparity_gain.data(), size) * (state.disparity_offset - row->disparity_offset);
    if (row->is_pose) poses[row->id] = boxPlus(row->pose, Vector6d(step));
    else landmarks[row->id] = row->landmark + Vector3d(step);
  }
  return poses;
}

}  // namespace swf_vo
