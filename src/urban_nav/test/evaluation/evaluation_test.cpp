// SPDX-License-Identifier: BSD-3-Clause
#include "evaluation/evaluation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <tuple>

#include "urban_nav_core/geometry/so3.hpp"
#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/tum.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/testing/folders.hpp"

namespace urban_nav {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Trajectory;
using urban_nav_core::Vector6d;
using urban_nav_input::testing::TemporaryFolder;

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

TEST(Evaluation, FindsNoErrorWhereThereIsNone) {
  const TemporaryFolder folder;
  urban_nav_core::writeTum(folder.file("a.tum"), curve(0, 1.0));
  const urban_nav_input::TrajectoryFile file = urban_nav_input::readTrajectory(folder.file("a.tum"));
  const Evaluation evaluation = evaluate(file, file, {}, {parseSpans({"10f", "1m"}), false});
  EXPECT_EQ(evaluation.matched.truth.size(), 60U);
  EXPECT_LT(evaluation.first.rmse, 1e-12);
  EXPECT_LT(evaluation.ten_frames->percent, 1e-9);
  EXPECT_EQ(evaluation.spans.size(), 2U);
  EXPECT_FALSE(evaluation.nees);
}

TEST(Evaluation, TurnsAnEstimateOfOpticalAxes) {
  const TemporaryFolder folder;
  Trajectory optical;
  std::vector<Pose> camera;
  const Pose C = Pose(urban_nav_core::Quaterniond(0.5, -0.5, 0.5, -0.5), urban_nav_core::Vector3d::Zero());
  for (const urban_nav_core::StampedPose& each : curve(0, 1.0)) {
    camera.push_back(C.inverse() * each.pose * C);
    optical.append(each.stamp, camera.back());
  }
  urban_nav_core::writeTum(folder.file("body.tum"), curve(0, 1.0));
  urban_nav_core::writeTum(folder.file("optical.tum"), optical);
  urban_nav_core::writeKitti(folder.file("truth.kitti"), camera);
  const urban_nav_input::TrajectoryFile body = urban_nav_input::readTrajectory(folder.file("body.tum")),
                                        other = urban_nav_input::readTrajectory(folder.file("optical.tum")),
                                        kitti = urban_nav_input::readTrajectory(folder.file("truth.kitti"));
  std::vector<urban_nav_core::CovarianceRow> rows;
  urban_nav_core::Matrix6d covariance = urban_nav_core::Matrix6d::Identity();
  covariance(2, 2) = 9.0;  // forward, of optical axes
  for (const urban_nav_core::StampedPose& each : optical)
    rows.push_back({each.stamp, urban_nav_core::Health::Ok, covariance});
  const Evaluation turned = evaluate(body, other, rows, {});
  EXPECT_EQ(turned.axes.axes, Axes::EstimateOptical);
  EXPECT_LT(turned.first.rmse, 1e-9);
  EXPECT_NEAR(turned.covariances.back()(0, 0), 9.0, 1e-9);
  EXPECT_EQ(evaluate(kitti, other, {}, {}).axes.axes, Axes::EstimateOptical);
  EXPECT_EQ(evaluate(other, body, {}, {}).axes.axes, Axes::TruthOptical);
  EXPECT_EQ(evaluate(kitti, body, {}, {}).axes.axes, Axes::Same);
  EXPECT_EQ(evaluate(body, body, {}, {}).axes.axes, Axes::Same);
}

TEST(Evaluation, RecognisesEveryExchangeOfAxes) {
  urban_nav_input::TrajectoryFile truth;
  truth.path = "truth.tum";
  for (int i = 0; i < 60; ++i) {
    const double t = 0.1 * i;
    const Pose pose(urban_nav_core::expSo3({0.05 * t, -0.08 * t, 0.4 * t}), {3.0 * t, t * t, 0.2 * t});
    truth.trajectory.append(urban_nav_core::StampNs{i} * 100'000'000, pose);
    truth.poses.push_back(pose);
  }
  const auto turned = [&truth](const urban_nav_core::Matrix3d& world, const urban_nav_core::Matrix3d& body) {
    const Pose W(world, {5.0, 6.0, 7.0}), B(body, {0.0, 0.0, 0.0});
    urban_nav_input::TrajectoryFile file;
    file.path = "estimate.tum";
    for (const urban_nav_core::StampedPose& each : truth.trajectory) {
      file.trajectory.append(each.stamp, W * each.pose * B);
      file.poses.push_back(W * each.pose * B);
    }
    return file;
  };
  using urban_nav_core::Matrix3d;
  const Matrix3d ned = Eigen::Vector3d(1.0, -1.0, -1.0).asDiagonal();
  Matrix3d quarter = Matrix3d::Zero();
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  for (const auto& [body, axes, word] :
       {std::make_tuple(ned, Axes::NedEnu, "NED"), std::make_tuple(quarter, Axes::Turned, "x = y, y = -x, z = z"),
        std::make_tuple(Matrix3d(ned * quarter), Axes::Turned, "x = -y, y = -x, z = -z")}) {
    const Evaluation evaluation = evaluate(truth, turned(ned * quarter, body), {}, {});
    EXPECT_EQ(evaluation.axes.axes, axes) << word;
    EXPECT_NE(describe(evaluation.axes).find(word), std::string::npos) << describe(evaluation.axes);
    EXPECT_LT(evaluation.first.rmse, 1e-9);
    EXPECT_LT(evaluation.ten_frames->deg_per_m, 1e-6);
  }
  EXPECT_EQ(evaluate(truth, turned(quarter, Matrix3d::Identity()), {}, {}).axes.axes, Axes::Same);
}

TEST(Evaluation, NeesAllowsForTheTruthsOwnError) {
  const TemporaryFolder folder;
  const Trajectory truth = curve(0, 1.0);
  std::vector<urban_nav_core::CovarianceRow> rows;
  for (const urban_nav_core::StampedPose& each : truth)
    rows.push_back({each.stamp, urban_nav_core::Health::Ok, 1e-12 * urban_nav_core::Matrix6d::Identity()});
  // Many draws of a truth with noise against an exact estimate: the mean must be 6.
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  const double m = 0.05, deg = 0.4, rad = deg * M_PI / 180.0;
  const urban_nav_input::TrajectoryFile estimate{"e", true, truth, {}, {}};
  double sum = 0.0;
  constexpr int kDraws = 400;
  for (int draw = 0; draw < kDraws; ++draw) {
    Trajectory noisy;
    for (const urban_nav_core::StampedPose& each : truth) {
      const auto vector = [&](double sigma) {
        return urban_nav_core::Vector3d(sigma * normal(random), sigma * normal(random), sigma * normal(random));
      };
      noisy.append(each.stamp, Pose(urban_nav_core::expSo3(vector(rad)) * each.pose.q(), each.pose.t() + vector(m)));
    }
    urban_nav_input::TrajectoryFile file{"t", true, noisy, {}, {}}, exact = estimate;
    for (const auto& each : noisy) file.poses.push_back(each.pose);
    for (const auto& each : truth) exact.poses.push_back(each.pose);
    sum += *evaluate(file, exact, rows, {{}, false, {m, deg}}).end.nees;
  }
  EXPECT_NEAR(sum / kDraws, 6.0, 0.7);  // four standard deviations of such a mean
}

TEST(Evaluation, ReadsEurocsGroundTruth) {
  const TemporaryFolder folder;
  std::ofstream(folder.file("data.csv"))
      << "#timestamp,p_RS_R_x [m],y,z,q_RS_w [],x,y,z,v_x\n"
      << "1403636580838555648,1,2,3,1,0,0,0,9\n1403636580838555648,1,2,3,1,0,0,0,9\n";
  const urban_nav_input::TrajectoryFile file = urban_nav_input::readTrajectory(folder.file("data.csv"));
  ASSERT_EQ(file.poses.size(), 1U);
  EXPECT_EQ(file.trajectory[0].stamp, 1403636580838555648);
  EXPECT_EQ(file.poses[0].t(), urban_nav_core::Vector3d(1.0, 2.0, 3.0));
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_NE(file.notes[0].find("1 poses left out"), std::string::npos);
}

TEST(Evaluation, DetectsAScale) {
  const TemporaryFolder folder;
  urban_nav_core::writeTum(folder.file("a.tum"), curve(0, 1.0));
  urban_nav_core::writeTum(folder.file("b.tum"), curve(0, 1.02));
  const Evaluation evaluation = evaluate(urban_nav_input::readTrajectory(folder.file("a.tum")),
                                         urban_nav_input::readTrajectory(folder.file("b.tum")), {}, {});
  EXPECT_NEAR(evaluation.ten_frames->percent, 2.0, 0.05);
  EXPECT_NEAR(evaluation.ten_frames->step_ratio, 1.02, 1e-6);
  EXPECT_LT(evaluation.sim3.rmse, 1e-9);
  EXPECT_GT(evaluation.se3.rmse, 1e-3);
}

TEST(Evaluation, OfTheEndIsThatOfTheLastPoseRelativeToTheFirst) {
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
  const Evaluation evaluation = evaluate(urban_nav_input::readTrajectory(folder.file("a.tum")),
                                         urban_nav_input::readTrajectory(folder.file("b.tum")), rows, {});
  EXPECT_NEAR(evaluation.end.m, 0.3, 1e-3);
  EXPECT_NEAR(evaluation.end.deg, 2.0, 1e-5);
  ASSERT_TRUE(evaluation.end.nees);
  EXPECT_NEAR(*evaluation.end.nees, (0.09 + std::pow(2.0 * M_PI / 180.0, 2)) / 0.01, 0.05);
  Json json = Json::object();
  addToJson(evaluation, json);
  EXPECT_NE(json.print().find("\"end\""), std::string::npos);
}

TEST(Evaluation, NamesTheOffsetAndAppliesItIfAsked) {
  const TemporaryFolder folder;
  urban_nav_core::writeTum(folder.file("a.tum"), curve(0, 1.0));
  urban_nav_core::writeTum(folder.file("b.tum"), curve(1'000'000'000'000, 1.0));
  const urban_nav_input::TrajectoryFile truth = urban_nav_input::readTrajectory(folder.file("a.tum")),
                                        estimate = urban_nav_input::readTrajectory(folder.file("b.tum"));
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

TEST(Evaluation, ReadsKittiLinesWithoutStamps) {
  const TemporaryFolder folder;
  std::vector<Pose> poses;
  for (int i = 0; i < 20; ++i) poses.push_back(onCurve(i));
  urban_nav_core::writeKitti(folder.file("a.txt"), poses);
  urban_nav_core::writeKitti(folder.file("b.kitti"), poses);
  EXPECT_LT(evaluate(urban_nav_input::readTrajectory(folder.file("a.txt")),
                     urban_nav_input::readTrajectory(folder.file("b.kitti")), {}, {})
                .first.rmse,
            1e-12);
  poses.pop_back();
  urban_nav_core::writeKitti(folder.file("c.kitti"), poses);
  EXPECT_THROW(evaluate(urban_nav_input::readTrajectory(folder.file("a.txt")),
                        urban_nav_input::readTrajectory(folder.file("c.kitti")), {}, {}),
               urban_nav_core::DataError);
  EXPECT_THROW(urban_nav_input::readTrajectory(folder.file("d.bin")), urban_nav_core::UserError);
  EXPECT_THROW(parseSpans({"10"}), urban_nav_core::UserError);
}

TEST(Evaluation, WeighsErrorsByTheCovariance) {
  const TemporaryFolder folder;
  urban_nav_core::writeTum(folder.file("a.tum"), curve(0, 1.0));
  urban_nav_core::writeTum(folder.file("b.tum"), curve(0, 1.01));
  std::vector<urban_nav_core::CovarianceRow> rows;
  for (const urban_nav_core::StampedPose& pose : curve(0, 1.01))
    rows.push_back({pose.stamp, urban_nav_core::Health::Ok, 1e-4 * urban_nav_core::Matrix6d::Identity()});
  const Evaluation small = evaluate(urban_nav_input::readTrajectory(folder.file("a.tum")),
                                    urban_nav_input::readTrajectory(folder.file("b.tum")), rows, {});
  for (urban_nav_core::CovarianceRow& row : rows) row.covariance *= 4.0;
  const Evaluation large = evaluate(urban_nav_input::readTrajectory(folder.file("a.tum")),
                                    urban_nav_input::readTrajectory(folder.file("b.tum")), rows, {});
  ASSERT_TRUE(small.nees && large.nees);
  EXPECT_NEAR(small.nees->mean, 4.0 * large.nees->mean, 1e-9 * small.nees->mean);
}

}  // namespace
}  // namespace urban_nav
