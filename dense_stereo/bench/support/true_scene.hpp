// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "dense_stereo/near_scene.hpp"

namespace dense_stereo::bench {

/// Cell of 10 cm on the ground.
using GroundCell = std::pair<int, int>;

/// Connected surface on the ground.
struct TrueObstacle {
  std::vector<Eigen::Vector3d> points;  ///< left optical frame
  /// Returns whether ten or more obstacle points lie within 20 cm of it.
  bool isHitBy(const std::vector<ObstaclePoint>& found) const;
};

/// Ground truth of a stereo pair.
struct TrueScene {
  struct Plane {
    Eigen::Vector3d up;  ///< unit normal, left optical frame
    double height = 0.0;
    double above(const Eigen::Vector3d& p) const { return up.dot(p) + height; }
  };
  std::optional<Plane> ground;          ///< nullopt: there is little ground within 5 m, or it is not planar
  std::vector<TrueObstacle> obstacles;  ///< 10 cm or more above the ground, 1 to 5 m ahead, seen by both cameras
  std::set<GroundCell> occupied;        ///< cells with anything over 5 cm above or below the ground, grown by 25 cm

  /// Returns the number of connected groups of obstacle points without an occupied cell.
  int countFalse(const std::vector<ObstaclePoint>& found) const;
  GroundCell cellAt(const Eigen::Vector3d& p) const;
};

/// Calls `visit` with ground truth and result of every `step`-th pair of a simulated session.
void forEachTrueScene(const std::string& folder, const std::string& truth_folder, int step,
                      const std::function<void(const TrueScene&, const NearScene&)>& visit);

}  // namespace dense_stereo::bench
