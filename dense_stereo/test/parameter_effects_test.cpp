// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <sstream>

#include "dense_stereo/near_scene.hpp"
#include "dense_stereo_paper/paper_matcher.hpp"
#include "support/rendered_pair.hpp"
#include "urban_nav_core/testing/textured_room.hpp"

namespace dense_stereo {
namespace {

/// Disparities with variances, numbers of points, and obstacles.
std::string printScene(const NearScene& scene) {
  std::ostringstream text;
  text.precision(9);
  for (const float disparity : scene.stereo.image.disparity) text << disparity << " ";
  for (const float variance : scene.stereo.image.variance) text << variance << " ";
  text << "\n" << scene.points.size() << " " << toString(scene.ground.verdict) << " " << scene.ground.height << "\n";
  for (const ObstaclePoint& obstacle : scene.obstacles) text << obstacle.p_cam.transpose() << " " << obstacle.height;
  return text.str();
}

TEST(ParameterEffects, EachParameterChangesTheScene) {
  const testing_support::RenderedPair view(urban_nav_core::testing::texturedRoom(), 1.0, 0.5, 0.9, 0.0, 0.0);
  const auto match = [&view](const Parameters& parameters) {
    NearSceneEstimator estimator(parameters, view.camera(), makePaperMatcher(parameters));
    return printScene(estimator.process(view.pair()));
  };
  const std::string of_map = "../src/urban_nav/test/topics/stereo";
  const std::string selection = "StereoKeyframes.AreSelectedOtherwiseWithOtherParameters";
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(
      table(),
      {{"room",
        match,
        {{"method", "paper"},
         {"disparities", 32},
         {"min_component", 5000},
         {"max_sigma", 0.1},
         {"max_range", 20.0},
         {"obstacle_height", 0.6},
         {"clearance", 0.5}}}},
      {{"point_spacing", "StereoMatcher.KeepsOtherPointsWithAnotherSpacing", of_map},
       {"keyframe_distance", selection, of_map},
       {"keyframe_angle", selection, of_map},
       {"keyframe_interval", selection, of_map}});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace dense_stereo
