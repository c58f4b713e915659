// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_core/testing/parameter_effects.hpp"

#include <sstream>

#include "urban_nav_core/testing/motion.hpp"
#include "urban_nav_core/testing/scanner.hpp"
#include "urban_nav_core/testing/textured_room.hpp"
#include "urban_nav_registration/icp/align.hpp"
#include "urban_nav_registration/keyframe/keyframe_selector.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_registration/stereo/stereo_closure.hpp"
#include "urban_nav_registration/testing/photographer.hpp"

namespace urban_nav_registration {
namespace {

using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::testing::lookingAlong;
using urban_nav_core::testing::scan;
using urban_nav_core::testing::stand;
using urban_nav_core::testing::World;

constexpr int kDigits = 17;

/// Prints a result without thresholds, which equal the parameters.
template <typename Verdict, typename Reason>
std::string printMatch(Verdict verdict, Reason reason, const urban_nav_core::Constraint& T_a_b) {
  std::ostringstream text;
  text.precision(kDigits);
  text << static_cast<int>(verdict) << " " << toString(reason) << "\n"
       << T_a_b.T_a_b.matrix() << "\n"
       << T_a_b.information;
  return text.str();
}

std::string print(const Alignment& found) {
  return printMatch(found.verdict, found.reason, {found.T_target_source, found.information});
}

/// Keyframes of a drive that turns at its end.
std::string selectKeyframes(const Parameters& parameters) {
  KeyframeSelector selector(parameters);
  std::string chosen;
  for (int i = 0; i < 100; ++i) {
    const double turn = i < 60 ? 0.0 : 0.02 * (i - 60);
    chosen += selector.select(lookingAlong({0.1 * std::min(i, 60), 0.0, 1.0}, turn)) ? '1' : '0';
  }
  return chosen;
}

std::string extractKeyframe(const Parameters& parameters) {
  testing::Photographer photographer(urban_nav_core::testing::texturedRoom());
  const Keyframe keyframe = photographer.keyframe(lookingAlong({0.0, 0.0, 1.0}, 0.2), 1.0, parameters.points);
  return std::to_string(keyframe.points.size());
}

std::string matchStereo(const Parameters& parameters) {
  static const auto views = [] {
    testing::Photographer photographer(urban_nav_core::testing::texturedRoom());
    return std::make_pair(photographer.camera(),
                          std::vector<Keyframe>{photographer.keyframe(lookingAlong({-1.0, 0.0, 1.0}, 0.2)),
                                                photographer.keyframe(lookingAlong({0.0, 0.4, 1.0}, 0.1))});
  }();
  StereoMatcher matcher(views.first, parameters);
  const StereoClosure closure = matcher.match(views.second[0], views.second[1]);
  return printMatch(closure.verdict, closure.reason, closure.lefts);
}

/// Two scans, of the same world or of different worlds, with the sensor as origin of the beams.
struct Scans {
  PointCloud source, target;

  Scans(const World& of_source, const World& of_target, double heading_deg = 5.0)
      : source(scan(of_source, stand(1.0, 0.5, heading_deg), {}, 1)),
        target(scan(of_target, stand(-0.5, 0.3, 0.0), {}, 2)) {
    for (PointCloud* cloud : {&source, &target}) cloud->origins.assign(cloud->points.size(), Eigen::Vector3f::Zero());
  }
};

/// A court of 20 m by 24 m that is symmetric unless it has a kiosk. `nearer`: displacement of its fronts, m.
World closedCourt(double nearer = 0.0, bool has_kiosk = false) {
  World court;
  for (int side = 0; side < 4; ++side) {
    const double heading = 0.5 * M_PI * side, away = (side % 2 == 0 ? 10.0 : 12.0) - nearer;
    court.blocks.push_back(
        {-away * std::sin(heading), away * std::cos(heading), side % 2 == 0 ? 24.0 : 20.0, 1.0, 0.0, 6.0, heading});
  }
  if (has_kiosk) court.blocks.push_back({7.0, 4.0, 5.0, 3.0, 0.0, 5.0, 0.3});
  return court;
}

std::function<std::string(const Parameters&)> alignScans(const Scans& scans, SearchMode search,
                                                         std::optional<double> deformation_sigma = std::nullopt) {
  return [&scans, search, deformation_sigma](const Parameters& parameters) {
    AlignmentPrior known;
    known.deformation_sigma = deformation_sigma;
    return print(align(scans.source, scans.target, parameters, {}, search, known));
  };
}

TEST(ParameterEffects, EachParameterChangesAResult) {
  const World yard = urban_nav_core::testing::courtyard(1);
  const Scans same(yard, yard), turned(yard, yard, 170.0), alike(closedCourt(), closedCourt(0.06)),
      nearer(closedCourt(4.0), closedCourt()), symmetric(closedCourt(), closedCourt(), 175.0),
      smaller(closedCourt(0.0, true), closedCourt(0.06, true));
  const std::string of_loop_metric = "../../loop_metric/test";
  const std::string faults = urban_nav_core::testing::findParametersWithoutEffect(
      table(),
      {{"selection of keyframes", selectKeyframes, {{"keyframe_distance", 0.5}, {"keyframe_angle", 0.1}}},
       {"keyframe", extractKeyframe, {{"points", 100}}},
       {"two views",
        matchStereo,
        {{"min_matches", 5000},
         {"max_reprojection_error", 0.01},
         {"min_patch_correlation", 1.0},
         {"disparity_offset", 0.5},
         {"pixel_noise_floor", 1.0}}},
       {"two scans",
        alignScans(same, SearchMode::Never),
        {{"voxel_size", 0.5},
         {"max_correspondence_distance", 0.1},
         {"iterations", 1},
         {"laser_bias", 0.1},
         {"free_deviation", 0.001},
         {"max_residual", 0.001},
         {"inlier_distance", 0.001},
         {"min_inliers", 1.0},
         {"min_vertical_inliers", 1.0},
         {"min_surfels", 1000000}}},
       {"two local clouds", alignScans(same, SearchMode::Never, 0.005), {{"min_overlap", 1.0}}},
       {"walls 6 cm apart", alignScans(alike, SearchMode::Never, 0.005), {{"max_residual_ratio", 100.0}}},
       {"walls that beams pass", alignScans(nearer, SearchMode::Never, 0.005), {{"max_free_space_violation", 1.0}}},
       {"scans of two headings", alignScans(turned, SearchMode::AtOnce), {{"search_radius", 0.5}}},
       {"walls 6 cm apart, searched",
        alignScans(smaller, SearchMode::AtOnce),
        {{"max_unmodelled_residual_ratio", 1.0}},
        {{"laser_bias", 0.001}}},
       {"symmetric walls", alignScans(symmetric, SearchMode::AtOnce), {{"max_second_best_ratio", 1.0}}}},
      {{"cloud_half_length", "ParameterEffects.ParametersOfRegistrationChangeAResult", of_loop_metric},
       {"odometry_scale", "ParameterEffects.ParametersOfRegistrationChangeAResult", of_loop_metric}});
  EXPECT_EQ(faults, "");
}

}  // namespace
}  // namespace urban_nav_registration
