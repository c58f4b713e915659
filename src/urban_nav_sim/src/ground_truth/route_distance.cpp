// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth/route_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace urban_nav_sim {

namespace {

constexpr float kRouteCell = 0.5F;  // m
constexpr double kApart = 0.5;      // m, between the positions whose surroundings are marked
constexpr double kSampling = 0.05;  // s

/// Returns positions along the path, about half a metre apart.
std::vector<Eigen::Vector2d> samplePositions(const Motion& motion) {
  std::vector<Eigen::Vector2d> places;
  const auto steps = static_cast<int>(std::ceil(motion.duration() / kSampling));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d here = motion.at(std::min(i * kSampling, motion.duration())).T_world_base.t().head<2>();
    if (places.empty() || (here - places.back()).norm() > kApart || i == steps) places.push_back(here);
  }
  return places;
}

}  // namespace

int RouteDistance::cellIndex(float metres) { return static_cast<int>(std::floor(metres / kRouteCell)); }

RouteDistance::RouteDistance(const Motion& motion, double radius) {
  const std::vector<Eigen::Vector2d> places = samplePositions(motion);
  Eigen::Vector2d low = places.front(), high = places.front();
  for (const Eigen::Vector2d& place : places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  low_ = (low.array() - radius).matrix().cast<float>();
  columns_ = cellIndex(static_cast<float>(high.x() + radius) - low_.x()) + 1;
  rows_ = cellIndex(static_cast<float>(high.y() + radius) - low_.y()) + 1;
  near_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false);
  for (const Eigen::Vector2d& place : places) mark(place, radius);
}

void RouteDistance::mark(const Eigen::Vector2d& place, double radius) {
  const Eigen::Vector2f middle = place.cast<float>() - low_;
  const auto r = static_cast<float>(radius);
  for (int j = std::max(0, cellIndex(middle.y() - r)); j <= std::min(rows_ - 1, cellIndex(middle.y() + r)); ++j) {
    const float dy = (static_cast<float>(j) + 0.5F) * kRouteCell - middle.y();
    const float half = std::sqrt(std::max(0.0F, r * r - dy * dy));
    const int first = std::max(0, cellIndex(middle.x() - half)),
              last = std::min(columns_ - 1, cellIndex(middle.x() + half));
    for (int i = first; i <= last; ++i) near_[static_cast<std::size_t>(j * columns_ + i)] = true;
  }
}

bool RouteDistance::touches(const Eigen::Vector2f& low, const Eigen::Vector2f& high) const {
  const int first_column = std::max(0, cellIndex(low.x() - low_.x())),
            last_column = std::min(columns_ - 1, cellIndex(high.x() - low_.x()));
  for (int j = std::max(0, cellIndex(low.y() - low_.y())); j <= std::min(rows_ - 1, cellIndex(high.y() - low_.y()));
       ++j)
    for (int i = first_column; i <= last_column; ++i)
      if (near_[static_cast<std::size_t>(j * columns_ + i)]) return true;
  return false;
}

}  // namespace urban_nav_sim
