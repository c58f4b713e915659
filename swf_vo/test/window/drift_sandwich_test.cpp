// SPDX-License-Identifier: BSD-3-Clause
// Ratio of the drift's variance to that of the model: scores of known variance, and tracks with drifting landmarks.
#include "window/drift_sandwich.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>
#include <random>

#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "window/filter.hpp"
#include "window/track_runner.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Matrix6d;
using urban_nav_core::OdometryChain;
using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;
using urban_nav_core::Vector6d;
using urban_nav_core::testing::TrackMotion;
using urban_nav_core::testing::Tracks;

/// Errors of landmarks: independent ones of `scale` times the stated standard deviation (translation, rotation); and
/// common ones of a surface, of `shared` standard deviations of a generation's estimate, for two generations.
struct Errors {
  double translation = 1.0, rotation = 1.0, shared = 0.0;
};

struct Generations {
  DriftSandwich sandwich;
  double squared = 0.0, stated = 0.0;  // each for the shift over two generations
};

/// Generations of landmarks on ten surfaces that measure one rate, which is estimated from them; their scores at the
/// estimate.
Generations generations(int count, int landmarks, const Errors& errors, const DriftSandwich& before = {}) {
  constexpr double kShiftWeight = 3.0, kTurnWeight = 200.0;
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  struct Surface {
    Eigen::Vector2d direction;
    Vector6d error;
  };
  std::array<Surface, 10> surfaces;
  Generations result;
  result.sandwich = before;
  Vector6d off = Vector6d::Zero();
  for (int g = 0; g < count; ++g) {
    if (g % 2 == 0)
      for (Surface& surface : surfaces) {
        surface.direction = Eigen::Vector2d(0.5 * normal(generator), 0.3 * normal(generator));
        for (int i = 0; i < 6; ++i)
          surface.error[i] =
              normal(generator) * errors.shared / ((i < 3 ? kShiftWeight : kTurnWeight) * std::sqrt(1.5 * landmarks));
      }
    std::vector<DriftScore> scores(static_cast<std::size_t>(landmarks));
    Matrix6d all = Matrix6d::Zero();
    Vector6d sum = Vector6d::Zero();
    for (std::size_t k = 0; k < scores.size(); ++k) {
      DriftScore& one = scores[k];
      const Surface& surface = surfaces[k % surfaces.size()];
      Eigen::Matrix<double, 6, 3> J;
      for (int i = 0; i < 18; ++i) J(i % 6, i / 6) = normal(generator) * (i % 6 < 3 ? kShiftWeight : kTurnWeight);
      // Half of the landmarks measure the translation only, half the rotation only.
      const bool moved = normal(generator) > 0.0;
      if (moved) J.bottomRows<3>().setZero();
      else J.topRows<3>().setZero();
      Eigen::Vector3d error;
      for (int i = 0; i < 3; ++i) error[i] = normal(generator) * (moved ? errors.translation : errors.rotation);
      one.information = J * J.transpose();
      one.score = J * error + one.information * surface.error;
      one.direction = surface.direction + 0.02 * Eigen::Vector2d(normal(generator), normal(generator));
      one.life = 0.5;
      all += one.information;
      sum += one.score;
    }
    const Vector6d estimate = all.ldlt().solve(sum);
    off += estimate;
    result.stated += all.inverse().topLeftCorner<3, 3>().trace();
    if (g % 2 == 1) {
      result.squared += off.head<3>().squaredNorm();
      off.setZero();
    }
    result.sandwich.advance(0.5);
    for (DriftScore& one : scores) {
      one.score -= one.information * estimate;
      result.sandwich.add(one);
    }
  }
  return result;
}

DriftSandwich::Ratio learnt(int count, int landmarks, const Errors& errors) {
  return generations(count, landmarks, errors).sandwich.ratio();
}

TEST(DriftSandwich, IsOneWhereTheModelIsRight) {
  const DriftSandwich::Ratio ratio = learnt(60, 60, {});
  EXPECT_NEAR(ratio.translation, 1.0, 0.25);
  EXPECT_NEAR(ratio.rotation, 1.0, 0.25);
}

