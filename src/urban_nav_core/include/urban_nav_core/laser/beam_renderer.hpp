// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav_core {

/// Measured end point of a beam.
struct LaserPoint {
  StampNs stamp = 0;
  Eigen::Vector3f p = Eigen::Vector3f::Zero();       ///< m, in the frame of rendering
  Eigen::Vector3f origin = Eigen::Vector3f::Zero();  ///< position of the laser at the beam's stamp, in the same frame
  float range = 0.0F;                                ///< m
  float intensity = 0.0F;                            ///< 0...255
};

/// Places the beams of a laser along a trajectory, each with the laser's pose at the beam's own time (Newman et al.
/// 2009, section 6). Between two poses the motion is that of interpolate(). Fastest for scans in order of time; any
/// order is supported.
class BeamRenderer {
 public:
  /// `T_world_base` must outlive the renderer. `T_frame_world`: to the frame of the output points, whose single
  /// precision suffices near its origin. No motion is interpolated between poses further apart in time than `max_gap`.
  BeamRenderer(const Trajectory& T_world_base, const Pose& T_base_laser, const Pose& T_frame_world, StampNs max_gap);

  /// Appends a point for every beam within the time span of the trajectory, in order. Returns the number of omitted
  /// beams.
  std::size_t render(const Scan& scan, std::vector<LaserPoint>& points);

 private:
  /// Motion of the laser between two consecutive poses.
  struct Stretch {
    StampNs begin = 0, end = -1;  ///< valid for begin <= stamp <= end; empty: begin > end
    double per_ns = 0.0;          ///< share of the interval per ns
    Matrix3d R_frame_laser;       ///< at `begin`
    Vector3d lever;               ///< from base to laser, in the axes of frame, at `begin`
    Vector3d t, along;            ///< base: position at `begin`, and displacement to `end`
    Vector3d axis;                ///< rotation axis, unit vector
    double angle = 0.0;           ///< total rotation, rad
  };
  bool find(StampNs stamp);
  void begin(const StampedPose& a, const StampedPose& b);
  Vector3d turned(const Vector3d& v, double cosine, double sine) const;

  const Trajectory& T_world_base_;
  const Pose T_base_laser_, T_frame_world_;
  const StampNs max_gap_;
  std::size_t next_ = 0;  ///< pose at the end of the interval, or where the search starts
  Stretch stretch_;
};

}  // namespace urban_nav_core
