// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation.hpp"

#include <gtest/gtest.h>

#include "support/folders.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {
namespace {

using testing::TemporaryFolder;
using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector6d;

Pose onCurve(int i) {
  Vector6d twist;
  twist << 0.1 * i, 0.0, 0.01 * i, 0.0, 0.0, 0.02 * i;
  return urban_nav_core::expSe3(twist);
}

Trajectory curve(std::int64_t shift_ns, double scale) {
  Trajectory trajectory;
  for (int i = 0; i < 60; ++i) {
    const Pose pose = onCurve(i);
    trajectory.append(1'000'000'000 + i * std::int64_t{100'000'000} + shift_ns, Pose(pose.q(), scale * pose.t()));
  }
  return trajectory;
}

TEST(Evaluation, findsNoErrorWhereThereIsNone) {
  const TemporaryFolder folder;
  urban_nav_core::writeTum(folder.file("a.tum"), curve(0, 1.0));
  const TrajectoryFile file = readTrajectory(folder.file("a.tum"));
  const Evaluation evaluation = evaluate(file, file, {}, {parseSpans({"10f", "1m"}), false});
  EXPECT_EQ(evaluation.matched.truth.size(), 60U);
  EXPECT_LT(evaluation.first.rmse, 1e-12);
  EXPECT_LT(evaluation.ten_frames->percent, 1e-9);
  EXPECT_EQ(evaluation.spans.size(), 2U);
  EXPECT_FALSE(evaluation.nees);
}

TEST(Evaluation, seesAScale) {
  const TemporaryFolder folder;
  urban_nav_core::writeTum(folder.file("a.tum"), curve(0, 1.0));
  urban_nav_core::writeTum(folder.file("b.tum"), curve(0, 1.02));
  const Evaluation evaluation =
      evaluate(readTrajectory(folder.file("a.tum")), readTrajectory(folder.file("b.tum")), {}, {});
  EXPECT_NEAR(evaluation.ten_frames->percent, 2.0, 0.05);
  EXPECT_NEAR(evaluation.ten_frames->step_ratio, 1.02, 1e-6);
  EXPECT_LT(evaluation.sim3.rmse, 1e-9);
  EXPECT_GT(evaluation.se3.rmse, 1e-3);
}

TEST(Evaluation, ofTheEndIsOfTheLastPoseAloneSeenFromTheFirst) {
  const TemporaryFolder folder;
  const Trajectory truth = curve(0, 1.0);
  // Another world frame, and each pose but the first off by 0.3 m and 2 deg; only the last one's covariance may count.
  Trajectory estimate;
  std::vector<urban_nav_core::CovarianceRow> rows;
  Vector6d shift, off;
  shift << 5.0, -2.0, 1.0, 0.3, -0.2, 1.5;
  off << 0.0, 0.3, 0.0, 0.0, 0.0, 2.0 * M_PI / 180.0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Pose pose = i == 0 ? truth[i].pose : truth[i].pose * urban_nav_core::expSe3(off);
    estimate.append(truth[i].stamp, urban_nav_core::expSe3(shift) * pose);
    rows.push_back({truth[i].stamp, urban_nav_core::Health::Ok,
                    urban_nav_core::Matrix6d::Identity() * (i + 1 < truth.size() ? 1e6 : 0.01)});
  }
  urban_nav_core::writeTum(folder.file("a.tum"), truth);
  urban_nav_core::writeTum(folder.file("b.tum"), estimate);
  const Evaluation evaluation =
      evaluate(readTrajectory(folder.file("a.tum")), readTrajectory(folder.file("b.tum")), rows, {});
  EXPECT_NEAR(evaluation.end.m, 0.3, 1e-3);
  EXPECT_NEAR(evaluation.end.deg, 2.0, 1e-5);
  ASSERT_TRUE(evaluation.end.nees);
  EXPECT_NEAR(*evaluation.end.nees, (0.09 + std::pow(2.0 * M_PI / 180.0, 2)) / 0.01, 0.05);
  Json json = Json::object();
  addToJson(evaluation, json);
  EXPECT_NE(json.print().find("\"end\""), std::string::npos);
}

TEST(Evaluation, namesTheOffsetAndAppliesItIfAsked) {
  const TemporaryFolder folder;
  urban_nav_core::writeTum(folder.file("a.tum"), curve(0, 1.0));
  urban_nav_core::writeTum(folder.file("b.tum"), curve(1'000'000'000'000, 1.0));
  const TrajectoryFile truth = readTrajectory(folder.file("a.tum")), estimate = readTrajectory(folder.file("b.tum"));
  try {
    evaluate(truth, estimate, {}, {});
    FAIL() << "no stamp matches";
  } catch (const urban_nav_core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find("--find-offset"), std::string::npos) << error.what();
  }
  const Evaluation evaluation = evaluate(truth, estimate, {}, {{}, true});
  EXPECT_TRUE(evaluation.offset_applied);
  EXPECT_NEAR(1e-9 * static_cast<double>(evaluation.offset->offset), -1000.0, 0.2);
}

TEST(Evaluation, readsKittiLinesWithoutStamps) {
  const TemporaryFolder folder;
  std::vector<Pose> poses;
  for (int i = 0; i < 20; ++i) poses.push_back(onCurve(i));
  urban_nav_core::writeKitti(folder.file("a.txt"), poses);
  urban_nav_core::writeKitti(folder.file("b.kitti"), poses);
  EXPECT_LT(evaluate(readTrajectory(folder.file("a.txt")), readTrajectory(folder.file("b.kitti")), {}, {}).first.rmse,
            1e-12);
  poses.pop_back();
  urban_nav_core::writeKitti(folder.file("c.kitti"), poses);
  EXPECT_THROW(evaluate(readTrajectory(folder.file("a.txt")), readTrajectory(folder.file("c.kitti")), {}, {}),
               urban_nav_core::DataError);
  EXPECT_THROW(readTrajectory(folder.file("d.bin")), urban_nav_core::UserError);
  EXPECT_THROW(parseSpans({"10"}), urban_nav_core::UserError);
}

TEST(Evaluation, weighsErrorsByTheCovariance) {
  const TemporaryFolder folder;
  urban_nav_core::writeTum(folder.file("a.tum"), curve(0, 1.0));
  urban_nav_core::writeTum(folder.file("b.tum"), curve(0, 1.01));
  std::vector<urban_nav_core::CovarianceRow> rows;
  for (const urban_nav_core::StampedPose& pose : curve(0, 1.01))
    rows.push_back({pose.stamp, urban_nav_core::Health::Ok, 1e-4 * urban_nav_core::Matrix6d::Identity()});
  const Evaluation small =
      evaluate(readTrajectory(folder.file("a.tum")), readTrajectory(folder.file("b.tum")), rows, {});
  for (urban_nav_core::CovarianceRow& row : rows) row.covariance *= 4.0;
  const Evaluation large =
      evaluate(readTrajectory(folder.file("a.tum")), readTrajectory(folder.file("b.tum")), rows, {});
  ASSERT_TRUE(small.nees && large.nees);
  EXPECT_NEAR(small.nees->mean, 4.0 * large.nees->mean, 1e-9 * small.nees->mean);
}

}  // namespace
}  // namespace urban_nav
