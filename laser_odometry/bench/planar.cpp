// SPDX-License-Identifier: BSD-3-Clause
// Accuracy, consistency and processor time of planar lasers in simulated buildings with true poses.
//
//   laser_odometry-bench-planar [KEY=VALUE...] [-o FILE.json]
#include <cstdio>

#include "../test/support/floor_plans.hpp"
#include "arguments.hpp"
#include "laser_odometry/laser_odometry.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/error.hpp"

using urban_nav_core::Pose;
using urban_nav_core::testing::cell;

namespace {

constexpr int kScans = 300;

struct Drive {
  const char* name;
  laser_odometry::BoxWorld world;
  laser_odometry::SpinningLidar laser;
  std::function<Pose(double)> motion;
};

struct Run {
  std::vector<Pose> truth, poses;
  urban_nav_core::OdometryChain chain;
  std::vector<double> ms;
  int not_ok = 0;
};

Run run(const Drive& drive, std::uint64_t seed, const laser_odometry::Parameters& parameters) {
  Run result;
  laser_odometry::LaserOdometry odometry(parameters, drive.laser.T_base_lidar, laser_odometry::Scanner::Planar);
  for (int i = 0; i < kScans; ++i) {
    const double t = drive.laser.sweep_s * i;
    const urban_nav_core::Sweep sweep = drive.laser.scan(drive.world, drive.motion, t, seed);
    const double begin = urban_nav_core::testing::threadMs();
    const laser_odometry::LaserPose pose = odometry.process(sweep);
    result.ms.push_back(urban_nav_core::testing::threadMs() - begin);
    result.truth.push_back(drive.motion(t));
    result.poses.push_back(pose.T_odom_base);
    if (i > 0) result.chain.append(pose.step);
    if (pose.status.health != urban_nav_core::Health::Ok) {
      ++result.not_ok;
      if (std::getenv("VERBOSE")) std::fprintf(stderr, "%d %s\n", i, pose.status.sentence.c_str());
    }
  }
  std::sort(result.ms.begin(), result.ms.end());
  return result;
}

/// Returns the mean NEES of x, y and yaw over spans of a number of scans; 3 is expected.
double neesInPlane(const Run& run, std::size_t scans) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i + scans < run.poses.size(); i += std::max<std::size_t>(1, scans / 5)) {
    const auto& frames = run.chain.trajectory();
    const auto step = run.chain.between(frames[i].stamp, frames[i + scans].stamp);
    const urban_nav_core::Vector6d d =
        urban_nav_core::boxMinus(run.truth[i].inverse() * run.truth[i + scans], step->pose);
    Eigen::Matrix3d C;
    const int in_plane[] = {0, 1, 5};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) C(r, c) = step->covariance(in_plane[r], in_plane[c]);
    const Eigen::Vector3d e(d[0], d[1], d[5]);
    sum += e.dot(urban_nav_core::SmallCholesky<3>(C).solve(e));
    count += 1.0;
  }
  return sum / count;
}

/// Returns the root mean square error of the position (mm) over spans of a number of scans.
double errorInMillimetres(const Run& run, std::size_t scans) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i + scans < run.poses.size(); ++i, count += 1.0)
    sum += ((run.truth[i].inverse() * run.truth[i + scans]).t() - (run.poses[i].inverse() * run.poses[i + scans]).t())
               .squaredNorm();
  return 1e3 * std::sqrt(sum / count);
}

}  // namespace

int main(int argc, char** argv) try {
  const auto [parameters, output] = laser_odometry::bench::readArguments(argc, argv, 1);
  using laser_odometry::makePlanarLaser;
  std::vector<Drive> drives;
  drives.push_back({"office", {}, makePlanarLaser(), laser_odometry::makeFigureEight(5.0, 2.0, 30.0)});
  drives.push_back(
      {"office, 360 beams of 20 mm", {}, makePlanarLaser(360, 0.02), laser_odometry::makeFigureEight(5.0, 2.0, 30.0)});
  drives.push_back({"hall", {}, makePlanarLaser(1440, 0.015), laser_odometry::makeFigureEight(20.0, 7.0, 60.0)});
  urban_nav_core::testing::BenchTable table({"place", "seed", "error over 1, 10, 50 scans, mm", "NEES 1", "NEES 10",
                                             "NEES 50", "median, ms", "most, ms", "not OK"},
                                            argc, argv);
  for (Drive& drive : drives)
    for (const std::uint64_t seed : {1, 2}) {
      drive.world =
          std::string(drive.name) == "hall" ? laser_odometry::makeHall(seed) : laser_odometry::makeOffice(seed);
      const Run result = run(drive, seed, parameters);
      table.add({drive.name, std::to_string(seed),
                 cell(errorInMillimetres(result, 1), 1) + ", " + cell(errorInMillimetres(result, 10), 1) + ", " +
                     cell(errorInMillimetres(result, 50), 1),
                 cell(neesInPlane(result, 1), 1), cell(neesInPlane(result, 10), 1), cell(neesInPlane(result, 50), 1),
                 cell(result.ms[result.ms.size() / 2], 2), cell(result.ms.back(), 2), std::to_string(result.not_ok)});
    }
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
} catch (const urban_nav_core::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
