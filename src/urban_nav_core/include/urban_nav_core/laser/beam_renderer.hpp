// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_core {

/// Where a beam ended.
struct LaserPoint {
  StampNs stamp = 0;
  Eigen::Vector3f p = Eigen::Vector3f::Zero();       ///< m, in the frame that it was rendered in
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< where the laser was at that moment, in the same frame
  float range = 0.0F;                                ///< m
  float intensity = 0.0F;                            ///< 0...255
};

/// Lays the beams of a laser along a trajectory, each from where the laser was at the beam's own time (Newman et al.
/// 2009, section 6). Between two poses the motion is that of interpolate(). Scans in the order of time are laid at
/// once; others are laid as well.
class BeamRenderer {
 public:
  /// `T_world_base` must outlive the renderer. `T_frame_world`: of the points that come out; near the origin of `frame`
  /// their single precision costs nothing. Poses further apart in time than `max_gap` have nothing between them.
  BeamRenderer(const Trajectory& T_world_base, const Pose& T_base_laser, const Pose& T_frame_world, StampNs max_gap);

  /// Appends a point for every beam whose time the trajectory covers, in their order; the number of those left out.
  std::size_t render(const Scan& scan, std::vector<LaserPoint>& points);

 private:
  /// The motion of the laser between a pose and the next one.
  struct Stretch {
    StampNs begin = 0, end = -1;  ///< holds for begin <= stamp <= end; none: begin > end
    double per_ns = 0.0;          ///< share of the way
    Matrix3d R_frame_laser;       ///< at the beginning
    Vector3d lever;               ///< from base to laser, in the axes of frame, at the beginning
    Vector3d t, along;            ///< of the base: at the beginning, and the way to the end
    Vector3d axis;                ///< of the turn, unit
    double angle = 0.0;           ///< of the whole turn, rad
  };
  bool find(StampNs stamp);
  void begin(const StampedPose& a, const StampedPose& b);
  Vector3d turned(const Vector3d& v, double cosine, double sine) const;

  const Trajectory& T_world_base_;
  const Pose T_base_laser_, T_frame_world_;
  const StampNs max_gap_;
  std::size_t next_ = 0;  ///< the pose at the end of the stretch, or where to look first
  Stretch stretch_;
};

}  // namespace urban_nav_core
