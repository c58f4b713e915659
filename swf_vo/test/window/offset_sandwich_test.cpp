// SPDX-License-Identifier: BSD-3-Clause
// Ratio of the variance of the disparity offset to that of its information: scores of known variance.
#include "window/offset_sandwich.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Vector6d;

constexpr double kCautionAlone = 400.0;

struct OffsetErrors {
  double each = 1.0;      ///< independent error of a measurement, standard deviations
  double shared = 0.0;    ///< error common to consecutive landmarks of one region, in standard deviations of one
                          ///< landmark
  bool drifting = false;  ///< the camera drifts by some standard deviations, not followed by the estimate
};

/// Landmarks that measure a drift of the camera and the offset by rows of Gaussian random numbers.
OffsetSandwich learnOffset(int landmarks, const OffsetErrors& errors) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  OffsetSandwich sandwich;
  Vector6d drift = Vector6d::Zero();
  if (errors.drifting)
    for (int i = 0; i < 6; ++i) drift[i] = 0.1 * normal(generator);
  double shared[40] = {};
  for (int k = 0; k < landmarks; ++k) {
    if (k % 400 == 0)
      for (double& each : shared) each = errors.shared * normal(generator);
    Eigen::Matrix<double, 7, 12> J;
    for (int i = 0; i < J.size(); ++i) J(i % 7, i / 7) = normal(generator);
    // The offset is largely correlated with a drift.
    J.row(6) = 0.3 * J.row(6) + J.row(0) - 2.0 * J.row(4);
    Eigen::Matrix<double, 12, 1> r;
    for (int i = 0; i < 12; ++i) r[i] = errors.each * normal(generator);
    r += J.topRows<6>().transpose() * drift;
    const int place = k % 40;
    r += 0.3 * shared[place] * J.row(6).transpose();
    DriftScore one;
    const Eigen::Matrix<double, 7, 7> information = J * J.transpose();
    const Eigen::Matrix<double, 7, 1> score = J * r;
    one.information = information.topLeftCorner<6, 6>();
    one.offset_cross = information.topRightCorner<6, 1>();
    one.offset_information = information(6, 6);
    one.score = score.head<6>();
    one.offset_score = score[6];
    one.life = 0.5;
    one.direction = {0.125 + 0.25 * (place % 8 - 4), 0.125 + 0.25 * (place / 8 - 2)};
    sandwich.advance(0.01);
    sandwich.add(one);
  }
  return sandwich;
}

TEST(OffsetSandwich, IsAsTakenBeforeLandmarksHaveDied) {
  EXPECT_EQ(OffsetSandwich().ratio(kCautionAlone), kCautionAlone);
}

TEST(OffsetSandwich, GoesToOneWhereTheModelIsRight) {
  const OffsetSandwich sandwich = learnOffset(4000, {});
  // Forty regions with correlated landmarks: the weight of the default is 4 to 40.
  EXPECT_LT(sandwich.ratio(kCautionAlone), 4.0);
  EXPECT_NEAR(sandwich.ratio(1.0), 1.0, 0.3);
  EXPECT_GT(learnOffset(30, {}).ratio(kCautionAlone), sandwich.ratio(kCautionAlone));
}

TEST(OffsetSandwich, FollowsTheVarianceOfErrors) {
  const double one = learnOffset(4000, {}).ratio(1.0), three = learnOffset(4000, {3.0}).ratio(1.0);
  EXPECT_NEAR(std::log(three / one) / std::log(9.0), 1.0, 0.15);
}

TEST(OffsetSandwich, ContainsErrorsCommonToAPlace) {
  const double alone = learnOffset(4000, {}).ratio(1.0), shared = learnOffset(4000, {1.0, 2.0}).ratio(1.0);
  EXPECT_GT(shared, 3.0 * alone);
}

TEST(OffsetSandwich, IsBlindToTheDriftOfTheCamera) {
  const double still = learnOffset(4000, {}).ratio(1.0), drifting = learnOffset(4000, {1.0, 0.0, true}).ratio(1.0);
  EXPECT_NEAR(std::log(drifting / still), 0.0, std::log(1.5));
}

/// Errors of the offset relative to the stated ones, in windows with a wrong calibrated offset.
struct StatedOffsets {
  double squared = 0.0, stated = 0.0;
};

StatedOffsets statedOffsets(bool robust) {
  StatedOffsets sums;
  for (std::uint64_t seed = 60; seed < 72; ++seed) {
    urban_nav_core::testing::TrackOptions motion = mixedMotion(241, 0.1, seed);
    motion.features = 60;
    auto tracks = simulateTracks(motion);
    std::mt19937_64 generator(seed);
    const double offset = std::normal_distribution<double>(0.0, 0.03)(generator);
    for (auto& frame : tracks.frames)
      for (auto& sighting : frame.sightings) sighting.z.z() -= offset;
    WindowOptions options;
    options.exact_undo = false;
    options.disparity_offset = 0.1;
    options.robust_drift = robust;
    TrackRunner run(tracks, options);
    while (!run.done()) run.step();
    const double error = run.window.disparityOffset() - offset, sigma = run.window.disparityOffsetSigma();
    sums.squared += error * error;
    sums.stated += sigma * sigma;
  }
  return sums;
}

// Without model errors, the estimate is far more accurate than its reduced information.
TEST(OffsetSandwich, StatesTheAccuracyOfTheOffset) {
  const StatedOffsets model = statedOffsets(false), robust = statedOffsets(true);
  EXPECT_EQ(model.squared, robust.squared);
  EXPECT_LT(model.squared / model.stated, 0.5);
  EXPECT_LT(robust.stated, 0.7 * model.stated);
  EXPECT_LT(robust.squared / robust.stated, 2.5);
}

}  // namespace
}  // namespace swf_vo
