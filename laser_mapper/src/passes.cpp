// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/passes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace laser_mapper {

using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr double kPlace = 10.0;      // m, edge of the squares for the comparison of places
constexpr double kSamePlace = 10.0;  // m
constexpr double kLeast = 40.0;      // m of path between two visits
constexpr double kStep = 1.0;        // m
constexpr int kLastPass = 65535;

/// Places visited in the current pass.
class VisitedPlaces {
 public:
  /// Returns whether a place was visited more than kLeast before `travelled`.
  bool returned(const Eigen::Vector3d& p, double travelled) const {
    const auto [x, y] = square(p);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy) {
        const auto found = places_.find({x + dx, y + dy});
        if (found == places_.end()) continue;
        for (const Visit& visit : found->second)
          if (travelled - visit.travelled > kLeast && (visit.p - p).norm() < kSamePlace) return true;
      }
    return false;
  }
  void add(const Eigen::Vector3d& p, double travelled) { places_[square(p)].push_back({p, travelled}); }
  void clear() { places_.clear(); }

 private:
  struct Visit {
    Eigen::Vector3d p;
    double travelled = 0.0;
  };
  static std::pair<int, int> square(const Eigen::Vector3d& p) {
    return {static_cast<int>(std::floor(p.x() / kPlace)), static_cast<int>(std::floor(p.y() / kPlace))};
  }
  std::map<std::pair<int, int>, std::vector<Visit>> places_;
};

SessionPasses passesOfSession(const Trajectory& trajectory, int& pass) {
  SessionPasses passes;
  if (trajectory.empty()) return passes;
  passes.begins.push_back({trajectory.front().stamp, static_cast<std::uint16_t>(pass)});
  VisitedPlaces visited;
  double travelled = 0.0;  // in steps of kStep, so that noise at standstill does not accumulate
  Eigen::Vector3d last = trajectory.front().pose.t();
  visited.add(last, travelled);
  for (const urban_nav_core::StampedPose& pose : trajectory) {
    const double step = (pose.pose.t() - last).norm();
    if (step < kStep) continue;
    travelled += step;
    last = pose.pose.t();
    if (visited.returned(last, travelled)) {
      visited.clear();
      pass = std::min(pass + 1, kLastPass);
      passes.begins.push_back({pose.stamp, static_cast<std::uint16_t>(pass)});
    }
    visited.add(last, travelled);
  }
  return passes;
}

}  // namespace

std::uint16_t SessionPasses::at(StampNs stamp) const {
  if (begins.empty()) return 0;
  const auto after = std::upper_bound(begins.begin() + 1, begins.end(), stamp,
                                      [](StampNs wanted, const Begin& begin) { return wanted < begin.stamp; });
  return std::prev(after)->pass;
}

std::vector<SessionPasses> findPasses(const std::vector<const Trajectory*>& T_map_base) {
  std::vector<SessionPasses> all;
  int pass = 0;
  for (const Trajectory* trajectory : T_map_base) {
    all.push_back(passesOfSession(*trajectory, pass));
    if (!trajectory->empty()) pass = std::min(pass + 1, kLastPass);
  }
  return all;
}

}  // namespace laser_mapper
