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
#include "urban_nav_registration/session/stored_keyframe.hpp"
#include "urban_nav_store/table_store.hpp"
#include "urban_nav_store/tables/near_points.hpp"

namespace urban_nav {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_registration::LaserAt;
using urban_nav_registration::LaserScans;
using urban_nav_registration::Surfel;
using urban_nav_registration::Surfels;
using urban_nav_store::NearPoints;
using urban_nav_trust::KeyframeMatches;

namespace {

constexpr std::size_t kMostDense = 20, kMostCorners = 40;  // keyframes
constexpr std::size_t kPointsCompared = 400;               // points of a keyframe
constexpr double kSurfaceTravel = 6.0;                     // m before and after a keyframe
constexpr float kSurfaceVoxel = 0.25F;                     // m
constexpr float kLeastPlanarity = 0.9F;
constexpr float kSurfaceReach = 0.3F;  // m along the normal
constexpr float kMostSigma =
    kSurfaceReach / 3.0F;               // m, of a stereo point along the normal; the reach truncates nothing
constexpr float kOnSurface = 0.15F;     // m
constexpr double kDrivenThrough = 0.3;  // |x| of the axis of a scan plane that is not horizontal or along the path
constexpr float kUprightNormal = 0.5F;  // |normal z| below which a surface is a wall

/// Surfaces by grid cubes.
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

SurfaceGrid makeGrid(const urban_nav_core::OdometryChain& chain, StampNs stamp, const std::vector<LaserScans>& lasers) {
  return SurfaceGrid(urban_nav_registration::makeSurfels(
      urban_nav_registration::localCloud(chain, stamp, kSurfaceTravel, lasers), kSurfaceVoxel));
}

/// A point by stereo, with its standard deviation along the line of sight, m.
struct StereoPoint {
  Eigen::Vector3f p_base = Eigen::Vector3f::Zero();
  float sigma = 0.0F;
};

/// Stereo points of a keyframe.
struct StereoView {
  StampNs stamp = 0;
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();  ///< in base_link, m
  std::vector<StereoPoint> points;
};

/// Surfaces of one laser.
struct SurfacesByLaser {
  SurfaceGrid surfaces;
  Pose T_base_laser;
};

/// Laser surfaces with the stated mounting, and of all lasers with left and right exchanged if there are both.
struct LaserSurfaces {
  std::vector<SurfacesByLaser> stated;
  std::optional<SurfaceGrid> exchanged;
};

/// A surface near a point, and the number of the laser that measured it.
struct FoundSurface {
  const Surfel* surfel = nullptr;
  int laser = -1;
};

FoundSurface findNearest(const std::vector<SurfacesByLaser>& lasers, const Eigen::Vector3f& p) {
  FoundSurface nearest;
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    const Surfel* surfel = lasers[i].surfaces.find(p);
    if (surfel == nullptr) continue;
    if (nearest.surfel == nullptr || (surfel->mean - p).squaredNorm() < (nearest.surfel->mean - p).squaredNorm())
      nearest = {surfel, static_cast<int>(i)};
  }
  return nearest;
}

/// Returns the displacement of a surface along its normal, m per rad, if the laser turns about the axis a of its scan
/// plane. A laser whose plane the robot drives through measured a point p where p, displaced along the path, lies in
/// the plane: by a x d, d from the laser to that point.
double leverInPlane(const Surfel& surfel, const Pose& T_base_laser) {
  const Eigen::Vector3d axis = T_base_laser.R().col(2), from_laser = surfel.mean.cast<double>() - T_base_laser.t();
  const Eigen::Vector3d along =
      std::abs(axis.x()) > kDrivenThrough ? Eigen::Vector3d(Eigen::Vector3d::UnitX() / axis.x()) : axis;
  const Eigen::Vector3d in_plane = from_laser - axis.dot(from_laser) * along;
  return surfel.normal.cast<double>().dot(axis.cross(in_plane));
}

KeyframeMatches match(const StereoView& view, const LaserSurfaces& surfaces) {
  KeyframeMatches result;
  result.stamp = view.stamp;
  const std::size_t stride = std::max<std::size_t>(1, view.points.size() / kPointsCompared);
  const auto offSurface = [](const Surfel* surfel, const Eigen::Vector3f& p) {
    return surfel->normal.dot(p - surfel->mean);
  };
  for (std::size_t i = 0; i < view.points.size(); i += stride) {
    const Eigen::Vector3f& p = view.points[i].p_base;
    const Eigen::Vector3f ray = (p - view.camera.cast<float>()).normalized();
    const auto sigmaAcross = [&](const Surfel* surfel) {
      return view.points[i].sigma * std::abs(surfel->normal.dot(ray));
    };
    const auto isOnWall = [&](const Surfel* surfel) {
      return surfel != nullptr && sigmaAcross(surfel) < kMostSigma && std::abs(surfel->normal.z()) < kUprightNormal &&
             std::abs(offSurface(surfel, p)) < kOnSurface;
    };
    const FoundSurface found = findNearest(surfaces.stated, p);
    const Surfel* surfel = found.surfel;
    if (surfel != nullptr && sigmaAcross(surfel) < kMostSigma && std::abs(offSurface(surfel, p)) < kSurfaceReach)
      result.matches.push_back(
          {p.cast<double>() - view.camera, surfel->normal.cast<double>(), static_cast<double>(offSurface(surfel, p)),
           static_cast<double>(sigmaAcross(surfel)), found.laser,
           leverInPlane(*surfel, surfaces.stated[static_cast<std::size_t>(found.laser)].T_base_laser)});
    if (!surfaces.exchanged) continue;
    const bool as_stated = isOnWall(surfel), as_exchanged = isOnWall(surfaces.exchanged->find(p));
    result.points += as_stated || as_exchanged ? 1 : 0;
    result.as_stated += as_stated ? 1 : 0;
    result.exchanged += as_exchanged ? 1 : 0;
  }
  return result;
}

/// Returns up to `most` of the stamps, evenly spread.
std::vector<StampNs> spread(const std::vector<StampNs>& stamps, std::size_t most) {
  std::vector<StampNs> some;
  const std::size_t stride = std::max<std::size_t>(1, (stamps.size() + most - 1) / most);
  for (std::size_t i = 0; i < stamps.size(); i += stride) some.push_back(stamps[i]);
  return some;
}

/// Returns views of dense stereo: near points, with a short range mostly of the ground.
std::vector<StereoView> denseViews(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  urban_nav_store::TableStore<NearPoints> rows(store);
  std::vector<StampNs> stamps;
  rows.forEach(session, [&](const NearPoints& row) { stamps.push_back(row.stamp); });
  std::vector<StereoView> views;
  for (const StampNs stamp : spread(stamps, kMostDense)) {
    NearPoints key;
    key.session = session;
    key.stamp = stamp;
    const std::optional<NearPoints> row = rows.get(key);
    if (!row) continue;
    StereoView view{stamp, row->camera, {}};
    for (const NearPoints::Point& point : row->points()) view.points.push_back({point.p_base, point.sigma});
    views.push_back(std::move(view));
  }
  return views;
}

/// Returns views of corners, which are matched at any range, as on walls along the path.
std::vector<StereoView> cornerViews(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                                    const SessionOdometry& odometry) {
  using urban_nav_registration::kKeyframeCamera;
  const urban_nav_core::StereoCamera& camera = odometry.camera;
  std::vector<StereoView> views;
  for (const StampNs stamp : spread(store.keyframes().stamps(session, kKeyframeCamera), kMostCorners)) {
    const auto stored = store.keyframes().get(session, kKeyframeCamera, stamp);
    if (!stored) continue;
    StereoView view{stamp, odometry.T_base_camera.t(), {}};
    for (const urban_nav_registration::KeyframePoint& point :
         urban_nav_registration::toKeyframe(*stored, session).points) {
      const Eigen::Vector2d pixel = point.pixel();
      const double disparity = static_cast<double>(point.disparity);
      const std::optional<Eigen::Vector3d> p = camera.triangulate({pixel.x(), pixel.y(), pixel.x() - disparity});
      if (!p || !(disparity > camera.disparity_offset)) continue;
      const double sigma =
          static_cast<double>(point.sigma_disparity) * p->norm() / (disparity - camera.disparity_offset);
      view.points.push_back({(odometry.T_base_camera * *p).cast<float>(), static_cast<float>(sigma)});
    }
    views.push_back(std::move(view));
  }
  return views;
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
  const auto statedSurfaces = [&](StampNs stamp) {
    std::vector<SurfacesByLaser> stated;
    for (std::size_t i = 0; i < scans.size(); ++i)
      stated.push_back({makeGrid(chain, stamp, {scans[i]}), lasers[i].T_base_laser});
    return stated;
  };
  for (const StereoView& view : denseViews(store, session))
    keyframes.push_back(match(view, {statedSurfaces(view.stamp), std::nullopt}));
  for (const StereoView& view : cornerViews(store, session, odometry)) {
    LaserSurfaces surfaces{statedSurfaces(view.stamp), std::nullopt};
    if (other_sides) surfaces.exchanged = makeGrid(chain, view.stamp, other_scans);
    keyframes.push_back(match(view, surfaces));
  }
  std::sort(keyframes.begin(), keyframes.end(),
            [](const KeyframeMatches& a, const KeyframeMatches& b) { return a.stamp < b.stamp; });
  return keyframes;
}

std::vector<std::string> comparedLasers(urban_nav_store::Store& store, const urban_nav_store::SessionId& session) {
  std::vector<std::string> names;
  for (const LaserAt& laser : urban_nav_registration::storedLasers(store, session)) names.push_back(laser.frame);
  return names;
}

}  // namespace urban_nav
