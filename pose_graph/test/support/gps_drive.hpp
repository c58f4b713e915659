// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "pose_graph/pose_graph.hpp"

namespace pose_graph::testing {

/// A long drive through streets, its odometry, and the fixes of a receiver.
struct GpsDrive {
  // Errors, as standard deviations.
  double turn_drift = 0.0;   // rad per square root of a metre, in heading
  double scale_error = 0.0;  // common to the whole drive
  double slow = 0.0;         // m, of fix errors with a correlation time of kSlowSeconds
  double white = 0.0;        // m, independent between fixes
  double reflected = 0.0;    // m: multipath error, one minute in eight
  double stated = 1.0;       // m, as stated by the receiver

  std::vector<StampNs> stamps;
  std::vector<Pose> truth;
  std::vector<urban_nav_core::RelativePose> odometry;
  std::vector<PositionFix> fixes;

  static constexpr double kSlowSeconds = 60.0;
  /// Returns the antenna position in base_link.
  static Eigen::Vector3d antenna() { return {-0.3, 0.2, 1.1}; }
};

/// Creates a path around blocks of 120 m at 1.25 m/s without revisits, two poses per second, and a fix per second in an
/// east-north-up frame that is rotated against the first pose.
inline void makeDrive(unsigned seed, double seconds, GpsDrive& drive) {
  constexpr double kSpeed = 1.25, kBlock = 120.0, kStep = 0.5;
  std::mt19937 dice(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  const Pose T_local_first(urban_nav_core::expSo3(Eigen::Vector3d(0.0, 0.0, 1.1)), Eigen::Vector3d(30.0, -12.0, 4.0));
  const urban_nav_core::LocalTangent tangent({0.9033, -0.0219, 70.0});
  Pose at;
  double travelled = 0.0, next_corner = kBlock;
  int corner = 0;
  const double scale = 1.0 + drive.scale_error * normal(dice);
  Eigen::Vector3d slow = drive.slow * Eigen::Vector3d(normal(dice), normal(dice), normal(dice));
  const double keep = std::exp(-1.0 / GpsDrive::kSlowSeconds);
  for (int k = 0; k * kStep <= seconds; ++k) {
    const double t = k * kStep;
    if (k > 0) {
      double turn = 0.0;
      if (travelled >= next_corner) {
        turn = (corner++ % 4 < 2 ? 1.0 : -1.0) * M_PI / 2.0;  // right-angled turns away from the start
        next_corner += kBlock;
      }
      const Pose step(urban_nav_core::expSo3(Eigen::Vector3d(0.0, 0.0, turn)), Eigen::Vector3d(kSpeed * kStep, 0, 0));
      const double error = drive.turn_drift * std::sqrt(kSpeed * kStep) * normal(dice);
      urban_nav_core::RelativePose measured;
      measured.from = drive.stamps.back();
      measured.to = static_cast<StampNs>(1e9 * t) + 1;
      measured.T_from_to = Pose(urban_nav_core::expSo3(Eigen::Vector3d(0.0, 0.0, turn + error)), scale * step.t());
      Eigen::Matrix<double, 6, 1> sigmas;
      sigmas << 0.002, 0.002, 0.002, 2e-4, 2e-4, std::max(1e-4, drive.turn_drift * std::sqrt(kSpeed * kStep));
      measured.covariance = sigmas.cwiseAbs2().asDiagonal();
      drive.odometry.push_back(measured);
      at = at * step;
      travelled += kSpeed * kStep;
    }
    drive.stamps.push_back(static_cast<StampNs>(1e9 * t) + 1);
    drive.truth.push_back(at);
    if (k % 2 != 0) continue;
    const bool is_reflected = drive.reflected > 0.0 && std::fmod(t, 480.0) > 400.0 && std::fmod(t, 480.0) < 460.0;
    const Eigen::Vector3d p = T_local_first * (at * GpsDrive::antenna()) + slow +
                              drive.white * Eigen::Vector3d(normal(dice), normal(dice), normal(dice)) +
                              (is_reflected ? Eigen::Vector3d(drive.reflected, 0.0, 0.0) : Eigen::Vector3d::Zero());
    const urban_nav_core::Geodetic measured = tangent.toGeodetic(p);
    constexpr double kToDegrees = 180.0 / M_PI;
    drive.fixes.push_back({{drive.stamps.back(), kToDegrees * measured.latitude, kToDegrees * measured.longitude,
                            measured.height, Eigen::Vector3d::Constant(drive.stated)},
                           GpsDrive::antenna()});
    for (int axis = 0; axis < 3; ++axis)
      slow[axis] = keep * slow[axis] + std::sqrt(1.0 - keep * keep) * drive.slow * normal(dice);
  }
}

/// Returns the relaxed graph of a drive.
inline PoseGraph relaxDrive(const GpsDrive& drive, bool gps) {
  Parameters parameters;
  parameters.gps = gps;
  PoseGraph graph(parameters);
  graph.beginSession("a");
  for (const urban_nav_core::RelativePose& step : drive.odometry) graph.addOdometry("a", step);
  graph.putFixes("a", drive.fixes);
  graph.relax();
  return graph;
}

/// Returns the root mean square distance of a track's positions from the truth after the best rigid alignment, m.
inline double positionError(const GpsDrive& drive, const Track& track) {
  Eigen::Matrix3Xd found(3, static_cast<Eigen::Index>(track.map.size())), true_ones = found;
  for (Eigen::Index i = 0; i < found.cols(); ++i) {
    found.col(i) = track.map[static_cast<std::size_t>(i)].t();
    true_ones.col(i) = drive.truth[static_cast<std::size_t>(i)].t();
  }
  const Eigen::Matrix4d T = Eigen::umeyama(found, true_ones, false);
  const Eigen::Matrix3Xd off = (T.topLeftCorner<3, 3>() * found).colwise() + T.topRightCorner<3, 1>() - true_ones;
  return std::sqrt(off.colwise().squaredNorm().mean());
}

}  // namespace pose_graph::testing
