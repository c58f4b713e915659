// SPDX-License-Identifier: BSD-3-Clause
// Accuracy, consistency and processor time on raw sweeps of KITTI with true poses.
//
//   laser_odometry-bench-accuracy FOLDER SWEEPS [KEY=VALUE...] [-o FILE.json]
//
// FOLDER holds times.txt, poses.txt and calib.txt with Tr; SWEEPS the .bin files.
#include <cstdio>

#include "../test/support/velodyne_folder.hpp"
#include "arguments.hpp"
#include "laser_odometry/laser_odometry.hpp"
#include "urban_nav_core/parameters/sources.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "urban_nav_core/testing/processor_time.hpp"
#include "urban_nav_core/trajectory/errors.hpp"
#include "urban_nav_core/trajectory/nees.hpp"
#include "urban_nav_core/types/error.hpp"

using urban_nav_core::Pose;
using urban_nav_core::Span;
using urban_nav_core::testing::cell;

namespace {

struct Result {
  std::vector<Pose> poses;
  std::vector<double> ms;
  double nees = 0.0;  // mean of the steps
  int not_ok = 0;
};

Result run(const laser_odometry::VelodyneFolder& drive, const laser_odometry::Parameters& parameters) {
  Result result;
  laser_odometry::LaserOdometry odometry(parameters, drive.T_base_lidar);
  for (std::size_t i = 0; i < drive.files.size(); ++i) {
    const urban_nav_core::Sweep sweep = drive.read(i);
    const double begin = urban_nav_core::testing::threadMs();
    const laser_odometry::LaserPose pose = odometry.process(sweep);
    result.ms.push_back(urban_nav_core::testing::threadMs() - begin);
    result.poses.push_back(pose.T_odom_base);
    if (pose.status.health != urban_nav_core::Health::Ok) ++result.not_ok;
    if (i == 0) continue;
    const Pose truth = drive.truth[i - 1].inverse() * drive.truth[i];
    result.nees +=
        urban_nav_core::nees(truth, urban_nav_core::PoseWithCovariance{pose.step.T_from_to, pose.step.covariance})
            .value_or(1e9);
  }
  result.nees /= static_cast<double>(drive.files.size() - 1);
  std::sort(result.ms.begin(), result.ms.end());
  return result;
}

void addRow(const std::string& name, const laser_odometry::VelodyneFolder& drive,
            const laser_odometry::Parameters& parameters, urban_nav_core::testing::BenchTable& table) {
  const Result result = run(drive, parameters);
  const auto percent = [&](double frames) {
    const auto error = relativeError(drive.truth, result.poses, {Span::Unit::Frames, frames});
    return error ? cell(error->percent, 3) : std::string("-");
  };
  const double length = urban_nav_core::pathLength(result.poses) / urban_nav_core::pathLength(drive.truth) - 1.0;
  table.add({name, percent(10), percent(50), cell(100.0 * length, 3), cell(result.nees, 1),
             cell(result.ms[result.ms.size() / 2], 1), cell(result.ms.back(), 1), std::to_string(result.not_ok)});
}

}  // namespace

int main(int argc, char** argv) try {
  auto [parameters, output] = laser_odometry::bench::readArguments(argc, argv, 3);
  if (argc < 3) {
    std::fputs("usage: laser_odometry-bench-accuracy FOLDER SWEEPS [KEY=VALUE...] [-o FILE.json]\n", stderr);
    return 2;
  }
  const laser_odometry::VelodyneFolder drive(argv[1], argv[2]);
  urban_nav_core::testing::BenchTable table(
      {"sweeps", "10 frames, %", "50 frames, %", "length, %", "NEES", "median, ms", "most, ms", "not OK"}, argc, argv);
  addRow("deskewed", drive, parameters, table);
  parameters.deskew = false;
  addRow("not deskewed", drive, parameters, table);
  std::fputs(table.text().c_str(), stdout);
  if (!output.empty()) table.write(output);
  return 0;
} catch (const urban_nav_core::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
