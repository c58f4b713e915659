// SPDX-License-Identifier: BSD-3-Clause
#include "gravity/spans.hpp"

#include <algorithm>
#include <cmath>

namespace pose_graph {

using Eigen::Vector3d;
using urban_nav_core::Matrix3d;
using urban_nav_core::Pose;
using urban_nav_core::secondsBetween;
using urban_nav_core::StampedPose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr double kLongestGap = 0.3;      // s
constexpr StampNs kReach = 100'000'000;  // ns on each side of a stamp
constexpr double kMost = 1000.0;         // m/s2: a hundred times gravity is invalid

bool isUsable(const SpecificForce& sample) { return sample.force.allFinite() && sample.force.norm() < kMost; }

/// A pose with a measured specific force, in the axes of the first pose.
struct SpanPlace {
  StampNs stamp;
  Vector3d velocity, force;
  Matrix3d rotation, turning;
};

std::vector<SpanPlace> collectPlaces(const Trajectory& trajectory, const std::vector<SpecificForce>& forces,
                                     const Pose& T_first_world) {
  std::vector<SpanPlace> places;
  for (const SpecificForce& sample : forces) {
    if (!isUsable(sample)) continue;
    const std::size_t i = trajectory.nearest(sample.stamp);
    // The velocity requires both neighbours, which the first and the last pose do not have.
    if (trajectory[i].stamp != sample.stamp || i == 0 || i + 1 == trajectory.size()) continue;
    const StampedPose &before = trajectory[i - 1], &after = trajectory[i + 1];
    const double seconds = secondsBetween(before.stamp, after.stamp);
    if (seconds > 2.0 * kLongestGap) continue;
    const Matrix3d R = (T_first_world * trajectory[i].pose).R();
    const Vector3d v = T_first_world.R() * (after.pose.t() - before.pose.t()) / seconds;
    const Vector3d rate = urban_nav_core::logSo3(before.pose.q().inverse() * after.pose.q()) / seconds;
    places.push_back({sample.stamp, v, R * sample.force, R, R * urban_nav_core::skew(rate)});
  }
  return places;
}

/// Averages over places first...last by the trapezoidal rule.
Span makeSpan(const std::vector<SpanPlace>& places, std::size_t first, std::size_t last) {
  Span span;
  span.begin = places[first].stamp;
  span.end = places[last].stamp;
  for (std::size_t i = first; i < last; ++i) {
    const double half = 0.5 * secondsBetween(places[i].stamp, places[i + 1].stamp);
    span.force += half * (places[i].force + places[i + 1].force);
    span.rotation += half * (places[i].rotation + places[i + 1].rotation);
  }
  const double seconds = secondsBetween(places[first].stamp, places[last].stamp);
  span.force = (span.force - (places[last].velocity - places[first].velocity)) / seconds;
  span.rotation /= seconds;
  span.lever = (places[last].turning - places[first].turning) / seconds;
  return span;
}

}  // namespace

std::vector<SpecificForce> forcesAt(const std::vector<StampNs>& stamps, std::vector<SpecificForce> samples) {
  std::stable_sort(samples.begin(), samples.end(),
                   [](const SpecificForce& a, const SpecificForce& b) { return a.stamp < b.stamp; });
  std::vector<SpecificForce> made;
  std::size_t next = 0;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const StampNs begin = std::max(stamps[i] - kReach, i > 0 ? (stamps[i - 1] + stamps[i]) / 2 : stamps[i] - kReach);
    const StampNs end =
        std::min(stamps[i] + kReach, i + 1 < stamps.size() ? (stamps[i] + stamps[i + 1]) / 2 : stamps[i] + kReach);
    while (next < samples.size() && samples[next].stamp < begin) ++next;
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (; next < samples.size() && samples[next].stamp < end; ++next) {
      if (!isUsable(samples[next])) continue;
      sum += samples[next].force;
      ++count;
    }
    if (count > 0) made.push_back({stamps[i], sum / count});
  }
  return made;
}

std::vector<Span> makeSpans(const Trajectory& trajectory, const std::vector<SpecificForce>& forces,
                            const Pose& T_world_first, double seconds) {
  const std::vector<SpanPlace> places = collectPlaces(trajectory, forces, T_world_first.inverse());
  std::vector<Span> spans;
  std::size_t first = 0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (secondsBetween(places[i - 1].stamp, places[i].stamp) > kLongestGap || places[i].stamp <= places[i - 1].stamp) {
      first = i;
    } else if (secondsBetween(places[first].stamp, places[i].stamp) >= seconds) {
      spans.push_back(makeSpan(places, first, i));
      first = i;
    }
  }
  return spans;
}

}  // namespace pose_graph
