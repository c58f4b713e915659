// SPDX-License-Identifier: BSD-3-Clause
#include "loop_metric/parameters.hpp"

#include <cstdint>

namespace loop_metric {

using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "loop_metric",
      {
          {"keyframe_way", &P::keyframe_way, "m", 1.0, 0.05, 100.0, {},
           "A view is kept each time the robot has driven so far since the last one.", "section 4"},
          {"keyframe_turn", &P::keyframe_turn, "rad", 0.26, 0.01, 7.0, {},
           "Or turned so far.", "section 4"},
          {"stereo", &P::stereo, "", true, false, false, {},
           "Whether two views are registered.", "section 4.1"},
          {"icp", &P::icp, "", true, false, false, {},
           "Whether clouds are aligned where two views could not be registered.", "section 4.2"},
          {"stereo_tries", &P::stereo_tries, "", std::int64_t{2}, std::int64_t{1}, std::int64_t{20}, {},
           "Pairs of views around the two moments that are tried at most.", "section 4.1; measured"},
          {"view_way", &P::view_way, "m", 6.0, 0.0, 50.0, {},
           "How far from a moment along the way a view may be to stand for it.", "section 3: places within 7.5 m"},
          {"cloud_way", &P::cloud_way, "m", 10.0, 1.0, 100.0, {},
           "A local cloud is what the lasers saw from so far before a moment to so far behind it.", "section 4.2: a few seconds"},
          {"place_radius", &P::place_radius, "m", 9.0, 1.0, 100.0, {},
           "Moments whose transform puts them further apart than this are not the one place that the candidate says, however right it is.", "section 3: places within 7.5 m, and a fifth for doubt"},
          {"gate", &P::gate, "", 5.0, 1.0, 1000.0, {},
           "By how many standard deviations (root mean square) a transform may differ from odometry and from its neighbours.", "section 4"},
          {"map_sigma", &P::map_sigma, "m", 0.05, 0.0, 10.0, {},
           "How far the poses of a map that one localises in may be off.", "pose_graph/README.md, end to end"},
          {"odometry_scale", &P::odometry_scale, "", 0.01, 0.0, 1.0, {},
           "Error that all of odometry's steps may have in common, as a share of the way driven between the moments: its covariance does not tell.", "swf_vo.disparity_offset"},
          {"points", &P::points, "", std::int64_t{500}, std::int64_t{50}, std::int64_t{5000}, {},
           "Points of a keyframe, spread over the image, that two views are matched by.", "section 4.1"},
          {"min_matches", &P::min_matches, "", std::int64_t{50}, std::int64_t{10}, std::int64_t{5000}, {},
           "A transform by stereo needs as many matches that agree with it.", "section 4.1"},
          {"max_reprojection_error", &P::max_reprojection_error, "px", 0.2, 0.01, 10.0, {},
           "And their mean reprojection error must be below this.", "section 4.1"},
          {"min_likeness", &P::min_likeness, "", 0.5, 0.0, 1.0, {},
           "And the other view must look like the points where they should be, in the mean: correlation of patches, which is low where places are alike in parts only.",
           "loop_metric/bench, pairs"},
          {"disparity_offset", &P::disparity_offset, "px", 0.1, 0.0, 5.0, {},
           "Standard deviation of a constant error of all disparities, left by calibration; 0 takes the calibration as exact.",
           "swf_vo.disparity_offset"},
          {"pixel_noise_floor", &P::pixel_noise_floor, "px", 0.03, 0.001, 5.0, {},
           "Standard deviation added to that of every measured pixel: what the patch alignment cannot know of.",
           "swf_vo.pixel_noise_floor"},
          {"voxel", &P::voxel, "m", 0.25, 0.01, 10.0, {},
           "Edge of the cubes that a cloud is thinned to.", "section 4.2; measured"},
          {"reach", &P::reach, "m", 2.0, 0.02, 50.0, {},
           "How far away a counterpart is looked for in the first, coarsest step of an alignment.", "section 4.2; measured"},
          {"iterations", &P::iterations, "", std::int64_t{30}, std::int64_t{1}, std::int64_t{1000}, {},
           "Gauss-Newton steps at one scale, at most; fewer where nothing changes any more.", "section 4.2"},
          {"laser_bias", &P::laser_bias, "m", 0.02, 0.0, 1.0, {},
           "What a whole cloud may be off with all of its points together; what directions are free is judged by it, information by residuals up to it. Where the bend of gathered clouds is known, that and their noise take its place.", "data sheets: HDL-32E 2 cm, LMS 291 3.5 cm"},
          {"free_deviation", &P::free_deviation, "m", 0.2, 0.001, 100.0, {},
           "A direction that laser_bias alone could move by more than this, at the matches' mean distance, counts as free: no information.", "section 4.2, Fig. 15b; measured"},
          {"max_residual", &P::max_residual, "m", 0.12, 0.001, 10.0, {},
           "Largest robust deviation of the distances to the planes of an alignment that is accepted.", "section 4.2: final residual norm"},
          {"inlier_distance", &P::inlier_distance, "m", 0.1, 0.001, 10.0, {},
           "A surface within this of its counterpart's plane is an inlier.", "section 4.2"},
          {"min_inliers", &P::min_inliers, "", 0.35, 0.0, 1.0, {},
           "Smallest share of inliers among the source's surfaces.", "section 4.2: inlier ratio; measured"},
          {"min_upright_inliers", &P::min_upright_inliers, "", 0.45, 0.0, 1.0, {},
           "The same among those that stand upright, since ground falls upon ground anywhere; not tested where there are few.", "section 4.2; measured"},
          {"max_misfit", &P::max_misfit, "", 1.25, 1.0, 100.0, {},
           "Clouds that were gathered by odometry: largest residual, as a multiple of what their own noise and odometry's drift explain.", "section 4.2: final residual norm; 99 of 100 right ones in loop_metric/bench, local_clouds"},
          {"max_unknown_misfit", &P::max_unknown_misfit, "", 2.0, 1.0, 100.0, {},
           "Clouds out of files, which may be bent by more than is known: the same of what a search finds, with laser_bias for the bend.", "section 4.2: final residual norm; measured"},
          {"min_shared", &P::min_shared, "", 0.15, 0.0, 1.0, {},
           "And smallest share of inliers among the source's upright surfaces: takes the place of min_inliers and min_upright_inliers there.", "loop_metric/bench, local_clouds"},
          {"max_seen_through", &P::max_seen_through, "", 0.12, 0.0, 1.0, {},
           "And largest share of upright surfaces that beams of the other cloud went through, among those and the ones that fall upon each other.", "99 of 100 right ones in loop_metric/bench, local_clouds"},
          {"min_surfels", &P::min_surfels, "", std::int64_t{25}, std::int64_t{6}, std::int64_t{1000000}, {},
           "Fewest pieces of surface with a counterpart.", "section 4.2"},
          {"search_radius", &P::search_radius, "m", 10.0, 0.5, 100.0, {},
           "How far the global search looks for the source's origin around the guess.", "section 4: closures within 7.5 m"},
          {"max_second", &P::max_second, "", 0.85, 0.0, 1.0, {},
           "Inliers of the second, different pose that the global search found, as a share of the best one's: above it the place is ambiguous.", "section 4.2; measured"},
      });
  return rows;
}
// clang-format on

}  // namespace loop_metric
