// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/trajectory/errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace urban_nav_core {
namespace {

// Straight ahead along x, `step` metres a frame, turning by `turn` rad a frame about z.
std::vector<Pose> drive(int frames, double step, double turn) {
  std::vector<Pose> poses{Pose()};
  const Pose motion(expSo3({0, 0, turn}), {step, 0, 0});
  while (static_cast<int>(poses.size()) < frames) poses.push_back(poses.back() * motion);
  return poses;
}

std::vector<Pose> moved(const Pose& T, std::vector<Pose> poses) {
  for (Pose& pose : poses) pose = T * pose;
  return poses;
}

const Pose kElsewhere(expSo3({0.2, -0.3, 2.0}), {4, 5, 6});

TEST(AbsoluteError, OfHandMadeDistances) {
  const std::vector<Pose> truth(4);
  std::vector<Pose> estimate;
  for (const double x : {0.0, 1.0, 2.0, 5.0}) estimate.emplace_back(Quaterniond::Identity(), Vector3d(0, x, 0));
  const ErrorStatistics e = absoluteError(truth, estimate, TrajectoryAlignment::None);
  EXPECT_NEAR(e.rmse, std::sqrt(30.0 / 4.0), 1e-15);
  EXPECT_EQ(e.mean, 2.0);
  EXPECT_EQ(e.median, 1.5);
  EXPECT_EQ(e.max, 5.0);
  EXPECT_EQ(e.count, 4U);
  EXPECT_EQ(absoluteErrors(truth, estimate, TrajectoryAlignment::None), (std::vector<double>{0, 1, 2, 5}));
  EXPECT_EQ(absoluteError({}, {}, TrajectoryAlignment::Se3).count, 0U);
}

TEST(AbsoluteError, AlignmentsTakeAwayWhatTheyMay) {
  const auto truth = drive(50, 1.0, 0.05);
  const auto elsewhere = moved(kElsewhere, truth);
  EXPECT_GT(absoluteError(truth, elsewhere, TrajectoryAlignment::None).rmse, 1.0);
  EXPECT_LT(absoluteError(truth, elsewhere, TrajectoryAlignment::First).rmse, 1e-12);
  EXPECT_LT(absoluteError(truth, elsewhere, TrajectoryAlignment::Se3).rmse, 1e-12);
  const auto longer = drive(50, 1.1, 0.05);
  EXPECT_GT(absoluteError(truth, longer, TrajectoryAlignment::Se3).rmse, 0.1);
  EXPECT_LT(absoluteError(truth, longer, TrajectoryAlignment::Sim3).rmse, 1e-12);
}

TEST(RelativeError, OfAScaleIsItsPercentage) {
  const auto truth = drive(50, 1.0, 0.0), estimate = moved(kElsewhere, drive(50, 1.02, 0.0));
  const auto e = relativeError(truth, estimate, {Span::Unit::Frames, 10});
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->percent, 2.0, 1e-9);
  EXPECT_NEAR(e->deg_per_m, 0.0, 1e-9);
  EXPECT_NEAR(e->step_ratio, 1.02, 1e-12);
  EXPECT_EQ(e->count, 40U);
}

TEST(RelativeError, OfATurnIsDegreesPerMetre) {
  const auto truth = drive(30, 0.5, 0.0);
  const double degree = M_PI / 180.0;
  const auto e = relativeError(truth, drive(30, 0.5, 0.1 * degree), {Span::Unit::Frames, 10});
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->deg_per_m, 1.0 / 5.0, 1e-9);
  // ten chords of 0.5 m, each turned by 0.1 deg more than the last
  Pose end;
  for (int i = 0; i < 10; ++i) end = end * Pose(expSo3({0, 0, 0.1 * degree}), {0.5, 0, 0});
  EXPECT_NEAR(e->percent, 100.0 * (end.t() - Vector3d(5, 0, 0)).norm() / 5.0, 1e-9);
}

TEST(RelativeError, IsOfTheTruePathAlongABend) {
  const auto truth = drive(100, 1.0, 0.1), estimate = drive(100, 1.1, 0.1);
  const auto e = relativeError(truth, estimate, {Span::Unit::Frames, 20});
  const double chord = distanceBetween(truth[0], truth[20]);
  EXPECT_NEAR(e->percent, 100.0 * 0.1 * chord / 20.0, 1e-9);
}

TEST(RelativeError, LeavesStandingOut) {
  auto truth = drive(30, 1.0, 0.0);
  for (int i = 0; i < 30; ++i) truth.push_back(truth.back());
  const auto e = relativeError(truth, truth, {Span::Unit::Frames, 10});
  ASSERT_TRUE(e);
  EXPECT_EQ(e->count, 29U);  // the last that still moves begins at frame 28
  EXPECT_FALSE(relativeError(std::vector<Pose>(30), std::vector<Pose>(30), {Span::Unit::Frames, 10}));
  EXPECT_FALSE(relativeError(drive(10, 1, 0), drive(10, 1, 0), {Span::Unit::Frames, 10}));
}

TEST(RelativeError, SpansOfMetresReachTheirLength) {
  const auto truth = drive(101, 0.5, 0.0), estimate = drive(101, 0.51, 0.0);
  const auto e = relativeError(truth, estimate, {Span::Unit::Metres, 10});
  ASSERT_TRUE(e);
  EXPECT_EQ(e->count, 81U);
  EXPECT_NEAR(e->percent, 2.0, 1e-9);
}

TEST(Span, ParsesAndPrints) {
  EXPECT_EQ(parseSpan("10f")->unit, Span::Unit::Frames);
  EXPECT_EQ(parseSpan("100m")->length, 100.0);
  EXPECT_EQ(parseSpan("0.5m")->length, 0.5);
  for (const char* text : {"", "f", "10", "0f", "-1m", "1.5f", "nanm", "10 m", "10x", "1e300f"})
    EXPECT_FALSE(parseSpan(text)) << text;
  std::ostringstream out;
  out << *parseSpan("10f") << " " << *parseSpan("2.5m");
  EXPECT_EQ(out.str(), "10f 2.5m");
}

TEST(KittiSegments, OverNominalLengthsFromEveryTenthFrame) {
  const auto truth = drive(1001, 1.0, 0.0), estimate = drive(1001, 1.01, 0.0);
  const SegmentErrors e = kittiSegmentErrors(truth, estimate, {100, 800, 5000});
  ASSERT_EQ(e.by_length.size(), 3U);
  EXPECT_EQ(e.by_length[0].count, 91U);
  EXPECT_NEAR(e.by_length[0].percent, 1.0, 1e-9);
  EXPECT_EQ(e.by_length[1].count, 21U);
  EXPECT_EQ(e.by_length[2].count, 0U);
  EXPECT_EQ(e.by_length[2].percent, 0.0);
  EXPECT_EQ(e.all.count, 112U);
  EXPECT_NEAR(e.all.percent, 1.0, 1e-9);
}

TEST(KittiSegments, DegreesPerMetre) {
  const auto truth = drive(201, 1.0, 0.0), estimate = drive(201, 1.0, 0.001);
  const SegmentErrors e = kittiSegmentErrors(truth, estimate, {100});
  EXPECT_NEAR(e.all.deg_per_m, 0.001 * 180.0 / M_PI, 1e-9);
}

TEST(PathLength, AddsUp) {
  EXPECT_EQ(pathLength({}), 0.0);
  EXPECT_NEAR(pathLength(drive(11, 0.5, 0.3)), 5.0, 1e-12);
}

}  // namespace
}  // namespace urban_nav_core
