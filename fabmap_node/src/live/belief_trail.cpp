// SPDX-License-Identifier: BSD-3-Clause
#include "live/belief_trail.hpp"

#include <algorithm>
#include <utility>

namespace fabmap_node {

using urban_nav_core::StampNs;

namespace {

constexpr StampNs kPathLength = 60'000'000'000;  // ns; observations may be queued
constexpr std::size_t kMostPoints = 5000;        // 40 minutes at two a second
constexpr std::size_t kMostWaiting = 1000;       // without odometry

template <typename Item>
void dropOldest(std::deque<Item>& items, std::size_t most) {
  while (items.size() > most) items.pop_front();
}

}  // namespace

void BeliefTrail::addOdometry(const urban_nav_core::StampedPose& T_odom_base) {
  if (!T_odom_base.pose.t().allFinite()) return;
  if (!path_.empty() && T_odom_base.stamp <= path_.back().stamp) path_.clear();
  path_.push_back({T_odom_base.stamp, T_odom_base.pose.t()});
  while (path_.front().stamp < T_odom_base.stamp - kPathLength) path_.pop_front();
  placeWaiting();
}

void BeliefTrail::add(const PlaceBelief& belief) {
  if (belief.observation != ObservationStatus::Used || belief.is_stationary) return;
  const StampNs last = !waiting_.empty() ? waiting_.back().stamp : !points_.empty() ? points_.back().stamp : 0;
  if (belief.at.stamp <= last) clear();
  Point point;
  point.stamp = belief.at.stamp;
  set(belief, point);
  waiting_.push_back(std::move(point));
  dropOldest(waiting_, kMostWaiting);
  placeWaiting();
}

void BeliefTrail::set(const PlaceBelief& belief, Point& point) {
  point.knowledge = belief.knowledge;
  point.p_new = belief.p_new;
  if (!belief.likeliest.empty()) point.likeliest = belief.likeliest.front();
}

void BeliefTrail::revise(const PlaceBelief& belief) {
  for (std::deque<Point>* some : {&points_, &waiting_}) {
    const auto found = std::lower_bound(some->begin(), some->end(), belief.at.stamp,
                                        [](const Point& each, StampNs wanted) { return each.stamp < wanted; });
    if (found == some->end() || found->stamp != belief.at.stamp) continue;
    set(belief, *found);
    ++count_;
  }
}

void BeliefTrail::clear() {
  waiting_.clear();
  points_.clear();
}

/// Interpolates between poses of odometry. Observations before the path are dropped.
void BeliefTrail::placeWaiting() {
  while (!waiting_.empty() && !path_.empty() && waiting_.front().stamp <= path_.back().stamp) {
    Point point = std::move(waiting_.front());
    waiting_.pop_front();
    const auto after = std::lower_bound(path_.begin(), path_.end(), point.stamp,
                                        [](const Position& each, StampNs stamp) { return each.stamp < stamp; });
    if (after->stamp == point.stamp) {
      point.p_odom = after->p_odom;
    } else if (after == path_.begin()) {
      continue;
    } else {
      const Position& before = *std::prev(after);
      const double share =
          static_cast<double>(point.stamp - before.stamp) / static_cast<double>(after->stamp - before.stamp);
      point.p_odom = before.p_odom + share * (after->p_odom - before.p_odom);
    }
    points_.push_back(std::move(point));
    ++count_;
  }
  dropOldest(points_, kMostPoints);
}

const BeliefTrail::Point* BeliefTrail::find(StampNs stamp) const {
  const auto found = std::lower_bound(points_.begin(), points_.end(), stamp,
                                      [](const Point& each, StampNs wanted) { return each.stamp < wanted; });
  return found != points_.end() && found->stamp == stamp ? &*found : nullptr;
}

}  // namespace fabmap_node
