// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_registration/parameters.hpp"

#include <cstdint>
#include <string>
#include <utility>

#include "urban_nav_core/camera/camera_noise.hpp"

namespace urban_nav_registration {

using urban_nav_core::Audience;
using urban_nav_core::Table;

namespace {

urban_nav_core::Row<Parameters> withOldName(urban_nav_core::Row<Parameters> row, const std::string& old_name) {
  row.old_names.push_back(old_name);
  return row;
}

}  // namespace

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "registration",
      {
          {"keyframe_distance", &P::keyframe_distance, "m", 1.0, 0.05, 100.0, {},
           "Distance travelled between keyframes.",
           "paper 4", {"keyframe_way", "loop_metric.keyframe_way"}},
          {"keyframe_angle", &P::keyframe_angle, "rad", 0.26, 0.01, 7.0, {},
           "Rotation between keyframes.",
           "paper 4", {"keyframe_turn", "loop_metric.keyframe_turn"}},
          {"cloud_half_length", &P::cloud_half_length, "m", 10.0, 1.0, 100.0, {},
           "Half the length of a local cloud along the path: it has the scans from this distance before a pose to "
           "this distance after it.",
           "paper 4.2: a few seconds", {"cloud_way", "loop_metric.cloud_way"}},
          {"odometry_scale", &P::odometry_scale, "", 0.01, 0.0, 1.0, {},
           "Scale error common to all steps of odometry, as a share of the distance driven; not part of the "
           "covariance of the steps.",
           "swf_vo.disparity_offset", {"loop_metric.odometry_scale"}},
          {"points", &P::points, "", std::int64_t{500}, std::int64_t{50}, std::int64_t{5000}, {},
           "Largest number of points of a keyframe, spread over the image.",
           "paper 4.1", {"loop_metric.points"}},
          {"min_matches", &P::min_matches, "", std::int64_t{50}, std::int64_t{10}, std::int64_t{5000}, {},
           "Minimum number of inlier matches for a transform by stereo.",
           "paper 4.1", {"loop_metric.min_matches"}, Audience::Experts},
          {"max_reprojection_error", &P::max_reprojection_error, "px", 0.2, 0.01, 10.0, {},
           "Largest mean reprojection error of a transform by stereo.",
           "paper 4.1", {"loop_metric.max_reprojection_error"}, Audience::Experts},
          {"min_patch_correlation", &P::min_patch_correlation, "", 0.5, 0.0, 1.0, {},
           "Smallest mean correlation of patches with the other image at their predicted positions; low if places are "
           "only partly similar.",
           "src/urban_nav_registration/bench, pairs", {"min_likeness", "loop_metric.min_likeness"}, Audience::Experts},
          withOldName(urban_nav_core::disparityOffsetRow<P>(), "loop_metric.disparity_offset"),
          withOldName(urban_nav_core::pixelNoiseFloorRow<P>(), "loop_metric.pixel_noise_floor"),
          {"voxel_size", &P::voxel_size, "m", 0.25, 0.01, 10.0, {},
           "Edge of the cubes that a cloud is downsampled to.",
           "paper 4.2; measured", {"voxel", "loop_metric.voxel"}},
          {"max_correspondence_distance", &P::max_correspondence_distance, "m", 2.0, 0.02, 50.0, {},
           "Maximum correspondence distance at the coarsest level of ICP.",
           "paper 4.2; measured", {"reach", "loop_metric.reach"}, Audience::Experts},
          {"iterations", &P::iterations, "", std::int64_t{30}, std::int64_t{1}, std::int64_t{1000}, {},
           "Largest number of Gauss-Newton steps at one level; fewer at convergence.",
           "paper 4.2", {"loop_metric.iterations"}, Audience::Experts},
          {"laser_bias", &P::laser_bias, "m", 0.02, 0.0, 1.0, {},
           "Standard deviation of the error common to all points of a cloud: determines free directions and limits "
           "the information. Replaced by deformation and noise of local clouds if known.",
           "data sheets: HDL-32E 2 cm, LMS 291 3.5 cm", {"loop_metric.laser_bias"}},
          {"free_deviation", &P::free_deviation, "m", 0.2, 0.001, 100.0, {},
           "A direction is free, without information, if laser_bias can shift it by more than this at the mean "
           "distance of the matches.",
           "paper 4.2, Fig. 15b; measured", {"loop_metric.free_deviation"}, Audience::Experts},
          {"max_residual", &P::max_residual, "m", 0.12, 0.001, 10.0, {},
           "Largest robust standard deviation of point-to-plane distances of an accepted alignment.",
           "paper 4.2: final residual norm", {"loop_metric.max_residual"}, Audience::Experts},
          {"inlier_distance", &P::inlier_distance, "m", 0.1, 0.001, 10.0, {},
           "A surface within this distance of the plane of its counterpart is an inlier.",
           "paper 4.2", {"loop_metric.inlier_distance"}, Audience::Experts},
          {"min_inliers", &P::min_inliers, "", 0.35, 0.0, 1.0, {},
           "Smallest share of inliers among the surfaces of the source.",
           "paper 4.2: inlier ratio; measured", {"loop_metric.min_inliers"}, Audience::Experts},
          {"min_vertical_inliers", &P::min_vertical_inliers, "", 0.45, 0.0, 1.0, {},
           "Smallest share of inliers among the vertical surfaces of the source, since ground surfaces overlap "
           "everywhere; not tested if there are few.",
           "paper 4.2; measured", {"min_upright_inliers", "loop_metric.min_upright_inliers"}, Audience::Experts},
          {"max_residual_ratio", &P::max_residual_ratio, "", 1.25, 1.0, 100.0, {},
           "Local clouds: largest residual, as a multiple of what their noise and the drift of odometry explain.",
           "paper 4.2: final residual norm; 99 of 100 correct ones in src/urban_nav_registration/bench, local_clouds",
           {"max_misfit", "loop_metric.max_misfit"}, Audience::Experts},
          {"max_unmodelled_residual_ratio", &P::max_unmodelled_residual_ratio, "", 2.0, 1.0, 100.0, {},
           "Clouds from files, whose deformation is unknown: largest residual of a pose found by the search, as a "
           "multiple of what noise and laser_bias explain.",
           "paper 4.2: final residual norm; measured",
           {"max_unknown_misfit", "loop_metric.max_unknown_misfit"}, Audience::Experts},
          {"min_overlap", &P::min_overlap, "", 0.15, 0.0, 1.0, {},
           "Local clouds: smallest share of inliers among the vertical surfaces of the source, in place of "
           "min_inliers and min_vertical_inliers.",
           "src/urban_nav_registration/bench, local_clouds",
           {"min_shared", "loop_metric.min_shared"}, Audience::Experts},
          {"max_free_space_violation", &P::max_free_space_violation, "", 0.12, 0.0, 1.0, {},
           "Local clouds: largest share of vertical surfaces that beams of the other cloud passed through, among "
           "those and the coinciding ones.",
           "99 of 100 correct ones in src/urban_nav_registration/bench, local_clouds",
           {"max_seen_through", "loop_metric.max_seen_through"}, Audience::Experts},
          {"min_surfels", &P::min_surfels, "", std::int64_t{25}, std::int64_t{6}, std::int64_t{1000000}, {},
           "Smallest number of surfaces with a counterpart.",
           "paper 4.2", {"loop_metric.min_surfels"}, Audience::Experts},
          {"search_radius", &P::search_radius, "m", 10.0, 0.5, 100.0, {},
           "Radius of the global search around the guess, for the origin of the source.",
           "paper 4: closures within 7.5 m", {"loop_metric.search_radius"}, Audience::Experts},
          {"max_second_best_ratio", &P::max_second_best_ratio, "", 0.85, 0.0, 1.0, {},
           "Largest fit of the second best, different pose of a global search relative to the best one; above it the "
           "place is ambiguous.",
           "paper 4.2; measured", {"max_second", "loop_metric.max_second"}, Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace urban_nav_registration
