// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "window/prior.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// The eliminated rows, kept if asked: with them the full system can be solved at any point by back-substitution
/// (Newman et al. 2009, section 2.2). Grows with the trajectory.
class History {
 public:
  /// A block that left: d_a = mean + gain d_b, with d_b the deviations of the blocks it was tied to from where they
  /// were then.
  struct Row {
    bool is_pose = false;
    std::int64_t id = 0;        ///< frame or landmark
    urban_nav_core::Pose pose;  ///< estimate when it left
    Eigen::Vector3d landmark = Eigen::Vector3d::Zero();
    urban_nav_core::Pose linearised_pose;  ///< and where its terms were linearised
    Eigen::Vector3d linearised_landmark = Eigen::Vector3d::Zero();
    Anchor anchor;
    struct Tie {
      bool is_pose = false;
      std::int64_t id = 0;
      urban_nav_core::Pose pose;  ///< estimate at that time
      Eigen::Vector3d landmark = Eigen::Vector3d::Zero();
    };
    std::vector<Tie> ties;
    std::vector<double> offset;          ///< 3 or 6
    std::vector<double> gain;            ///< column-major, offset.size() rows
    double disparity_offset = 0.0;       ///< estimate at that time
    std::vector<double> disparity_gain;  ///< of the disparity offset, offset.size()
  };

  std::vector<Row> rows;  ///< in the order in which they left

  /// Poses of all frames, those that left and those of `state`, given everything that `state` knows now.
  std::map<FrameId, urban_nav_core::Pose> solve(const State& state) const;
};

}  // namespace swf_vo
