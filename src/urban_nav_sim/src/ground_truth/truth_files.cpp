// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth/truth_files.hpp"

#include <cmath>
#include <filesystem>

#include "proprioception/schedule.hpp"
#include "urban_nav_core/io/atomic_file.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_core/io/tum.hpp"

namespace urban_nav_sim {
namespace {

using urban_nav_core::AtomicFile;
using urban_nav_core::printCsvRow;
using urban_nav_core::printNumber;
using urban_nav_core::Trajectory;

constexpr double kOverhang = 0.05;  // s

double roundedTo(double value, double per_unit) { return std::round(value * per_unit) / per_unit + 0.0; }

std::string toStamp(const Trajectory& panoramas, std::size_t index) { return std::to_string(panoramas[index].stamp); }

}  // namespace

Trajectory trueTrajectory(const Motion& motion, const Clock& truth) {
  const Schedule schedule = truthSchedule();
  Trajectory trajectory;
  for (std::int64_t k = 0; k <= schedule.count(motion.duration() + kOverhang); ++k) {
    trajectory.append(truth.taken(schedule.at(k)), motion.at(schedule.at(k)).T_world_base);
  }
  return trajectory;
}

Trajectory truePanoramas(const Motion& motion, const Clock& ladybug) {
  const Schedule schedule = sensorSchedule(Sensor::Ladybug);
  Trajectory trajectory;
  for (std::int64_t k = 0; k < schedule.count(motion.duration()); ++k) {
    trajectory.append(ladybug.stamp(k, schedule.at(k)), motion.at(schedule.at(k)).T_world_base);
  }
  return trajectory;
}

void writeRevisits(const std::string& path, const Trajectory& panoramas, const std::vector<Revisit>& revisits) {
  AtomicFile file(path);
  file.write(printCsvRow({"stamp_a_ns", "stamp_b_ns", "distance_m", "heading_deg"}));
  for (const Revisit& each : revisits) {
    file.write(
        printCsvRow({toStamp(panoramas, each.a), toStamp(panoramas, each.b), printNumber(roundedTo(each.distance, 1e4)),
                     printNumber(roundedTo(each.heading_deg, 1e3))}));
  }
  file.commit();
}

void writeClosures(const std::string& path, const Trajectory& panoramas, const std::vector<Closure>& closures) {
  AtomicFile file(path);
  file.write(printCsvRow({"session_a", "stamp_a_ns", "session_b", "stamp_b_ns", "probability"}));
  for (const Closure& each : closures) {
    file.write(
        printCsvRow({"0", toStamp(panoramas, each.a), "0", toStamp(panoramas, each.b), printNumber(each.probability)}));
  }
  file.commit();
}

void writeClocks(const std::string& path, const std::map<Sensor, ClockOptions>& clocks) {
  std::string text = printCsvRow({"sensor", "offset_s", "skew", "jitter_s"});
  for (const auto& [sensor, clock] : clocks)
    text +=
        printCsvRow({toString(sensor), printNumber(clock.offset), printNumber(clock.skew), printNumber(clock.jitter)});
  urban_nav_core::writeAtomically(path, text);
}

void writeLidarRings(const std::string& path, const Lidar3d& lidar) {
  constexpr double kDegree = 180.0 / M_PI;
  std::string text = printCsvRow({"ring", "elevation_deg", "elevation_error_deg", "range_bias_m"});
  for (int ring = 0; ring < lidar.pattern().rings(); ++ring) {
    const Lidar3d::RingError& error = lidar.ringErrors()[static_cast<std::size_t>(ring)];
    text +=
        printCsvRow({std::to_string(ring), printNumber(roundedTo(kDegree * lidar.pattern().elevation(ring), 1e6)),
                     printNumber(roundedTo(kDegree * error.elevation, 1e6)), printNumber(roundedTo(error.range, 1e6))});
  }
  urban_nav_core::writeAtomically(path, text);
}

void writeImuErrors(const std::string& folder, const Imu& imu, const Clock& truth, double duration) {
  const Schedule schedule = sensorSchedule(Sensor::Imu);
  AtomicFile file(folder + "/imu.csv");
  file.write(printCsvRow({"stamp_ns", "bx", "by", "bz", "ax", "ay", "az"}));
  for (std::int64_t k = 0; k < schedule.count(duration); ++k) {
    const double t = schedule.at(k);
    std::vector<std::string> row = {std::to_string(truth.taken(t))};
    for (const Eigen::Vector3d& bias : {imu.rateBias(t), imu.forceBias(t)})
      for (const double value : bias) row.push_back(printNumber(roundedTo(value, 1e9)));
    file.write(printCsvRow(row));
  }
  file.commit();
  std::string text = printCsvRow({"sensor", "xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"});
  for (const auto& [name, matrix] :
       {std::pair<const char*, Eigen::Matrix3d>{"gyroscope", imu.rateMatrix()}, {"accelerometer", imu.forceMatrix()}}) {
    std::vector<std::string> row = {name};
    for (int i = 0; i < 9; ++i) row.push_back(printNumber(roundedTo(matrix(i / 3, i % 3), 1e9)));
    text += printCsvRow(row);
  }
  urban_nav_core::writeAtomically(folder + "/imu_scale.csv", text);
}

void writeWheelErrors(const std::string& folder, const Wheels& wheels, const Clock& truth) {
  const Schedule schedule = sensorSchedule(Sensor::Wheels);
  AtomicFile file(folder + "/wheels.csv");
  file.write(printCsvRow({"stamp_ns", "left_scale", "right_scale", "slip_left", "slip_right"}));
  for (std::int64_t k = 0; k < wheels.count(); ++k) {
    const Wheels::Errors& errors = wheels.errorsAt(k);
    std::vector<std::string> row = {std::to_string(truth.taken(schedule.at(k)))};
    for (const double value : {errors.left_scale, errors.right_scale, errors.slip_left, errors.slip_right})
      row.push_back(printNumber(roundedTo(value, 1e9)));
    file.write(printCsvRow(row));
  }
  file.commit();
}

void writeTruthFiles(const std::string& folder, const Motion& motion, const Clock& truth, const Clock& ladybug,
                     double false_percent, std::uint64_t seed) {
  const Noise noise(seed, "closures");
  urban_nav_core::writeTum(folder + "/trajectory.tum", trueTrajectory(motion, truth));
  const Trajectory panoramas = truePanoramas(motion, ladybug);
  const std::vector<Revisit> revisits = findRevisits(panoramas);
  writeRevisits(folder + "/revisits.csv", panoramas, revisits);
  const std::vector<Closure> closures = trueClosures(revisits, noise.of("true"));
  writeClosures(folder + "/closures_true.csv", panoramas, closures);
  std::filesystem::remove(folder + "/closures_false.csv");  // of an earlier run
  if (false_percent > 0.0) {
    const auto count =
        static_cast<std::size_t>(std::llround(0.01 * false_percent * static_cast<double>(closures.size())));
    writeClosures(folder + "/closures_false.csv", panoramas, falseClosures(panoramas, count, noise.of("false")));
  }
}

}  // namespace urban_nav_sim
