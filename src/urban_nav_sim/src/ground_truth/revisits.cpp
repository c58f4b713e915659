// SPDX-License-Identifier: BSD-3-Clause
#include "ground_truth/revisits.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace urban_nav_sim {
namespace {

using urban_nav_core::StampedPose;
using urban_nav_core::Trajectory;

constexpr double kOtherPlace = 10.0;  // m: margin of false closures to the limit
constexpr int kTries = 200;           // per false closure

double heading(const StampedPose& at) {
  const Eigen::Vector3d forward = at.pose.q() * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

bool isLater(const StampedPose& a, const StampedPose& b) {
  return urban_nav_core::secondsBetween(a.stamp, b.stamp) > kRevisitGap;
}

Revisit between(const Trajectory& panoramas, std::size_t a, std::size_t b) {
  const double turned = std::remainder(heading(panoramas[b]) - heading(panoramas[a]), 2.0 * M_PI);
  return {a, b, urban_nav_core::distanceBetween(panoramas[a].pose, panoramas[b].pose), turned * 180.0 / M_PI};
}

// Panoramas by grid squares of kSamePlace: near ones are in the same square or one of its eight neighbours.
class Squares {
 public:
  void add(const Eigen::Vector3d& at, std::size_t index) { squares_[toSquare(at)].push_back(index); }

  template <typename Visit>
  void forEachAround(const Eigen::Vector3d& at, const Visit& visit) const {
    const auto [x, y] = toSquare(at);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        const auto found = squares_.find({i, j});
        if (found != squares_.end()) visit(found->second);
      }
    }
  }

 private:
  using Square = std::pair<std::int64_t, std::int64_t>;
  static Square toSquare(const Eigen::Vector3d& at) {
    return {std::llround(std::floor(at.x() / kSamePlace)), std::llround(std::floor(at.y() / kSamePlace))};
  }

  std::map<Square, std::vector<std::size_t>> squares_;
};

// Probability of a recogniser above its limit, in steps of 0.0001.
double sure(const Noise& noise, std::size_t number) {
  return (9900.0 + std::floor(noise.uniform(number, 0.0, 100.0))) / 1e4;
}

}  // namespace

std::vector<Revisit> findRevisits(const Trajectory& panoramas) {
  std::vector<Revisit> all;
  Squares seen;
  for (std::size_t b = 0; b < panoramas.size(); ++b) {
    const Eigen::Vector3d& at = panoramas[b].pose.t();
    const std::size_t first = all.size();
    seen.forEachAround(at, [&](const std::vector<std::size_t>& square) {
      for (const std::size_t a : square) {
        if (!isLater(panoramas[a], panoramas[b])) break;  // squares are in the order of time
        if ((panoramas[a].pose.t() - at).norm() <= kSamePlace) all.push_back(between(panoramas, a, b));
      }
    });
    std::sort(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(),
              [](const Revisit& one, const Revisit& other) { return one.a < other.a; });
    seen.add(at, b);
  }
  return all;
}

std::vector<Closure> trueClosures(const std::vector<Revisit>& revisits, const Noise& noise) {
  std::vector<Closure> closures;
  double nearest = 0.0;
  for (const Revisit& each : revisits) {
    if (closures.empty() || closures.back().b != each.b) {
      closures.push_back({each.a, each.b, sure(noise, each.b)});
      nearest = each.distance;
    } else if (each.distance < nearest) {
      closures.back().a = each.a;
      nearest = each.distance;
    }
  }
  return closures;
}

std::vector<Closure> falseClosures(const Trajectory& panoramas, std::size_t count, const Noise& noise) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;  // b, a
  std::uint64_t draw = 0;
  for (std::size_t i = 0; i < count && panoramas.size() > 1; ++i) {
    for (int attempt = 0; attempt < kTries && pairs.size() == i; ++attempt) {
      const std::size_t one = noise.below(draw++, panoramas.size()), other = noise.below(draw++, panoramas.size());
      const auto [a, b] = std::minmax(one, other);
      const bool apart = (panoramas[a].pose.t() - panoramas[b].pose.t()).norm() > kOtherPlace;
      if (apart && isLater(panoramas[a], panoramas[b])) pairs.insert({b, a});
    }
    if (pairs.size() == i) break;
  }
  std::vector<Closure> closures;
  closures.reserve(pairs.size());
  for (const auto& [b, a] : pairs) closures.push_back({a, b, sure(noise.of("sure"), closures.size())});
  return closures;
}

}  // namespace urban_nav_sim
