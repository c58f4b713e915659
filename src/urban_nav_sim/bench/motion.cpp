// SPDX-License-Identifier: BSD-3-Clause
// Compares the motion of the simulated Segway on each world with the real one: Tables 2 and 3 of the paper, and the
// odometry of the New College log (3.5 s at 27.8 Hz).
//   motion [--route NAME] [--duration S] [--seed N] [-o FILE.json]
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <numeric>
#include <string>
#include <vector>

#include "motion/simulate_drive.hpp"
#include "urban_nav_core/testing/bench_table.hpp"
#include "world/world.hpp"

namespace {

using namespace urban_nav_sim;
using urban_nav_core::testing::BenchTable;
using urban_nav_core::testing::cell;
using Series = std::vector<double>;

constexpr double kPeriod = 0.036;    // s, of wheel odometry
constexpr std::size_t kWindow = 97;  // 3.5 s, as long as the log
constexpr double kDegree = M_PI / 180.0;

struct DriveStatistics {
  Series speed, turn, pitch, pitch_rate, roll;  // m/s, deg/s, deg, deg/s, deg
};

DriveStatistics computeStatistics(const Motion& motion) {
  DriveStatistics statistics;
  for (double t = 0.0; t < motion.duration(); t += kPeriod) {
    const MotionState motion_state = motion.at(t);
    const Eigen::Matrix3d R = motion_state.T_world_base.R();
    statistics.speed.push_back(motion_state.velocity_world.norm());
    statistics.turn.push_back(std::abs(motion_state.rate_base.z()) / kDegree);
    statistics.pitch.push_back(std::asin(-R(2, 0)) / kDegree);
    statistics.pitch_rate.push_back(motion_state.rate_base.y() / kDegree);
    statistics.roll.push_back(std::asin(R(2, 1)) / kDegree);
  }
  return statistics;
}

double mean(const Series& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}
double most(const Series& values) { return *std::max_element(values.begin(), values.end()); }

// Standard deviation about the parabola through one window.
double swayIn(const double* values) {
  Eigen::MatrixX3d powers(kWindow, 3);
  for (std::size_t i = 0; i < kWindow; ++i) {
    const double x = 2.0 * static_cast<double>(i) / kWindow - 1.0;
    powers.row(static_cast<Eigen::Index>(i)) << 1.0, x, x * x;
  }
  const Eigen::Map<const Eigen::VectorXd> window(values, static_cast<Eigen::Index>(kWindow));
  const Eigen::Vector3d fit = Eigen::Matrix3d(powers.transpose() * powers).inverse() * (powers.transpose() * window);
  return std::sqrt((window - powers * fit).squaredNorm() / static_cast<double>(kWindow));
}

// The median over windows of the length of the log in which the robot drives.
double sway(const Series& values, const Series& speed) {
  Series all;
  for (std::size_t i = 0; i + kWindow <= values.size(); i += kWindow) {
    const auto begin = speed.begin() + static_cast<std::ptrdiff_t>(i);
    if (*std::min_element(begin, begin + kWindow) > 0.7) all.push_back(swayIn(values.data() + i));
  }
  if (all.empty()) return 0.0;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  return all[all.size() / 2];
}

}  // namespace

int main(int argc, char** argv) try {
  std::string route_name = "loops", output;
  DriveOptions options;
  options.duration = 300.0;
  options.seed = 7;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string word = argv[i];
    if (word == "--route") route_name = argv[i + 1];
    else if (word == "--duration") options.duration = std::stod(argv[i + 1]);
    else if (word == "--seed") options.seed = std::stoul(argv[i + 1]);
    else if (word == "-o") output = argv[i + 1];
  }

  std::vector<std::string> columns = {"", "real"};
  std::vector<DriveStatistics> drives;
  for (const std::string& name : townNames()) {
    const auto seed = static_cast<std::uint32_t>(options.seed);
    for (const Route& route : worldRoutes(name, seed)) {
      if (route.name != route_name) continue;
      columns.push_back(name);
      drives.push_back(computeStatistics(*simulateDrive(buildWorld(name, seed, 1), route, options)));
    }
  }

  BenchTable table(columns, argc, argv);
  const auto add = [&](const std::string& what, const std::string& real,
                       const std::function<double(const DriveStatistics&)>& of) {
    std::vector<std::string> row = {what, real};
    for (const DriveStatistics& drive : drives) row.push_back(cell(of(drive), 2));
    table.add(row);
  };
  add("speed, mean (m/s)", "0.56 ... 0.94", [](const DriveStatistics& m) { return mean(m.speed); });
  add("speed, most (m/s)", "1.26 ... 1.53 (3.05 once)", [](const DriveStatistics& m) { return most(m.speed); });
  add("turn rate, mean (deg/s)", "4.8 ... 9.5", [](const DriveStatistics& m) { return mean(m.turn); });
  add("turn rate, most (deg/s)", "60 ... 75", [](const DriveStatistics& m) { return most(m.turn); });
  add("pitch about its trend (deg)", "0.29", [](const DriveStatistics& m) { return sway(m.pitch, m.speed); });
  add("pitch rate about its trend (deg/s)", "1.6",
      [](const DriveStatistics& m) { return sway(m.pitch_rate, m.speed); });
  add("roll about its trend (deg)", "0.50", [](const DriveStatistics& m) { return sway(m.roll, m.speed); });
  add("speed about its trend (m/s)", "0.04", [](const DriveStatistics& m) { return sway(m.speed, m.speed); });
  table.note(
      "Real: the first four rows are the sessions of Tables 2 and 3, the others 3.5 s of the New College log, whose "
      "pitch and roll have steps of 0.13 deg. The trend is a parabola over 3.5 s.");
  std::cout << table.text();
  if (!output.empty()) table.write(output);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
