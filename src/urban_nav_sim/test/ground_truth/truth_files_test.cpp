// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth/truth_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "proprioception/schedule.hpp"
#include "proprioception/test_motion.hpp"
#include "ray_tracing/small_worlds.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

using urban_nav_core::CsvTable;
using urban_nav_core::Trajectory;

constexpr urban_nav_core::StampNs kTruthBegin = 1225719873'000000000;

class TruthFiles : public ::testing::Test {
 protected:
  TruthFiles() : folder_(std::filesystem::path(::testing::TempDir()) / "urban_nav_sim_truth") {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~TruthFiles() override { std::filesystem::remove_all(folder_); }

  void write(double false_percent) { writeTruthFiles(folder_.string(), *motion_, exact_, ladybug_, false_percent, 7); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
  std::unique_ptr<Motion> motion_ = testMotion(150.0);
  Clock exact_{kTruthBegin, ClockOptions{}, Noise(7, "truth")};
  Clock ladybug_{kTruthBegin, correctedClock(Sensor::Ladybug), Noise(7, "ladybug")};
};

TEST_F(TruthFiles, TrajectoryIsTheRideAt200Hz) {
  write(0.0);
  const Trajectory trajectory = urban_nav_core::readTum(path("trajectory.tum"));
  ASSERT_EQ(trajectory.size(), 30011U);
  for (std::size_t k = 1; k < trajectory.size(); ++k) EXPECT_EQ(trajectory[k].stamp - trajectory[k - 1].stamp, 5000000);
  EXPECT_EQ(trajectory.front().stamp, kTruthBegin);
  EXPECT_TRUE(isApprox(trajectory[2000].pose, motion_->at(10.0).T_world_base, 1e-9));
}

TEST_F(TruthFiles, RevisitsAreAtTheStampsOfPanoramas) {
  write(0.0);
  const CsvTable table = CsvTable::read(path("revisits.csv"));
  EXPECT_EQ(table.header(), (std::vector<std::string>{"stamp_a_ns", "stamp_b_ns", "distance_m", "heading_deg"}));
  EXPECT_GT(table.rows(), 500U);
  const Schedule schedule = sensorSchedule(Sensor::Ladybug);
  std::set<urban_nav_core::StampNs> stamps;
  for (std::int64_t k = 0; k < schedule.count(150.0); ++k) stamps.insert(ladybug_.stamp(k, schedule.at(k)));
  for (std::size_t row = 0; row < table.rows(); row += 17) {
    EXPECT_EQ(stamps.count(table.integer(row, 0)), 1U);
    EXPECT_EQ(stamps.count(table.integer(row, 1)), 1U);
    const auto at = [&](std::size_t column) {
      return motion_->at(1e-9 * static_cast<double>(table.integer(row, column) - kTruthBegin)).T_world_base;
    };
    EXPECT_NEAR(table.number(row, 2), urban_nav_core::distanceBetween(at(0), at(1)), 0.01);
  }
}

TEST_F(TruthFiles, FalseClosuresAreTheShareThatIsAskedFor) {
  write(20.0);
  const CsvTable right = CsvTable::read(path("closures_true.csv")), wrong = CsvTable::read(path("closures_false.csv"));
  EXPECT_EQ(right.header(),
            (std::vector<std::string>{"session_a", "stamp_a_ns", "session_b", "stamp_b_ns", "probability"}));
  EXPECT_EQ(wrong.header(), right.header());
  ASSERT_GT(right.rows(), 50U);
  EXPECT_NEAR(static_cast<double>(wrong.rows()), 0.2 * static_cast<double>(right.rows()), 0.51);
}

TEST_F(TruthFiles, FileOfFalseClosuresIsThereOnlyIfAskedFor) {
  write(20.0);
  write(0.0);
  EXPECT_TRUE(std::filesystem::exists(path("closures_true.csv")));
  EXPECT_FALSE(std::filesystem::exists(path("closures_false.csv")));
}

TEST_F(TruthFiles, ShortSessionsHaveEmptyTables) {
  motion_ = testMotion(3.0);
  write(20.0);
  EXPECT_EQ(CsvTable::read(path("revisits.csv")).rows(), 0U);
  EXPECT_EQ(CsvTable::read(path("closures_true.csv")).rows(), 0U);
  EXPECT_EQ(CsvTable::read(path("closures_false.csv")).rows(), 0U);
}

TEST_F(TruthFiles, ErrorsOfImuAndWheelsAreWrittenAtTheTrueTimes) {
  motion_ = testMotion(3.0);
  ImuOptions options;
  options.scale_sigma = 0.01;
  const Imu imu(*motion_, urban_nav_core::Pose(), options, exact_, Noise(7, "imu"));
  writeImuErrors(folder_.string(), imu, exact_, 3.0);
  const CsvTable biases = CsvTable::read(path("imu.csv"));
  EXPECT_EQ(biases.header(), (std::vector<std::string>{"stamp_ns", "bx", "by", "bz", "ax", "ay", "az"}));
  ASSERT_EQ(biases.rows(), 299U);
  for (std::size_t row = 0; row < biases.rows(); row += 60) {
    const double t = 1e-9 * static_cast<double>(biases.integer(row, 0) - kTruthBegin);
    EXPECT_NEAR(t, sensorSchedule(Sensor::Imu).at(static_cast<std::int64_t>(row)), 1e-9);
    EXPECT_NEAR(biases.number(row, 2), imu.rateBias(t).y(), 1e-9);
    EXPECT_NEAR(biases.number(row, 6), imu.forceBias(t).z(), 1e-9);
  }
  const CsvTable matrices = CsvTable::read(path("imu_scale.csv"));
  ASSERT_EQ(matrices.rows(), 2U);
  EXPECT_NEAR(matrices.number(1, 2), imu.forceMatrix()(0, 1), 1e-9);
  const Wheels wheels(*motion_, WheelOptions(), exact_, Noise(7, "wheels"));
  writeWheelErrors(folder_.string(), wheels, exact_);
  const CsvTable errors = CsvTable::read(path("wheels.csv"));
  EXPECT_EQ(errors.header(),
            (std::vector<std::string>{"stamp_ns", "left_scale", "right_scale", "slip_left", "slip_right"}));
  ASSERT_EQ(static_cast<std::int64_t>(errors.rows()), wheels.count());
  EXPECT_NEAR(errors.number(5, 3), wheels.errorsAt(5).slip_left, 1e-9);
}

TEST_F(TruthFiles, RingErrorsOfTheLidarAreWritten) {
  const World world = yard();
  const Tracer tracer(world);
  const Lidar3d lidar(tracer, urban_nav_core::Pose(), 7, LidarModel(), Lidar3d::Settings());
  writeLidarRings(path("lidar3d_rings.csv"), lidar);
  const CsvTable rings = CsvTable::read(path("lidar3d_rings.csv"));
  ASSERT_EQ(rings.rows(), 64U);
  EXPECT_NEAR(rings.number(0, 1), -25.0, 1e-6);
  EXPECT_NEAR(rings.number(9, 3), lidar.ringErrors()[9].range, 1e-6);
}

TEST_F(TruthFiles, ReportsTheFileThatCannotBeWritten) {
  std::filesystem::remove_all(folder_);
  EXPECT_THROW(write(0.0), urban_nav_core::UserError);
}

}  // namespace
}  // namespace urban_nav_sim
