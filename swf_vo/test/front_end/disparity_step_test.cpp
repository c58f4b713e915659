// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/disparity_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace swf_vo {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

StereoCamera stepCamera() { return {{400.0, 400.0, 255.5, 191.5, 512, 384}, 0.3, 0.02}; }

/// Landmarks of earlier frames, as measured by a pair whose right camera was rotated about its y axis.
class DisplacedView {
 public:
  /// `shift`: increase of disparities at the image centre, px; `sigma`: of each pixel coordinate, px.
  DisplacedView(unsigned seed, int count, double shift, double sigma, const Pose& T_camera_odom) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::uniform_real_distribution<double> u(30.0, 480.0), v(30.0, 350.0), inverse(0.02, 0.3);
    const StereoCamera camera = stepCamera();
    tracks_.resize(static_cast<std::size_t>(count));
    for (Track& track : tracks_) {
      const Eigen::Vector3d p = camera.left.ray({u(random), v(random)}) / inverse(random);
      const Eigen::Vector3d z = *camera.project(T_camera_odom * p);
      track.seen = 3;
      Match match;
      match.track = &track;
      match.p_odom << p, 1.0;
      match.left.found = match.right.found = true;
      match.left.pixel = {z.x() + sigma * normal(random), z.y()};
      const double x = (z.x() - camera.left.cx) / camera.left.fx;
      match.right.pixel = {z.z() - (1.0 + x * x) * shift + sigma * normal(random), z.y()};
      matches.push_back(match);
    }
  }
  std::vector<Match> matches;

 private:
  std::vector<Track> tracks_;
};

const Pose kStepPlace(Eigen::Quaterniond(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY())), {0.1, 0.0, -0.4});

TEST(DisparityStep, IsExactWithoutNoise) {
  for (const double shift : {-1.4, 0.0, 0.3}) {
    const DisplacedView view(1, 60, shift, 0.0, kStepPlace);
    const DisparityStep step = DisparityStepMeter().measure(stepCamera(), kStepPlace, view.matches);
    EXPECT_NEAR(step.px, shift, 1e-9);
    EXPECT_GT(step.sigma_px, 0.0);
    EXPECT_EQ(step.landmarks, 60);
  }
}

TEST(DisparityStep, AnErrorOfThePlaceAlongTheAxisIsNoStep) {
  const Pose off(kStepPlace.q(), kStepPlace.t() + Eigen::Vector3d(0.0, 0.0, 0.02));
  const DisplacedView view(2, 100, -0.5, 0.0, kStepPlace);
  EXPECT_NEAR(DisparityStepMeter().measure(stepCamera(), off, view.matches).px, -0.5, 0.01);
}

TEST(DisparityStep, ItsErrorsAreAsLargeAsStated) {
  double squares = 0.0;
  const int runs = 400;
  for (unsigned seed = 1; seed <= runs; ++seed) {
    const DisplacedView view(seed, 80, 0.2, 0.1, kStepPlace);
    const DisparityStep step = DisparityStepMeter().measure(stepCamera(), kStepPlace, view.matches);
    squares += std::pow((step.px - 0.2) / step.sigma_px, 2);
  }
  // The larger of two variance estimates is used, so that the mean exceeds the true variance.
  EXPECT_GT(squares / runs, 0.5);
  EXPECT_LT(squares / runs, 1.3);
}

TEST(DisparityStep, ARollThatIsKnownIsNoStep) {
  constexpr double kRoll = 0.005;  // 0.8 px at the upper border
  DisplacedView view(6, 80, -0.4, 0.0, kStepPlace);
  const StereoCamera camera = stepCamera();
  for (Match& match : view.matches)
    match.right.pixel.x() += kRoll * (match.left.pixel.y() - camera.left.cy) * camera.left.fx / camera.left.fy;
  DisparityStepMeter meter;
  EXPECT_GT(std::abs(meter.measure(camera, kStepPlace, view.matches).px + 0.4), 1e-3);
  EXPECT_NEAR(meter.measure(camera, kStepPlace, view.matches, {0.0, kRoll}).px, -0.4, 1e-9);
}

// A scatter about the common value would contain the displacement that the parameters explain.
TEST(DisparityStep, TheStandardDeviationOfRowsIsThatAboutTheFit) {
  DisplacedView still(7, 80, 0.0, 0.0, kStepPlace), rolled(7, 80, 0.0, 0.0, kStepPlace);
  const StereoCamera camera = stepCamera();
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 0.1);
  for (std::size_t i = 0; i < still.matches.size(); ++i) {
    const double error = normal(random);
    still.matches[i].right.pixel.y() += error;
    rolled.matches[i].right.pixel.y() += error - 0.01 * (rolled.matches[i].right.pixel.x() - camera.left.cx);
  }
  DisparityStepMeter meter;
  const RowStep of_still = meter.measureRows(camera, still.matches, 0.0),
                of_rolled = meter.measureRows(camera, rolled.matches, 0.0);
  EXPECT_NEAR(of_rolled.turn.y() - of_still.turn.y(), 0.01, 2e-4);
  EXPECT_NEAR(of_rolled.sigma.y(), of_still.sigma.y(), 0.2 * of_still.sigma.y());
}

TEST(DisparityStep, MatchesOfSomethingElseHaveNoPart) {
  DisplacedView view(4, 80, -0.3, 0.05, kStepPlace);
  for (std::size_t i = 0; i < 20; ++i) view.matches[4 * i].right.pixel.x() += 7.0 + static_cast<double>(i);
  const DisparityStep step = DisparityStepMeter().measure(stepCamera(), kStepPlace, view.matches);
  EXPECT_NEAR(step.px, -0.3, 0.06);
  EXPECT_LE(step.landmarks, 61);
}

TEST(DisparityStep, OfTooFewIsNotMeasured) {
  DisplacedView view(5, 40, -0.3, 0.0, kStepPlace);
  for (std::size_t i = 0; i < 30; ++i) view.matches[i].right.found = false;
  EXPECT_EQ(DisparityStepMeter().measure(stepCamera(), kStepPlace, view.matches).sigma_px, 0.0);
  EXPECT_EQ(DisparityStepMeter().measure(stepCamera(), kStepPlace, {}).sigma_px, 0.0);
}

}  // namespace
}  // namespace swf_vo
