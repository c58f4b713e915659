// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "loop_metric/keyframe.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/point_cloud.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"

namespace loop_metric {

/// A moment of a session whose view was kept, and where it lies beside another moment.
struct NearbyView {
  urban_nav_core::PoseRef at;
  urban_nav_core::PoseWithCovariance T_moment_view;  ///< between base_links; the covariance may be zero
  double way = 0.0;                             ///< m driven from the moment to the view; negative: before it
};

/// What is kept of the places that candidates name: LoopMetric asks for it piece by piece, as it needs it. Whoever has the recording or its
/// store answers.
class Surroundings {
 public:
  virtual ~Surroundings() = default;

  /// Does odometry know where the robot was at this moment? Else nothing can be said of it; `why` is told for people.
  virtual bool knows(const urban_nav_core::PoseRef& at, std::string& why) const = 0;
  /// The views whose way from the moment is at most `way` m, in order of time.
  virtual std::vector<NearbyView> views(const urban_nav_core::PoseRef& at, double way) const = 0;
  /// Without image and points where it was not kept. DataError where what was kept is damaged.
  virtual Keyframe keyframe(const urban_nav_core::PoseRef& at) const = 0;
  /// What the lasers saw from `way` m before the moment to `way` m behind it, in base_link's frame at the moment; empty where no laser saw
  /// anything.
  virtual urban_nav_core::PointCloud cloud(const urban_nav_core::PoseRef& at, double way) const = 0;
  /// By how much odometry's drift bends that cloud, m: the deviation of its points from where they would lie beside the others.
  virtual double bend(const urban_nav_core::PoseRef& at, double way) const = 0;
  /// T_a_b as odometry has it, and how far the robot drove in between; empty between sessions.
  struct Way {
    urban_nav_core::PoseWithCovariance T_a_b;
    double length = 0.0;  ///< m
  };
  virtual std::optional<Way> between(const urban_nav_core::PoseRef& a, const urban_nav_core::PoseRef& b) const = 0;
};

}  // namespace loop_metric
