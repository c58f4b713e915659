// SPDX-License-Identifier: BSD-3-Clause
#include "lidar/sweep_view.hpp"

#include <algorithm>
#include <cmath>

namespace laser_mapper {

using urban_nav_core::Beam;
using urban_nav_core::Scan;
using urban_nav_core::StampNs;

namespace {

constexpr int kAzimuths = 720;                                 // bins of 0.5 deg
constexpr float kBeyondPoint = 0.3F;                           // m: more than errors of poses and the beam width
constexpr double kMostElevationSpread = 0.01;                  // rad, standard deviation of the elevations of a ring
constexpr float kMostRingAngle = 0.06F;                        // rad, between adjacent rings: wider gaps are unknown
constexpr float kNearestRange = 1.0F, kFarthestRange = 30.0F;  // m

std::size_t azimuthBin(double x, double y) {
  const double share = (std::atan2(y, x) + M_PI) / (2.0 * M_PI);
  return static_cast<std::size_t>(std::clamp(static_cast<int>(share * kAzimuths), 0, kAzimuths - 1));
}

}  // namespace

SweepView::SweepView(const std::vector<Scan>& rings, const urban_nav_core::Trajectory& T_map_base,
                     const urban_nav_core::Pose& T_base_lidar, const urban_nav_core::Pose& T_frame_map,
                     StampNs max_gap) {
  std::array<StampNs, kSectors> since_first{};
  std::array<std::int64_t, kSectors> beams{};
  StampNs first = 0, all = 0;
  std::int64_t count = 0;
  for (const Scan& ring : rings) {
    addRing(ring);
    for (const Beam& beam : ring.beams) {
      if (count == 0) first = beam.stamp;
      const std::size_t sector =
          azimuthBin(static_cast<double>(beam.direction.x()), static_cast<double>(beam.direction.y())) * kSectors /
          kAzimuths;
      since_first[sector] += beam.stamp - first;
      ++beams[sector];
      all += beam.stamp - first;
      ++count;
    }
  }
  std::stable_sort(rings_.begin(), rings_.end(),
                   [](const Ring& a, const Ring& b) { return a.elevation < b.elevation; });
  if (count == 0) return;
  const auto poseAt = [&](StampNs stamp) -> std::optional<urban_nav_core::Pose> {
    const auto T_map_then = T_map_base.at(stamp, max_gap);
    if (!T_map_then) return std::nullopt;
    return (T_frame_map * *T_map_then * T_base_lidar).inverse();
  };
  T_lidar_frame_middle_ = poseAt(first + all / count);
  for (std::size_t sector = 0; sector < kSectors; ++sector)
    if (beams[sector] > 0) T_lidar_frame_[sector] = poseAt(first + since_first[sector] / beams[sector]);
}

void SweepView::addRing(const Scan& beams) {
  if (beams.beams.size() < 2) return;
  Ring ring;
  ring.ranges.assign(kAzimuths, 0.0F);
  double sum = 0.0, squares = 0.0;
  for (const Beam& beam : beams.beams) {
    const Eigen::Vector3d d = beam.direction.cast<double>();
    const double elevation = std::atan2(d.z(), std::hypot(d.x(), d.y()));
    sum += elevation;
    squares += elevation * elevation;
    float& shortest = ring.ranges[azimuthBin(d.x(), d.y())];
    if (shortest == 0.0F || beam.range < shortest) shortest = beam.range;
  }
  const double share = 1.0 / static_cast<double>(beams.beams.size()), mean = share * sum;
  if (share * squares - mean * mean > kMostElevationSpread * kMostElevationSpread) return;
  ring.elevation = static_cast<float>(mean);
  rings_.push_back(std::move(ring));
}

Sight SweepView::classify(const Eigen::Vector3d& p_frame) const {
  if (!T_lidar_frame_middle_) return Sight::None;
  const Eigen::Vector3d about = *T_lidar_frame_middle_ * p_frame;
  const std::optional<urban_nav_core::Pose>& T_lidar_frame =
      T_lidar_frame_[azimuthBin(about.x(), about.y()) * kSectors / kAzimuths];
  if (!T_lidar_frame) return Sight::None;
  const Eigen::Vector3d p = *T_lidar_frame * p_frame;
  const auto range = static_cast<float>(p.norm());
  if (range < kNearestRange || range > kFarthestRange) return Sight::None;
  const auto elevation = static_cast<float>(std::atan2(p.z(), std::hypot(p.x(), p.y())));
  const auto above = std::lower_bound(rings_.begin(), rings_.end(), elevation,
                                      [](const Ring& ring, float wanted) { return ring.elevation < wanted; });
  if (above == rings_.begin() || above == rings_.end()) return Sight::None;
  const auto below = std::prev(above);
  if (above->elevation - below->elevation > kMostRingAngle) return Sight::None;
  const std::size_t azimuth = azimuthBin(p.x(), p.y());
  bool hit = false, through = true;
  for (const Ring* ring : {&*below, &*above})
    for (const std::size_t step : {std::size_t{kAzimuths - 1}, std::size_t{0}, std::size_t{1}}) {
      const float found = ring->ranges[(azimuth + step) % kAzimuths];
      through = through && found >= range + kBeyondPoint;
      hit = hit || std::abs(found - range) < kBeyondPoint;
    }
  if (through) return Sight::Through;
  return hit ? Sight::Hit : Sight::None;
}

}  // namespace laser_mapper
