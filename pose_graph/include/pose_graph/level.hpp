// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/specific_force.hpp"

namespace pose_graph {

using urban_nav_core::SpecificForce;

/// The mean of the samples around each stamp, from half-way to the stamp before to half-way to the next one, no further
/// than 0.1 s. Stamps without any are left out, and so are samples that are not finite or above 1000 m/s2. `stamps`
/// ascend; samples may come in any order.
std::vector<SpecificForce> forcesAt(const std::vector<urban_nav_core::StampNs>& stamps,
                                    std::vector<SpecificForce> samples);

/// Why it is not known which way is up.
enum class LevelTrouble {
  None,
  NoForces,    ///< no specific force was measured at any pose
  TooShort,    ///< less than five spans of 0.25 s without a gap
  NotGravity,  ///< the specific force has not the size of gravity: other units, or an IMU that takes gravity off
};
const char* toString(LevelTrouble trouble);

/// Which way is up, seen from a pose that is called the first here.
struct Level {
  LevelTrouble trouble = LevelTrouble::NoForces;
  std::string sentence;  ///< for a person, where it is not known
  bool known() const { return trouble == LevelTrouble::None; }

  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();         ///< of length 1
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< of `up`, rad2; zero along it
  double sigma = 0.0;                                    ///< rad: the larger of the two
  double gravity = 0.0;                                  ///< m/s2, as measured
  /// The rotation of a frame `map` at the first pose with z up, and x where the first pose's x points on the ground:
  /// its heading is zero. The identity where nothing is known.
  Eigen::Matrix3d R_map_first = Eigen::Matrix3d::Identity();
};

/// Derivation: docs/derivations/gravity_alignment.md.
///
/// Which way is up, from all forces of a drive: turned into the axes of the first pose by the trajectory's rotations,
/// less the change of velocity that the trajectory shows, they are gravity and what is wrong with the accelerometer.
/// The latter turns with the robot, so the two are separable where it has turned; where it has not, the covariance
/// says so (linear least squares in both, over spans of 2 s, or shorter ones of a session of a few seconds, reweighted
/// as Huber 1964 has it; scatter as found). The
/// trajectory's rotations are taken as exact: see withRotations.
///
/// Each force's stamp must be that of a pose to count. The origin of the accelerometer's frame is taken to be
/// base_link's: its lever arm moves in the robot's turns, which adds up to nothing over the spans. An orientation that
/// an IMU makes of the same forces in a filter of its own is not used: it knows less of the drive.
Level estimateLevel(const urban_nav_core::Trajectory& trajectory, const std::vector<SpecificForce>& forces);
/// Seen from another pose of the trajectory's world than its first: T_world_first.
Level estimateLevel(const urban_nav_core::Trajectory& trajectory, const std::vector<SpecificForce>& forces,
                    const urban_nav_core::Pose& T_world_first);

/// The rotations of a trajectory are themselves not exact, and what all of them have in common looks like a tilt of the
/// first pose: `covariance` of it (rad2, a small turn in the axes of the first pose) is added.
Level withRotations(Level level, const Eigen::Matrix3d& covariance);

}  // namespace pose_graph
