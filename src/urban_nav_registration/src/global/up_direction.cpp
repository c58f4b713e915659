// SPDX-License-Identifier: BSD-3-Clause
#include "global/up_direction.hpp"

#include <algorithm>
#include <cmath>

namespace urban_nav_registration {

namespace {

constexpr float kHalfTurnF = 3.14159265F;
constexpr float kSimilarNormal = 0.985F;  // cosine of 10 deg

/// Returns the sum of planarity of normals within a cone around `axis`, and their mean direction.
std::pair<float, Eigen::Vector3f> within(const Surfels& surfels, const Eigen::Vector3f& axis, float cosine) {
  float weight = 0.0F;
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const Surfel& surfel : surfels.all) {
    const float along = surfel.normal.dot(axis);
    if (std::abs(along) < cosine || !(surfel.planarity > 0.0F)) continue;
    weight += surfel.planarity;
    sum += (along < 0.0F ? -surfel.planarity : surfel.planarity) * surfel.normal;
  }
  return {weight, sum};
}

}  // namespace

UpDirection estimateUpDirection(const Surfels& surfels) {
  UpDirection upright;
  float best = 0.0F;
  for (int ring = 0; ring < 4; ++ring) {
    const int places = ring == 0 ? 1 : 6 * ring;
    for (int place = 0; place < places; ++place) {
      const float tilt = 10.0F * static_cast<float>(ring) * kHalfTurnF / 180.0F;
      const float azimuth = 2.0F * kHalfTurnF * static_cast<float>(place) / static_cast<float>(places);
      const Eigen::Vector3f axis(std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth),
                                 std::cos(tilt));
      const float weight = within(surfels, axis, kSimilarNormal).first;
      if (weight <= best) continue;
      best = weight;
      upright.up = axis;
    }
  }
  if (!(best > 0.0F)) return upright;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3f sum = within(surfels, upright.up, kSimilarNormal).second;
    if (sum.norm() > 0.0F) upright.up = sum.normalized();
  }
  // Fullest layer of 0.4 m, in steps of half of that.
  constexpr float kLayer = 0.2F, kNear = 20.0F;
  std::vector<float> layers(400, 0.0F);
  for (const Surfel& surfel : surfels.all) {
    if (std::abs(surfel.normal.dot(upright.up)) < kSimilarNormal || surfel.mean.norm() > kNear) continue;
    const float at = surfel.mean.dot(upright.up) / kLayer + 200.0F;
    if (at >= 0.0F && at < 400.0F) layers[static_cast<std::size_t>(at)] += surfel.planarity;
  }
  float fullest = 0.0F;
  for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
    const float both = layers[i] + layers[i + 1];
    if (both <= fullest) continue;
    fullest = both;
    upright.ground = (static_cast<float>(i) + 1.0F - 200.0F) * kLayer;
    upright.has_ground = true;
  }
  return upright;
}

}  // namespace urban_nav_registration