TEST(DriftSandwich, CorrectsForLeverage) {
  // Three unknowns from six landmarks: residuals have half of the variance.
  const DriftSandwich::Ratio ratio = learnt(300, 12, {});
  EXPECT_NEAR(ratio.translation, 1.0, 0.3);
  EXPECT_NEAR(ratio.rotation, 1.0, 0.3);
}

TEST(DriftSandwich, DistinguishesTranslationFromRotation) {
  const DriftSandwich::Ratio ratio = learnt(60, 60, {2.0, 0.7});
  EXPECT_NEAR(ratio.translation, 4.0, 1.0);
  EXPECT_NEAR(ratio.rotation, 0.49, 0.15);
}

TEST(DriftSandwich, ContainsErrorsCommonToASurface) {
  const Generations shared = generations(400, 60, {1.0, 1.0, 6.0});
  const double truth = shared.squared / shared.stated;
  EXPECT_GT(truth, 4.0);
  EXPECT_NEAR(std::log(shared.sandwich.ratio().translation / truth), 0.0, std::log(2.0));
}

TEST(DriftSandwich, FewLandmarksLeaveTheModelAsItIs) {
  EXPECT_EQ(DriftSandwich().ratio().translation, 1.0);
  EXPECT_EQ(DriftSandwich().ratio().rotation, 1.0);
  const DriftSandwich few = generations(1, 6, {3.0, 3.0}).sandwich, many = generations(100, 60, {3.0, 3.0}).sandwich;
  EXPECT_LT(few.clusters(1), 4.0);
  EXPECT_GT(many.clusters(1), 30.0);
  EXPECT_NEAR(many.ratio().rotation, 9.0, 2.5);
}

TEST(DriftSandwich, DecaysAsTheViewChanges) {
  const DriftSandwich before = generations(60, 60, {3.0, 3.0}).sandwich;
  DriftSandwich standing = before;
  standing.advance(0.0);
  EXPECT_EQ(standing.ratio().rotation, before.ratio().rotation);
  EXPECT_LT(generations(60, 60, {}, before).sandwich.ratio().rotation, 0.3 * before.ratio().rotation);
}

/// Tracks whose landmarks drift over their surfaces, each at a constant rate with this standard deviation, equally in
/// both images.
Tracks drifting(double px_a_frame, TrackMotion motion, std::uint64_t seed, int frames = 301) {
  urban_nav_core::testing::TrackOptions options;
  options.seed = seed;
  options.frames = frames;
  options.motion = motion;
  options.features = 30;
  Tracks tracks = simulateTracks(options);
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0.0, px_a_frame);
  struct Born {
    std::size_t frame;
    Eigen::Vector3d rate;
  };
  std::map<std::int64_t, Born> born;
  for (std::size_t i = 0; i < tracks.frames.size(); ++i)
    for (auto& sighting : tracks.frames[i].sightings) {
      auto found = born.find(sighting.landmark);
      if (found == born.end()) {
        const double u = normal(generator), v = normal(generator);
        found = born.emplace(sighting.landmark, Born{i, {u, v, u}}).first;
      }
      sighting.z += static_cast<double>(i - found->second.frame) * found->second.rate;
    }
  return tracks;
}

OdometryChain odometry(const Tracks& tracks, bool robust, const std::function<bool(const Observation&)>& wanted = {}) {
  WindowOptions options;
  options.exact_undo = false;
  options.robust_drift = robust;
  TrackRunner run(tracks, options);
  while (!run.done()) run.step(wanted);
  OdometryChain chain;
  for (std::size_t i = 1; i < run.settled.size(); ++i) {
    urban_nav_core::RelativePose step;
    step.from = run.settled[i - 1].frame + 1;
    step.to = run.settled[i].frame + 1;
    step.T_from_to = run.settled[i].T_previous_camera;
    step.covariance = run.settled[i].relative_covariance;
    step.drift_covariance = run.settled[i].drift_covariance;
    EXPECT_TRUE(chain.append(step));
  }
  return chain;
}

