// SPDX-License-Identifier: BSD-3-Clause
#include "front_end/match_list.hpp"

#include <algorithm>

#include "front_end/temporal.hpp"

namespace swf_vo {

using urban_nav_core::Pose;
using urban_nav_core::StereoCamera;

namespace {

// With a wrong pose at most 8 % of the landmarks in view were inliers, once in ten simulated minutes with gaps (the
// soak of src/urban_nav/bench); with a correct pose at least 21 %, after a second without images from a car in a real
// street (the recordings of bench/faults).
constexpr double kLeastShareInView = 0.15;
constexpr double kCoordinates = 3.0;   // of a match: two in the left image, the column in the right one
constexpr double kOutlierChi2 = 11.3;  // quantile 0.99 of three degrees of freedom

}  // namespace

int countInBoth(const std::vector<Match>& matches) {
  return static_cast<int>(std::count_if(matches.begin(), matches.end(), [](const Match& match) {
    return match.inlier && match.left.found && match.right.found;
  }));
}

void listPredictionErrors(const StereoCamera& camera, const Pose& T_expected_odom, const std::vector<Match>& matches,
                          std::vector<double>& errors) {
  errors.clear();
  for (const Match& match : matches) {
    if (!match.inlier || !match.left.found) continue;
    const auto expected = projectInto(Side::Left, camera, T_expected_odom, match.p_odom);
    if (expected) errors.push_back((match.left.pixel - *expected).norm());
  }
}

double robustCost(const std::vector<Match>& matches) {
  double cost = 0.0;
  for (const Match& match : matches) {
    const bool is_inlier = match.inlier && match.left.found && match.right.found;
    cost += is_inlier ? std::min(match.chi2, kOutlierChi2) : kOutlierChi2;
  }
  return cost;
}

double costDispersion(double cost, std::size_t matches) {
  return matches == 0 ? 1.0 : std::max(1.0, cost / (kCoordinates * static_cast<double>(matches)));
}

bool isInView(const StereoCamera& camera, const Pose& T_camera_odom, const Match& match) {
  const auto pixel = projectInto(Side::Left, camera, T_camera_odom, match.p_odom);
  return pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 && pixel->x() < camera.left.width &&
         pixel->y() < camera.left.height;
}

bool isByChance(const StereoCamera& camera, const Pose& T_camera_odom, int inliers, const std::vector<Match>& matches) {
  const auto in_view = std::count_if(matches.begin(), matches.end(),
                                     [&](const Match& match) { return isInView(camera, T_camera_odom, match); });
  return inliers < kLeastShareInView * static_cast<double>(in_view);
}

void fillIn(const StereoCamera& camera, const Pose& T_camera_odom, Match& match) {
  const auto left = projectInto(Side::Left, camera, T_camera_odom, match.p_odom),
             right = projectInto(Side::Right, camera, T_camera_odom, match.p_odom);
  if (!match.left.found && left) match.z.x() = left->x();
  if (!match.right.found && right) match.z.z() = right->x();
}

void listParallax(const StereoCamera& camera, const Pose& T_last_odom, const Eigen::Vector3d& t_now_last,
                  const std::vector<Match>& matches, std::vector<Parallax>& parallax) {
  parallax.clear();
  for (const Match& match : matches) {
    const auto pixel = projectInto(Side::Left, camera, T_last_odom, match.p_odom);
    if (!pixel) continue;
    const double depth = (T_last_odom.q() * match.p_odom.head<3>() + T_last_odom.t() * match.p_odom.w()).z();
    parallax.push_back({*pixel, t_now_last * (match.p_odom.w() / depth)});
  }
}

}  // namespace swf_vo
