// SPDX-License-Identifier: BSD-3-Clause
#include "candidate/keyframe_pairs.hpp"

#include <algorithm>
#include <cmath>

namespace loop_metric {

using urban_nav_core::Pose;
using urban_nav_core::PoseWithCovariance;

namespace {

constexpr double kWidestTurn =
    1.05;  // rad, 60 deg: with less than a third of the image in common, keyframes are not matched
constexpr double kPairMetresPerRadian = 4.0;  // effect of a rotation on the number of matches, as a distance, for a
                                              // field of view of about 65 deg
constexpr double kUsefulSigma = 2.0;          // m: with less accurate odometry, the nearest keyframes are unknown
constexpr double kHeadingDeviations = 3.0;    // standard deviations for certainly different headings

const NearbyKeyframe& nearestView(const std::vector<NearbyKeyframe>& views, double offset) {
  return *std::min_element(views.begin(), views.end(), [offset](const NearbyKeyframe& x, const NearbyKeyframe& y) {
    return std::abs(x.path_offset - offset) < std::abs(y.path_offset - offset);
  });
}

double largestSigma(const PoseWithCovariance& pose, int half) {
  return std::sqrt(pose.covariance.diagonal().segment<3>(3 * half).maxCoeff());
}

/// Returns the relative pose of two keyframes for the relative pose `T_a_b` of the closure's poses.
Pose between(const Pose& T_a_b, const NearbyKeyframe& a, const NearbyKeyframe& b) {
  return a.T_place_keyframe.pose.inverse() * T_a_b * b.T_place_keyframe.pose;
}

double turn(const Pose& T) {
  return urban_nav_core::angleBetween(T, Pose(urban_nav_core::Quaterniond::Identity(), T.t()));
}

void add(std::vector<KeyframePair>& pairs, const NearbyKeyframe& a, const NearbyKeyframe& b) {
  if (a.at == b.at)
    return;  // near both poses: a match with itself only reproduces odometry, with too small a
             // covariance
  for (const KeyframePair& pair : pairs)
    if (pair.a.at == a.at && pair.b.at == b.at) return;
  pairs.push_back({a, b});
}

}  // namespace

std::vector<KeyframePair> chooseKeyframePairs(const std::vector<NearbyKeyframe>& views_a,
                                              const std::vector<NearbyKeyframe>& views_b,
                                              const std::optional<PoseWithCovariance>& T_a_b, double search_distance,
                                              std::size_t most) {
  std::vector<KeyframePair> pairs;
  if (views_a.empty() || views_b.empty()) return pairs;
  const NearbyKeyframe &a = nearestView(views_a, 0.0), &b = nearestView(views_b, 0.0);
  if (T_a_b) {
    const double doubt = kHeadingDeviations * largestSigma(*T_a_b, 1);
    const KeyframePair* best = nullptr;
    std::vector<KeyframePair> all;
    std::vector<double> costs;
    for (const NearbyKeyframe& each_a : views_a)
      for (const NearbyKeyframe& each_b : views_b) {
        if (each_a.at == each_b.at) continue;
        const Pose T = between(T_a_b->pose, each_a, each_b);
        if (turn(T) > kWidestTurn + doubt) continue;
        all.push_back({each_a, each_b});
        costs.push_back(T.t().norm() + kPairMetresPerRadian * turn(T));
      }
    if (all.empty()) return pairs;
    best = &all[static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin())];
    if (largestSigma(*T_a_b, 0) < kUsefulSigma) pairs.push_back(*best);
  }
  add(pairs, a, b);
  for (const double along : {-0.5 * search_distance, 0.5 * search_distance}) add(pairs, nearestView(views_a, along), b);
  if (pairs.size() > most) pairs.resize(most);
  return pairs;
}

}  // namespace loop_metric
