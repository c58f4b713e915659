// SPDX-License-Identifier: BSD-3-Clause
// A van ahead that drives off: a third of the features move consistently and must not bias the estimate.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "recordings.hpp"

namespace swf_vo {
namespace {

using urban_nav_core::Pose;
using urban_nav_core::Vector3d;
using urban_nav_core::testing::lookingAlong;
using urban_nav_core::testing::Motion;
using urban_nav_core::testing::RenderedSequence;
using urban_nav_core::testing::RoomSize;
using urban_nav_core::testing::Scene;
using urban_nav_core::testing::SequenceOptions;
using urban_nav_core::testing::straight;
using urban_nav_core::testing::texturedRoom;

constexpr double kAhead = 2.5, kVanWidth = 1.5, kVanHeight = 1.7,
                 kDepth = 1.0;  // m, distance of the van's rear from the camera at the start
constexpr int kMovingFrames = 45;

struct Drive {
  const char* name;
  double (*way)(double t, double own);  ///< motion of the van along the camera's axis, m; `own`: that of the camera
};
void PrintTo(const Drive& drive, std::ostream* out) { *out << drive.name; }

class Van : public ::testing::TestWithParam<Drive> {};

// Returns the share of features on the van's rear.
double shareOnTheVan(const Frame& frame, double distance) {
  const auto camera = roomCamera();
  const double half = camera.fx * 0.5 * kVanWidth / distance,
               top = camera.cy - camera.fy * (kVanHeight - 1.1) / distance;
  const auto on = std::count_if(frame.features.begin(), frame.features.end(), [&](const Feature& feature) {
    return std::abs(feature.pixel.x() - camera.cx) < half && feature.pixel.y() > top;
  });
  return static_cast<double>(on) / static_cast<double>(frame.features.size());
}

TEST_P(Van, DoesNotCarryTheEstimateAway) {
  const Pose start = lookingAlong({-RoomSize().freeX(), 0.0, 1.1}, 0.0);
  const Motion motion = straight(start, 0.5);
  const auto own = [&](double t) { return (start.inverse() * motion(t)).t().z(); };
  const Scene room = texturedRoom();
  const auto scene = [&](double t) {
    Scene now = room;
    const Vector3d rear = start.t() + Vector3d(kAhead + 0.5 * kDepth + GetParam().way(t, own(t)), 0.0, -1.1);
    now.addBox(Pose(Eigen::Quaterniond::Identity(), rear), {kDepth, kVanWidth, kVanHeight},
               room.rectangles.back().texture, 1.0);
    return now;
  };
  SequenceOptions options;
  options.camera = roomCamera();
  options.noise = 2.0;
  RenderedSequence sequence(scene, motion, options);
  SwfVo filter(Parameters(), stereoCamera(), Pose());
  for (int i = 0; i < kMovingFrames; ++i) {
    const Frame& now = filter.process(sequence.frame(i).pair());
    expectProper(now);
    const double t = sequence.time(i), gone = own(t);
    if (i == 20) {
      EXPECT_GT(shareOnTheVan(now, kAhead - gone), 0.3) << "otherwise the test is not significant";
    }
    const double off = distanceBetween(now.T_odom_base.pose, start.inverse() * motion(t));
    EXPECT_LT(off, 0.005 + 0.01 * gone) << i;
    EXPECT_LT(angleBetween(now.T_odom_base.pose, Pose()), 0.005) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Each, Van,
                         ::testing::Values(Drive{"drives off",
                                                 [](double s, double) { return 0.8 * std::max(0.0, s - 1.0); }},
                                           Drive{"keeps its distance from then on",
                                                 [](double s, double own) { return s < 1.0 ? 0.0 : own - 0.5; }}));

}  // namespace
}  // namespace swf_vo
