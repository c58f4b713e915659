// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "laser_mapper/chunk_renderer.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace laser_mapper {

/// Visibility of a point in the beams of a chunk.
enum class Sight { None, Through, Hit };

/// Beams of one chunk by scan and angle, for visibility tests in the resolution of the device. FreeSpace of
/// urban_nav_registration tests voxels, which are too coarse near the ground. Immutable, hence thread-safe.
class ChunkBeams {
 public:
  /// Requires planar scanners, whose beams lie in the x-y plane of the laser.
  ChunkBeams(const urban_nav_core::Trajectory& T_map_base, const std::vector<LaserInput>& lasers,
             urban_nav_core::StampNs max_gap);

  /// Returns Through if all beams within 0.1 m of the point ended at least 0.3 m farther away; Hit if one ended within
  /// 0.3 m of its distance; None if there are too few beams, or some ended before it.
  Sight look(const Eigen::Vector3d& p) const;

  /// Returns the size in memory, bytes.
  std::size_t bytes() const;

 private:
  /// Revolution of the mirror.
  struct Sweep {
    Eigen::Matrix3d R_laser_map = Eigen::Matrix3d::Identity();
    Eigen::Vector3d t_laser_map = Eigen::Vector3d::Zero();
    std::uint32_t first = 0, last = 0;  ///< beams first...last - 1, by angle
  };
  /// Plane of a revolution of the mirror.
  struct SweepPlane {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    double offset = 0.0;
    double height(const Eigen::Vector3d& p) const { return normal.dot(p) + offset; }
  };
  struct Found {
    float least_excess = 1e9F;  ///< m, range of a beam minus distance of the point
    bool hit = false;
    int beams = 0;
  };
  /// Consecutive revolutions of one laser.
  struct Stretch {
    std::size_t first = 0, last = 0;  ///< indices of sweeps, last not included
    SweepPlane middle;                ///< plane of the middle sweep
    double reach = 0.0;               ///< m, largest difference of point heights relative to those over `middle`
  };
  struct Laser {
    std::vector<Sweep> sweeps;
    std::vector<SweepPlane> planes;  ///< of each sweep
    std::vector<Stretch> stretches;
  };
  static void divide(Laser& laser);
  void lookAlong(const Laser& laser, const Stretch& stretch, const Eigen::Vector3d& p, Found& found) const;
  void lookIn(const Sweep& sweep, const Eigen::Vector3d& p, Found& found) const;

  std::vector<Laser> lasers_;
  std::vector<float> angles_, ranges_;
};

}  // namespace laser_mapper
