// SPDX-License-Identifier: BSD-3-Clause
// A public recording of a stationary vehicle with an IMU, which measures the remaining motion.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "base/parameters.hpp"
#include "commands/stages.hpp"
#include "map/map_pipeline.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::StampNs;

struct Rate {
  StampNs stamp;
  Eigen::Vector3d rad_s;
};

std::vector<Rate> readGyroscope(const std::string& path) {
  std::vector<Rate> rates;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    Rate rate;
    words >> rate.stamp >> rate.rad_s.x() >> rate.rad_s.y() >> rate.rad_s.z();
    rates.push_back(rate);
  }
  return rates;
}

TEST(Still, TurnsNoFurtherThanTheGyroscope) {
  const char* data = std::getenv("URBAN_NAV_DATA");
  const std::string folder = data == nullptr ? "" : std::string(data) + "/stereo/euroc_still";
  if (folder.empty() || !std::filesystem::exists(folder))
    GTEST_SKIP() << "URBAN_NAV_DATA/stereo/euroc_still is not there";
  const urban_nav_input::testing::TemporaryFolder out;
  Console console;
  runMap({{folder}, out.file("out"), {"vo"}, "", "", "", {}, loadParameters(Arguments({}, addStageTables)), 1},
         makeStages(), console);
  const urban_nav_core::Trajectory estimate = urban_nav_core::readTum(out.file("out") + "/trajectory.tum");
  const std::vector<Rate> rates = readGyroscope(folder + "/mav0/imu0/data.csv");
  ASSERT_EQ(estimate.size(), 50U);
  ASSERT_GT(rates.size(), 500U);

  // It settles after 1.75 s: what is measured from there on is the bias.
  const StampNs first = estimate[0].stamp, calm = first + 1'750'000'000;
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  int count = 0;
  for (const Rate& rate : rates)
    if (rate.stamp > calm) {
      bias += rate.rad_s;
      ++count;
    }
  bias /= count;
  Eigen::Vector3d turned = Eigen::Vector3d::Zero();
  std::size_t next = 0;
  double largest = 0.0;
  constexpr double kDeg = M_PI / 180.0;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    for (; next + 1 < rates.size() && rates[next].stamp < estimate[i].stamp; ++next)
      turned += 1e-9 * static_cast<double>(rates[next + 1].stamp - rates[next].stamp) * (rates[next].rad_s - bias);
    const double seen = angleBetween(estimate[0].pose, estimate[i].pose);
    EXPECT_NEAR(seen, turned.norm(), 0.04 * kDeg) << i;
    EXPECT_LT(distanceBetween(estimate[0].pose, estimate[i].pose), 1e-3) << i;
    largest = std::max(largest, turned.norm());
  }
  EXPECT_GT(largest, 0.1 * kDeg) << "the vehicle rocks; else this would say little";
}

}  // namespace
}  // namespace urban_nav
