// SPDX-License-Identifier: BSD-3-Clause
#include "laser_mapper/quality/shared_beams.hpp"

#include <algorithm>

namespace laser_mapper {

using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

double SharedBeams::PathLengths::at(StampNs stamp) const {
  const auto after = std::upper_bound(stamps.begin(), stamps.end(), stamp);
  return after == stamps.begin() ? 0.0 : lengths[static_cast<std::size_t>(after - stamps.begin()) - 1];
}

bool SharedBeams::Interval::overlaps(const Interval& other) const {
  return session == other.session && from < other.to && other.from < to;
}

SharedBeams::SharedBeams(const std::vector<const Trajectory*>& T_map_base, const std::vector<CloudClosure>& closures,
                         double cloud_half_length) {
  for (const Trajectory* trajectory : T_map_base) {
    PathLengths path;
    for (std::size_t i = 0; i < trajectory->size(); ++i) {
      const urban_nav_core::StampedPose& pose = (*trajectory)[i];
      path.stamps.push_back(pose.stamp);
      path.lengths.push_back(i == 0 ? 0.0
                                    : path.lengths.back() + distanceBetween((*trajectory)[i - 1].pose, pose.pose));
    }
    paths_.push_back(std::move(path));
  }
  const auto cloud = [&](std::size_t session, StampNs stamp) {
    const double middle = paths_.at(session).at(stamp);
    return Interval{session, middle - cloud_half_length, middle + cloud_half_length};
  };
  for (const CloudClosure& closure : closures)
    clouds_.emplace_back(cloud(closure.session_a, closure.stamp_a), cloud(closure.session_b, closure.stamp_b));
}

SharedBeams::Interval SharedBeams::stretch(std::size_t session, std::int64_t number) const {
  const PathLengths& path = paths_.at(session);
  if (path.stamps.empty()) return {session, 0.0, 0.0};
  const StampNs begin = path.stamps.front() + number * kPlaneGroupTime;
  return {session, path.at(begin), path.at(begin + kPlaneGroupTime)};
}

bool SharedBeams::areUsedBy(const PlaneConstraint& constraint) const {
  const Interval a = stretch(constraint.session_a, constraint.stretch_a),
                 b = stretch(constraint.session_b, constraint.stretch_b);
  return std::any_of(clouds_.begin(), clouds_.end(), [&](const std::pair<Interval, Interval>& cloud) {
    return (cloud.first.overlaps(a) && cloud.second.overlaps(b)) ||
           (cloud.first.overlaps(b) && cloud.second.overlaps(a));
  });
}

}  // namespace laser_mapper
