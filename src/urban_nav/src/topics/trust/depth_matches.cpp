// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/depth_matches.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_registration/cloud/local_cloud.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"
#include "urban_nav_registration/session/session_lasers.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/near_points.hpp"

namespace urban_nav {

using urban_nav_registration::LaserAt;
using urban_nav_registration::LaserScans;
using urban_nav_registration::Surfel;
using urban_nav_registration::Surfels;
using urban_nav_store::NearPoints;
using urban_nav_trust::KeyframeMatches;

namespace {

constexpr std::size_t kMostKeyframes = 20;
constexpr std::size_t kPointsCompared = 400;  // of a keyframe
constexpr double kSurfaceTravel = 6.0;        // m before and after a keyframe
constexpr float kSurfaceVoxel = 0.25F;        // m
constexpr float kLeastPlanarity = 0.9F;
constexpr float kMostSigma = 0.15F;     // m, of a stereo point
constexpr float kSurfaceReach = 0.3F;   // m along the normal
constexpr float kOnSurface = 0.15F;     // m
constexpr float kUprightNormal = 0.5F;  // of |normal z|, below which a surface is a wall

/// Surfaces by the cubes that hold them.
class SurfaceGrid {
 public:
  explicit SurfaceGrid(const Surfels& surfels) {
    for (const Surfel& surfel : surfels.all)
      if (surfel.planarity > kLeastPlanarity) cells_.emplace(toCell(surfel.mean), surfel);
  }
  /// Returns the nearest surface of the cubes around a point.
  const Surfel* find(const Eigen::Vector3f& p) const {
    const Cell centre = toCell(p);
    const Surfel* nearest = nullptr;
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const auto found = cells_.find({centre[0] + dx, centre[1] + dy, centre[2] + dz});
          if (found != cells_.end() &&
              (nearest == nullptr || (found->second.mean - p).squaredNorm() < (nearest->mean - p).squaredNorm()))
            nearest = &found->second;
        }
    return nearest;
  }

 private:
  using Cell = std::array<int, 3>;
  static Cell toCell(const Eigen::Vector3f& p) {
    Cell cell{};
    for (std::size_t i = 0; i < 3; ++i)
      cell[i] = static_cast<int>(std::floor(p[static_cast<Eigen::Index>(i)] / kSurfaceVoxel));
    return cell;
  }
  std::map<Cell, Surfel> cells_;
};

/// Returns the lasers with left and right exchanged; nullopt if there are not both.
std::optional<std::vector<LaserAt>> exchangeSides(std::vector<LaserAt> lasers) {
  const auto find = [&lasers](const char* frame) {
    return std::find_if(lasers.begin(), lasers.end(), [frame](const LaserAt& laser) { return laser.frame == frame; });
  };
  const auto left = find(urban_nav_core::frames::kLaserLeft), right = find(urban_nav_core::frames::kLaserRight);
  if (left == lasers.end() || right == lasers.end()) return std::nullopt;
  std::swap(left->T_base_laser, right->T_base_laser);
  return lasers;
}

SurfaceGrid makeGrid(const urban_nav_core::OdometryChain& chain, urban_nav_core::StampNs stamp,
                     const std::vector<LaserScans>& lasers) {
  return SurfaceGrid(urban_nav_registration::makeSurfels(
      urban_nav_registration::localCloud(chain, stamp, kSurfaceTravel, lasers), kSurfaceVoxel));
}

KeyframeMatches match(const NearPoints& row, const SurfaceGrid& stated, const SurfaceGrid* exchanged) {
  KeyframeMatches result;
  result.stamp = row.stamp;
  const std::vector<NearPoints::Point> points = row.points();
  const std::size_t stride = std::max<std::size_t>(1, points.size() / kPointsCompared);
  const auto offSurface = [](const Surfel* surfel, const Eigen::Vector3f& p) {
    return surfel->normal.dot(p - surfel->mean);
  };
  const auto isOnWall = [&](const Surfel* surfel, const Eigen::Vector3f& p) {
    return surfel != nullptr && std::abs(surfel->normal.z()) < kUprightNormal &&
           std::abs(offSurface(surfel, p)) < kOnSurface;
  };
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector3f& p = points[i].p_base;
    if (points[i].sigma > kMostSigma) continue;
    const Surfel* surfel = stated.find(p);
    if (surfel != nullptr && std::abs(offSurface(surfel, p)) < kSurfaceReach)
      result.matches.push_back(
          {p.cast<double>() - row.camera, surfel->normal.cast<double>(), static_cast<double>(offSurface(surfel, p))});
    if (exchanged == nullptr) continue;
    const bool as_stated = isOnWall(surfel, p), as_exchanged = isOnWall(exchanged->find(p), p);
    result.points += as_stated || as_exchanged ? 1 : 0;
    result.as_stated += as_stated ? 1 : 0;
    result.exchanged += as_exchanged ? 1 : 0;
  }
  return result;
}

}  // namespace

std::vector<KeyframeMatches> matchDepths(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                                         const SessionOdometry& odometry) {
  std::vector<KeyframeMatches> keyframes;
  const std::vector<LaserAt> lasers = urban_nav_registration::storedLasers(store, session);
  if (lasers.empty() || odometry.settled.size() < 2) return keyframes;
  const urban_nav_core::OdometryChain chain = odometryChain(odometry);
  const std::vector<LaserScans> scans = urban_nav_registration::storedScans(store.scans(), session, lasers);
  const std::optional<std::vector<LaserAt>> other_sides = exchangeSides(lasers);
  std::vector<LaserScans> other_scans;
  if (other_sides) other_scans = urban_nav_registration::storedScans(store.scans(), session, *other_sides);
  urban_nav_store::TableStore<NearPoints> rows(store);
  std::vector<urban_nav_core::StampNs> stamps;
  rows.forEach(session, [&](const NearPoints& row) { stamps.push_back(row.stamp); });
  const std::size_t stride = std::max<std::size_t>(1, (stamps.size() + kMostKeyframes - 1) / kMostKeyframes);
  for (std::size_t i = 0; i < stamps.size(); i += stride) {
    NearPoints key;
    key.session = session;
    key.stamp = stamps[i];
    const std::optional<NearPoints> row = rows.get(key);
    if (!row) continue;
    const SurfaceGrid stated = makeGrid(chain, row->stamp, scans);
    const std::optional<SurfaceGrid> exchanged =
        other_sides ? std::optional(makeGrid(chain, row->stamp, other_scans)) : std::nullopt;
    keyframes.push_back(match(*row, stated, exchanged ? &*exchanged : nullptr));
  }
  return keyframes;
}

}  // namespace urban_nav
