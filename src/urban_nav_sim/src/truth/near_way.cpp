// SPDX-License-Identifier: BSD-3-Clause
#include "truth/near_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace urban_nav_sim {

namespace {

constexpr float cell = 0.5F;   // m
constexpr double apart = 0.5;  // m, of the places whose surroundings are marked
constexpr double look = 0.05;  // s

/// Places along the way, some half a metre apart.
std::vector<Eigen::Vector2d> placesOf(const Ride& ride) {
  std::vector<Eigen::Vector2d> places;
  const auto steps = static_cast<int>(std::ceil(ride.duration() / look));
  for (int i = 0; i <= steps; ++i) {
    const Eigen::Vector2d here = ride.at(std::min(i * look, ride.duration())).T_world_base.t().head<2>();
    if (places.empty() || (here - places.back()).norm() > apart || i == steps) places.push_back(here);
  }
  return places;
}

}  // namespace

int NearWay::cellOf(float metres) { return static_cast<int>(std::floor(metres / cell)); }

NearWay::NearWay(const Ride& ride, double radius) {
  const std::vector<Eigen::Vector2d> places = placesOf(ride);
  Eigen::Vector2d low = places.front(), high = places.front();
  for (const Eigen::Vector2d& place : places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  low_ = (low.array() - radius).matrix().cast<float>();
  columns_ = cellOf(static_cast<float>(high.x() + radius) - low_.x()) + 1;
  rows_ = cellOf(static_cast<float>(high.y() + radius) - low_.y()) + 1;
  near_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), false);
  for (const Eigen::Vector2d& place : places) mark(place, radius);
}

void NearWay::mark(const Eigen::Vector2d& place, double radius) {
  const Eigen::Vector2f middle = place.cast<float>() - low_;
  const auto r = static_cast<float>(radius);
  for (int j = std::max(0, cellOf(middle.y() - r)); j <= std::min(rows_ - 1, cellOf(middle.y() + r)); ++j) {
    const float dy = (static_cast<float>(j) + 0.5F) * cell - middle.y();
    const float half = std::sqrt(std::max(0.0F, r * r - dy * dy));
    const int first = std::max(0, cellOf(middle.x() - half)), last = std::min(columns_ - 1, cellOf(middle.x() + half));
    for (int i = first; i <= last; ++i) near_[static_cast<std::size_t>(j * columns_ + i)] = true;
  }
}

bool NearWay::touches(const Eigen::Vector2f& low, const Eigen::Vector2f& high) const {
  const int first_column = std::max(0, cellOf(low.x() - low_.x())),
            last_column = std::min(columns_ - 1, cellOf(high.x() - low_.x()));
  for (int j = std::max(0, cellOf(low.y() - low_.y())); j <= std::min(rows_ - 1, cellOf(high.y() - low_.y())); ++j)
    for (int i = first_column; i <= last_column; ++i)
      if (near_[static_cast<std::size_t>(j * columns_ + i)]) return true;
  return false;
}

}  // namespace urban_nav_sim
