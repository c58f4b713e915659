// SPDX-License-Identifier: BSD-3-Clause
#include "motion/route_path.hpp"

#include <algorithm>
#include <cmath>

#include "motion/simulate_drive.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav_sim {
namespace {

constexpr double kSame = 0.05;         // m: closer waypoints are merged
constexpr double kTurningRound = 1.9;  // rad: larger turns are made on the spot

std::vector<Waypoint> withoutRepeats(const std::vector<Waypoint>& all) {
  std::vector<Waypoint> some;
  for (const Waypoint& each : all) {
    if (some.empty() || (each.position - some.back().position).norm() > kSame) {
      some.push_back(each);
    } else {
      some.back().pause += each.pause;
    }
  }
  return some;
}

// Waypoints in the order of driving, starting at the first.
class Order {
 public:
  explicit Order(std::vector<Waypoint> route) : route_(std::move(route)) {
    closed_ = (route_.front().position - route_.back().position).norm() < kClosed;
  }

  const Waypoint& start() const { return route_.front(); }
  Waypoint next() {
    if (closed_) {
      at_ = at_ + 1 < route_.size() ? at_ + 1 : 1;
      return route_[at_];
    }
    if (at_ == 0) forward_ = true;
    if (at_ + 1 == route_.size()) forward_ = false;
    Waypoint to = route_[forward_ ? at_ + 1 : at_ - 1];
    to.speed = route_[forward_ ? at_ + 1 : at_].speed;
    at_ = forward_ ? at_ + 1 : at_ - 1;
    return to;
  }

 private:
  std::vector<Waypoint> route_;
  std::size_t at_ = 0;
  bool closed_ = false, forward_ = true;
};

}  // namespace

RoutePath::RoutePath(const Route& route, double length) {
  const std::vector<Waypoint> waypoints = withoutRepeats(route.waypoints);
  double whole = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    whole += (waypoints[i].position - waypoints[i - 1].position).norm();
  }
  if (whole < 0.5) throw urban_nav_core::UserError("route " + route.name, "leads nowhere", "at least 0.5 m of path");

  Order order(waypoints);
  points_.push_back(order.start().position);
  along_.push_back(0.0);
  speeds_.push_back(order.start().speed);
  double pause = 0.0;  // the robot is at rest at the start
  while (along_.back() < length) {
    const Waypoint to = order.next();
    const Eigen::Vector2d step = to.position - points_.back();
    if (points_.size() > 1) {
      const Eigen::Vector2d before = (points_.back() - points_[points_.size() - 2]).normalized();
      const bool sharp = before.dot(step.normalized()) < std::cos(kTurningRound);
      if (sharp || pause > 0.0) stops_.push_back({along_.back(), pause});
    }
    points_.push_back(to.position);
    along_.push_back(along_.back() + step.norm());
    speeds_.push_back(to.speed);
    pause = to.pause;
  }
}

std::size_t RoutePath::pieceAt(double s) const {
  const auto after = std::upper_bound(along_.begin() + 1, along_.end() - 1, s);
  return static_cast<std::size_t>(after - along_.begin());
}

Eigen::Vector2d RoutePath::at(double s) const {
  const std::size_t i = pieceAt(s);
  return points_[i - 1] + (s - along_[i - 1]) / (along_[i] - along_[i - 1]) * (points_[i] - points_[i - 1]);
}

Eigen::Vector2d RoutePath::direction(double s) const {
  const std::size_t i = pieceAt(s);
  return (points_[i] - points_[i - 1]).normalized();
}

double RoutePath::speed(double s) const { return speeds_[pieceAt(s)]; }

std::optional<RoutePath::Stop> RoutePath::nextStop(double s) const {
  const auto found =
      std::upper_bound(stops_.begin(), stops_.end(), s, [](double value, const Stop& stop) { return value < stop.at; });
  return found == stops_.end() ? std::nullopt : std::optional<Stop>(*found);
}

}  // namespace urban_nav_sim
