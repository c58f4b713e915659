// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ground_truth/revisits.hpp"
#include "lidar/lidar3d.hpp"
#include "motion/motion.hpp"
#include "proprioception/clock.hpp"
#include "proprioception/imu.hpp"
#include "proprioception/wheels.hpp"

namespace urban_nav_sim {

/// Returns base_link in `world` every 5 ms, from t = 0 to 0.05 s after the end, which covers the last beams.
urban_nav_core::Trajectory trueTrajectory(const Motion& motion, const Clock& truth);
/// Returns base_link in `world` at the (possible) stamps of panoramas.
urban_nav_core::Trajectory truePanoramas(const Motion& motion, const Clock& ladybug);

/// `stamp_a_ns,stamp_b_ns,distance_m,heading_deg`, to 0.1 mm and 0.001 deg.
void writeRevisits(const std::string& path, const urban_nav_core::Trajectory& panoramas,
                   const std::vector<Revisit>& revisits);
/// `session_a,stamp_a_ns,session_b,stamp_b_ns,probability`; both sessions are 0.
void writeClosures(const std::string& path, const urban_nav_core::Trajectory& panoramas,
                   const std::vector<Closure>& closures);

/// `sensor,offset_s,skew,jitter_s`: errors of the stamps of each sensor.
void writeClocks(const std::string& path, const std::map<Sensor, ClockOptions>& clocks);

/// `ring,elevation_deg,elevation_error_deg,range_bias_m`: nominal elevation, true minus nominal, measured minus true.
void writeLidarRings(const std::string& path, const Lidar3d& lidar);

/// Biases at the true times of all measurements: imu.csv `stamp_ns,bx,by,bz,ax,ay,az` (gyroscope, rad/s; accelerometer,
/// m/s^2); and imu_scale.csv `sensor,xx,xy,xz,yx,yy,yz,zx,zy,zz`: the matrices of their scale and axis errors.
void writeImuErrors(const std::string& folder, const Imu& imu, const Clock& truth, double duration);
/// wheels.csv: `stamp_ns,left_scale,right_scale,slip_left,slip_right` at the true times of all measurements.
void writeWheelErrors(const std::string& folder, const Wheels& wheels, const Clock& truth);

/// Writes the truth folder of docs/files.md, without cloud.ply, into an existing folder: trajectory.tum, revisits.csv,
/// closures_true.csv and, if `false_percent` is positive, closures_false.csv with that percentage of the number of true
/// ones. `ladybug`: clock of the stamps of panoramas. Throws UserError naming a file that cannot be written.
void writeTruthFiles(const std::string& folder, const Motion& motion, const Clock& truth, const Clock& ladybug,
                     double false_percent, std::uint64_t seed);

}  // namespace urban_nav_sim
