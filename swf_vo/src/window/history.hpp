// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "window/prior.hpp"
#include "window/state.hpp"

namespace swf_vo {

/// Eliminated rows, stored on request: with them the full system can be solved at any time by back-substitution (Newman
/// et al. 2009, section 2.2). Grows with the trajectory.
class History {
 public:
  /// A marginalised block: d_a = mean + gain d_b, with d_b the deviations of the blocks it was coupled to from their
  /// estimates at that time.
  struct Row {
    bool is_pose = false;
    std::int64_t id = 0;        ///< frame or landmark
    urban_nav_core::Pose pose;  ///< estimate at marginalisation
    Eigen::Vector3d landmark = Eigen::Vector3d::Zero();
    urban_nav_core::Pose linearised_pose;  ///< linearisation point of its terms
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
    std::vector<double> disparity_gain;  ///< gain for the disparity offset, offset.size()
  };

  std::vector<Row> rows;  ///< in order of marginalisation

  /// Returns the poses of all frames, marginalised ones and those of `state`, given all measurements in `state`.
  std::map<FrameId, urban_nav_core::Pose> solve(const State& state) const;
};

}  // namespace swf_vo
