// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/io/tum.hpp"

#include <cstring>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "io/reader_check.hpp"

namespace urban_nav_core {
namespace {

Trajectory someTrajectory() {
  std::mt19937 random(1);
  std::normal_distribution<double> n;
  Trajectory trajectory;
  for (int i = 0; i < 200; ++i) {
    trajectory.append(1225719873501685123 + StampNs{i} * 50000001,
                      Pose(expSo3({n(random), n(random), n(random)}), {n(random), 1e3 * n(random), 1e-9 * n(random)}));
  }
  return trajectory;
}

TEST(Tum, RoundTripIsExact) {
  const Trajectory trajectory = someTrajectory();
  const std::string text = printTum(trajectory);
  const Trajectory back = parseTum(text, "t.tum");
  ASSERT_EQ(back.size(), trajectory.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(back[i].stamp, trajectory[i].stamp);
    EXPECT_EQ(std::memcmp(&back[i].pose.q().coeffs(), &trajectory[i].pose.q().coeffs(), sizeof(double) * 4), 0);
    EXPECT_EQ(back[i].pose.t(), trajectory[i].pose.t());
  }
  EXPECT_EQ(printTum(back), text);
}

TEST(Tum, FilesRoundTripToo) {
  const std::string path = (std::filesystem::temp_directory_path() / "urban_nav_round_trip.tum").string();
  writeTum(path, someTrajectory());
  EXPECT_EQ(printTum(readTum(path)), printTum(someTrajectory()));
  std::filesystem::remove(path);
}

TEST(Tum, ReadsCommentsBlanksAndOtherStamps) {
  const Trajectory t = parseTum(
      "# stamp x y z qx qy qz qw\n\n  1.5 1 2 3\t0 0 0 1  # a comment\r\n1.403715273262142976e+09 1 2 3 0 0 0.6 0.8\n",
      "t");
  ASSERT_EQ(t.size(), 2U);
  EXPECT_EQ(t[0].stamp, 1500000000);
  EXPECT_TRUE(isApprox(t[0].pose, Pose(Quaterniond::Identity(), {1, 2, 3}), 0.0));
  EXPECT_NEAR(static_cast<double>(t[1].stamp - 1403715273262142976), 0.0, 300.0);
  EXPECT_EQ(t[1].pose.q().z(), 0.6);
}

TEST(Tum, PrintsItsLines) {
  Trajectory t;
  t.append(-500000000, Pose(Quaterniond::Identity(), {0.1, -2.0, 1e-10}));
  EXPECT_EQ(printTum(t), "-0.500000000 0.1 -2 1e-10 0 0 0 1\n");
}

TEST(Tum, NamesFileAndLine) {
  EXPECT_EQ(catchError([] { parseTum("1 1 2 3 0 0 0 1\n2 1 2 3 0 0 0\n", "t.tum"); }),
            "t.tum:2: 7 columns: expected 8: stamp x y z qx qy qz qw");
  EXPECT_EQ(catchError([] { parseTum("1 1 nan 3 0 0 0 1\n", "t.tum"); }),
            "t.tum:1: a number that is missing or not finite, or a quaternion of zeros: expected finite numbers");
  EXPECT_EQ(catchError([] { parseTum("x 1 1 3 0 0 0 1\n", "t.tum"); }), "t.tum:1: stamp x: expected seconds");
  EXPECT_EQ(catchError([] { parseTum("1 1 1 3 0 0 0 0\n", "t.tum"); }),
            "t.tum:1: a number that is missing or not finite, or a quaternion of zeros: expected finite numbers");
  EXPECT_EQ(catchError([] { parseTum("1 1 1 3 0 0 0 2\n", "t.tum"); }),
            "t.tum:1: a quaternion of length 2: expected length 1 (1 %)");
  EXPECT_EQ(catchError([] { parseTum("time,x,y,z\n1,2,3,4\n", "t.tum"); }),
            "t.tum:1: no column qx in the header time, x, y, z: expected stamp x y z qx qy qz qw");
  EXPECT_EQ(catchError([] { parseTum("1 1 1 3 0 0 0 1\n1 1 1 3 0 0 0 1\n", "t.tum"); }),
            "t.tum:2: stamp 1.000000000 is not later than the previous one");
  EXPECT_NE(catchError([] { readTum("/nowhere.tum"); }), "");
}

TEST(Tum, RepairsAreCounted) {
  TumRepairs repairs;
  const Trajectory sorted =
      parseTum("2 1 0 0 0 0 0 1\n1 2 0 0 0 0 0 1\n2 3 0 0 0 0 0 1\n3 4 0 0 0 0 0 1\n", "t.tum", &repairs);
  ASSERT_EQ(sorted.size(), 3U);
  EXPECT_EQ(sorted[0].pose.t().x(), 2.0);
  EXPECT_EQ(sorted[1].pose.t().x(), 1.0);  // the first of a stamp stays
  EXPECT_EQ(repairs.repeated, 1U);
  EXPECT_EQ(repairs.out_of_order, 1U);
  EXPECT_EQ(repairs.unit, 1.0);
  for (const auto& [stamp, unit] : std::vector<std::pair<std::string, double>>{
           {"1403715273262142976", 1e-9}, {"1403715273262142.976", 1e-6}, {"1403715273262.142976", 1e-3}}) {
    const Trajectory trajectory = parseTum(stamp + " 1 0 0 0 0 0 1\n", "t.tum", &repairs);
    EXPECT_NEAR(static_cast<double>(trajectory[0].stamp - 1403715273262142976), 0.0, 1000.0);
    EXPECT_EQ(repairs.unit, unit);
  }
}

/// Variants of the two poses that other programs write.
const std::vector<std::string> kVariants = {
    "1.5 1 2 3 0 0 0 1\n2.5 4 5 6 0 0 1 0\n",
    "\n# a comment of nine words that names no columns\n1.5\t1\t2\t3\t0\t0\t0\t1\n2.5\t4\t5\t6\t0\t0\t1\t0\n",
    "# timestamp tx ty tz qx qy qz qw\n1.5 1 2 3 0 0 0 1\n2.5 4 5 6 0 0 1 0\n",
    "stamp,x,y,z,qx,qy,qz,qw\n1.5,1,2,3,0,0,0,1\n2.5,4,5,6,0,0,1,0\n",
    "timestamp, qw, qx, qy, qz, px, py, pz\n1.5, 1, 0, 0, 0, 1, 2, 3\n2.5, 0, 0, 0, 1, 4, 5, 6\n",
    "1,5;1;2;3;0;0;0;1\n2,5;4;5;6;0;0;1;0\n",
    "1,5 1,0 2,0 3,0 0,0 0,0 0,0 1,0\r\n2,5 4,0 5,0 6,0 0,0 0,0 1,0 0,0\r\n",
    "sep=;\n1,5;1;2;3;0;0;0;1\n2,5;4;5;6;0;0;1;0\n",
    "1.5,1,2,3,0,0,0,1,\r2.5,4,5,6,0,0,1,0,\r",
    "\"time\",\"x\",\"y\",\"z\",\"qx\",\"qy\",\"qz\",\"qw\"\n\"1.5\",1,2,3,0,0,0,1\n2.5,4,5,6,0,0,1,0\n",
    "%time,field.header.seq,field.header.stamp,field.pose.position.x,field.pose.position.y,field.pose.position.z,"
    "field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,field.pose.orientation.w\n"
    "9,1,1.5,1,2,3,0,0,0,1\n10,2,2.5,4,5,6,0,0,1,0\n",
    "#timestamp [s], p_RS_R_x [mm], p_RS_R_y [cm], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], "
    "v_RS_R_x [m s^-1]\n1.5,1000,200,3,1,0,0,0,7\n2.5,4000,500,6,0,0,0,1,7\n",
    "stamp,x,y,z,qx,qy,qz,qw\n1.5,1,2,3,0,0,0,1\n2,nan,nan,nan,nan,nan,nan,nan\n2.1,,,,,,,\n2.2,0,0,0,0,0,0,0\n"
    "2.5,4,5,6,0,0,1,0\n"};

TEST(Tum, VariantsOfOneTableGiveEqualPoses) {
  for (const std::string& text : kVariants) {
    TumRepairs repairs;
    const Trajectory trajectory = parseTum(text, "t", &repairs);
    ASSERT_EQ(trajectory.size(), 2U) << text;
    EXPECT_EQ(trajectory[0].stamp, 1500000000) << text;
    EXPECT_EQ(trajectory[1].stamp, 2500000000) << text;
    EXPECT_TRUE(isApprox(trajectory[0].pose, Pose(Quaterniond::Identity(), {1, 2, 3}), 1e-12)) << text;
    EXPECT_TRUE(isApprox(trajectory[1].pose, Pose(Quaterniond(0, 0, 0, 1), {4, 5, 6}), 1e-12)) << text;
    EXPECT_EQ(repairs.not_finite, text == kVariants.back() ? 3U : 0U);
  }
}

TEST(Tum, EurocsOrderIsThatOfItsFormat) {
  TumRepairs repairs;
  const Trajectory trajectory =
      parseTum("1500000000,1,2,3,1,0,0,0,9,9,9\n2500000000,4,5,6,0,0,0,1,9,9,9\n", "t", &repairs, PoseOrder::Euroc);
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[1].stamp, 2500000000);
  EXPECT_EQ(trajectory[1].pose.q().z(), 1.0);
  EXPECT_EQ(trajectory[1].pose.t().z(), 6.0);
}

TEST(Tum, VariantsSurviveDamage) {
  expectSurvives(testing::fuzzText(kVariants, [](const std::string& text) {
    TumRepairs repairs;
    for (const StampedPose& each : parseTum(text, "t", &repairs)) {
      if (!each.pose.isFinite()) throw std::runtime_error("a pose that is not finite");
    }
  }));
}

TEST(Tum, Fuzzed) {
  expectSurvives(testing::fuzzText(
      {printTum(someTrajectory()).substr(0, 1500) + "\n", "# c\n1 1 2 3 0 0 0 1\n2.5 0 0 0 1 0 0 0\n"},
      [](const std::string& text) {
        for (const StampedPose& each : parseTum(text, "t")) {
          if (!each.pose.isFinite()) throw std::runtime_error("a pose that is not finite");
        }
      }));
}

}  // namespace
}  // namespace urban_nav_core