/// Squares over stated variances, for translation and rotation.
struct Ratios {
  double squared[2] = {}, stated[2] = {};
  void add(const Vector6d& error, const Matrix6d& covariance) {
    for (int part = 0; part < 2; ++part) {
      squared[part] += error.segment<3>(3 * part).squaredNorm();
      stated[part] += covariance.block<3, 3>(3 * part, 3 * part).trace();
    }
  }
  double translation() const { return squared[0] / stated[0]; }
  double rotation() const { return squared[1] / stated[1]; }
};

constexpr int kSettledFrame = 100, kLag = 50, kWaysEnd = 290;

Ratios againstTruth(double px_a_frame, TrackMotion motion, bool robust) {
  Ratios ratios;
  for (std::uint64_t seed = 40; seed < 48; ++seed) {
    const Tracks tracks = drifting(px_a_frame, motion, seed);
    const OdometryChain chain = odometry(tracks, robust);
    for (int i = kSettledFrame; i + kLag < kWaysEnd; i += 10) {
      const PoseWithCovariance way = *chain.between(i + 1, i + kLag + 1);
      const auto at = [&](int frame) { return tracks.frames[static_cast<std::size_t>(frame)].T_world_camera; };
      ratios.add(urban_nav_core::boxMinus(at(i).inverse() * at(i + kLag), way.pose), way.covariance);
    }
  }
  return ratios;
}

TEST(DriftSandwich, FindsTheDriftOfLandmarksThatDrift) {
  for (const TrackMotion motion : {TrackMotion::Turning, TrackMotion::Straight}) {
    EXPECT_GT(againstTruth(0.03, motion, false).rotation(), 2.5);
    EXPECT_NEAR(std::log(againstTruth(0.03, motion, true).rotation()), 0.0, std::log(2.0));
  }
}

TEST(DriftSandwich, LeavesTheDriftOfLandmarksThatKeepStill) {
  for (const TrackMotion motion : {TrackMotion::Turning, TrackMotion::Straight}) {
    const Ratios ratios = againstTruth(0.0, motion, true);
    EXPECT_NEAR(std::log(ratios.translation()), 0.0, std::log(2.0));
    EXPECT_NEAR(std::log(ratios.rotation()), 0.0, std::log(2.0));
  }
}

// Two filters, each with every other landmark, have independent errors, so their difference needs no ground truth.
TEST(DriftSandwich, AgreesWithTheJackknifeOfOddAndEvenLandmarks) {
  const auto between = [](bool robust) {
    Ratios ratios;
    for (std::uint64_t seed = 50; seed < 58; ++seed) {
      const Tracks tracks = drifting(0.03, TrackMotion::Turning, seed);
      const OdometryChain odd = odometry(tracks, robust, [](const Observation& o) { return o.landmark % 2 == 1; });
      const OdometryChain even = odometry(tracks, robust, [](const Observation& o) { return o.landmark % 2 == 0; });
      for (int i = kSettledFrame; i + kLag < kWaysEnd; i += 10) {
        const PoseWithCovariance a = *odd.between(i + 1, i + kLag + 1), b = *even.between(i + 1, i + kLag + 1);
        ratios.add(urban_nav_core::boxMinus(a.pose, b.pose), a.covariance + b.covariance);
      }
    }
    return ratios;
  };
  const Ratios model = between(false), robust = between(true);
  EXPECT_GT(model.rotation(), 2.5);
  EXPECT_NEAR(std::log(robust.rotation()), 0.0, std::log(2.0));
  EXPECT_NEAR(std::log(robust.translation()), 0.0, std::log(2.5));
}

TEST(DriftSandwich, ChangesNoPose) {
  const Tracks tracks = drifting(0.02, TrackMotion::Turning, 3, 120);
  const OdometryChain model = odometry(tracks, false), robust = odometry(tracks, true);
  for (std::int64_t i = 1; i < 100; ++i) {
    EXPECT_EQ(model.at(i)->t(), robust.at(i)->t()) << i;
    EXPECT_EQ(model.at(i)->q().coeffs(), robust.at(i)->q().coeffs()) << i;
  }
}

}  // namespace
}  // namespace swf_vo
