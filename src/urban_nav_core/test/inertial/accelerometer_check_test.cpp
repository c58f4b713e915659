// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/inertial/accelerometer_check.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <cmath>
#include <limits>

#include "urban_nav_core/inertial/axis_map.hpp"

namespace urban_nav_core {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Drive at 2 m/s in a slalom: specific force in the axes of the robot, and yaw rate.
std::pair<Vector3d, Vector3d> drive(int i) {
  const double yaw_rate = 0.5 * std::sin(0.02 * i);
  return {{0.2 * std::sin(0.005 * i), 2.0 * yaw_rate + 0.05 * std::sin(1.7 * i), 9.81 + 0.1 * std::cos(2.3 * i)},
          {0.0, 0.0, yaw_rate}};
}

AccelerometerVerdict examine(const Matrix3d& measured_from_true) {
  AccelerometerCheck check;
  for (int i = 0; i < 1500; ++i) check.add(measured_from_true * drive(i).first, drive(i).second);
  return check.verdict(Vector3d::UnitZ(), Vector3d::UnitY());
}

TEST(AxisMap, PrintsAndParsesEachOfThem) {
  EXPECT_EQ(allAxisMaps().size(), 48U);
  for (const Matrix3d& map : allAxisMaps()) {
    EXPECT_TRUE((map * map.transpose()).isIdentity());
    const auto parsed = parseAxisMap(printAxisMap(map));
    ASSERT_TRUE(parsed) << printAxisMap(map);
    EXPECT_EQ(*parsed, map);
  }
  EXPECT_EQ(parseAxisMap("y,-z,x")->row(1), Eigen::RowVector3d(0.0, 0.0, -1.0));
}

TEST(AxisMap, RefusesWhatIsNone) {
  for (const char* text :
       {"", "x", "x,y", "x,y,y", "x,y,z,x", "x,y,z,", "x,y,w", "+x,y,z", "--x,y,z", "x y z", ",,", "-,y,z"})
    EXPECT_FALSE(parseAxisMap(text)) << text;
}

TEST(AccelerometerCheck, FindsNothingWrongWithASoundOne) {
  EXPECT_TRUE(examine(Matrix3d::Identity()).sound());
  EXPECT_EQ(examine(Matrix3d::Identity()).sentence(), "");
  EXPECT_TRUE(AccelerometerCheck().verdict(Vector3d::UnitZ(), Vector3d::UnitY()).sound()) << "no messages";
  const Matrix3d tilted = Eigen::AngleAxisd(0.5, Vector3d::UnitX()).toRotationMatrix();
  EXPECT_TRUE(examine(tilted).sound()) << "a steep street";
}

TEST(AccelerometerCheck, DetectsEachCommonConvention) {
  for (const char* axes : {"-x,-y,-z", "y,z,x", "z,x,y", "z,y,x", "x,z,y", "x,-y,-z"}) {
    const Matrix3d repair = *parseAxisMap(axes);
    const AccelerometerVerdict verdict = examine(repair.transpose());
    EXPECT_EQ(verdict.fault, AccelerometerFault::Direction) << axes;
    ASSERT_TRUE(verdict.repair) << axes;
    const Vector3d restored = verdict.repair->axes * repair.transpose() * Vector3d(0.0, 1.0, 9.81);
    EXPECT_LT((restored - Vector3d(0.0, 1.0, 9.81)).norm(), 1e-9) << axes << ": " << printAxisMap(verdict.repair->axes);
  }
  EXPECT_EQ(printAxisMap(examine(-Matrix3d::Identity()).repair->axes), "-x,-y,-z");
  EXPECT_NE(examine(-Matrix3d::Identity()).sentence().find("NED"), std::string::npos);
  EXPECT_NEAR(examine(-Matrix3d::Identity()).angle, M_PI, 0.05);
}

TEST(AccelerometerCheck, DetectsUnitsAndRemovedGravity) {
  const AccelerometerVerdict in_g = examine(Matrix3d::Identity() / 9.80665);
  EXPECT_EQ(in_g.fault, AccelerometerFault::Unit);
  EXPECT_NEAR(in_g.repair->scale, 9.80665, 1e-9);
  EXPECT_TRUE(in_g.repair->axes.isIdentity());
  const AccelerometerVerdict down_in_g = examine(-Matrix3d::Identity() / 9.80665);
  EXPECT_NEAR(down_in_g.repair->scale, 9.80665, 1e-9);
  EXPECT_EQ(printAxisMap(down_in_g.repair->axes), "-x,-y,-z");
  EXPECT_NEAR(examine(1000.0 * Matrix3d::Identity()).repair->scale, 0.001, 1e-9);
  EXPECT_EQ(examine(1.4 * Matrix3d::Identity()).fault, AccelerometerFault::Size);
  AccelerometerCheck without;
  for (int i = 0; i < 500; ++i) without.add(drive(i).first - 9.81 * Vector3d::UnitZ(), drive(i).second);
  EXPECT_EQ(without.verdict(Vector3d::UnitZ(), Vector3d::UnitY()).fault, AccelerometerFault::NoGravity);
}

TEST(AccelerometerCheck, CountsFiniteMeasurementsAlone) {
  AccelerometerCheck check;
  for (int i = 0; i < 100; ++i) check.add(Vector3d(kNan, 0.0, -9.81), Vector3d::Zero());
  EXPECT_EQ(check.verdict(Vector3d::UnitZ(), Vector3d::UnitY()).fault, AccelerometerFault::NotFinite);
  check.add(Vector3d(0.0, 0.0, -9.81), Vector3d(kNan, kNan, kNan));
  const AccelerometerVerdict verdict = check.verdict(Vector3d::UnitZ(), Vector3d::UnitY());
  EXPECT_EQ(verdict.fault, AccelerometerFault::Direction) << "the first finite one counts";
  EXPECT_EQ(printAxisMap(verdict.repair->axes), "-x,-y,-z");
}

TEST(AccelerometerCheck, ADeviceThatTurnsOverHasNoMeanDirection) {
  AccelerometerCheck check;
  for (int i = 0; i < 1000; ++i)
    check.add(9.81 * Vector3d(std::sin(0.01 * i), 0.0, -std::cos(0.01 * i)), Vector3d::Zero());
  EXPECT_TRUE(check.verdict(Vector3d::UnitZ(), Vector3d::UnitY()).sound());
}

}  // namespace
}  // namespace urban_nav_core
