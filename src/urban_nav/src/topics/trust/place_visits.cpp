// SPDX-License-Identifier: BSD-3-Clause
#include "topics/trust/place_visits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "urban_nav_registration/cloud/free_space.hpp"
#include "urban_nav_registration/cloud/local_cloud.hpp"
#include "urban_nav_registration/cloud/surfels.hpp"
#include "urban_nav_registration/session/session_lasers.hpp"

namespace urban_nav {

using urban_nav_core::PointCloud;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;
using urban_nav_registration::FreeSpace;
using urban_nav_registration::Surfel;
using urban_nav_trust::PlaceVisits;

namespace {

constexpr double kVisitHalfLength = 6.0;               // m of path, of a local cloud
constexpr double kVisitNear = 3.0;                     // m
constexpr double kVisitPath = 4.0 * kVisitHalfLength;  // m between the visits: their clouds share no scans
constexpr StampNs kVisitApart = 20'000'000'000;        // as laser_mapper.ghost_gap
constexpr double kVisitStep = 0.5;                     // m between poses of the path that are compared
constexpr std::size_t kMostVisits = 12;
constexpr float kVisitVoxel = 0.25F;                    // m
constexpr float kFreeCube = 2.0F * kVisitVoxel;         // m, as in ICP of local clouds
constexpr double kLargestVisitSigma = kFreeCube / 3.0;  // m, of the relative position: within the adjacent cubes
constexpr float kWallPlanarity = 0.9F, kWallNormalZ = 0.5F;

/// Pose of a thinned path.
struct Post {
  StampNs stamp = 0;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< in the map, m
  double travelled = 0.0;                       ///< m since the beginning
};

/// Cubes that hold surfaces.
class SurfaceCubes {
 public:
  void add(const Eigen::Vector3f& p) { cubes_.insert(toCube(p)); }
  bool isNear(const Eigen::Vector3f& p) const {
    const Cube centre = toCube(p);
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz)
          if (cubes_.count({centre[0] + dx, centre[1] + dy, centre[2] + dz}) > 0) return true;
    return false;
  }

 private:
  using Cube = std::array<int, 3>;
  static Cube toCube(const Eigen::Vector3f& p) {
    const auto index = [](float value) { return static_cast<int>(std::floor(value / kVisitVoxel)); };
    return {index(p.x()), index(p.y()), index(p.z())};
  }
  std::set<Cube> cubes_;
};

/// Walls and free space of a visit.
struct Visit {
  std::vector<Eigen::Vector3f> walls;
  SurfaceCubes cubes;
  FreeSpace free;

  explicit Visit(const PointCloud& cloud) : free(cloud, kFreeCube) {
    for (const Surfel& surfel : urban_nav_registration::makeSurfels(cloud, kVisitVoxel).all) {
      if (surfel.planarity < kWallPlanarity || std::abs(surfel.normal.z()) > kWallNormalZ) continue;
      walls.push_back(surfel.mean);
      cubes.add(surfel.mean);
    }
  }
};

/// Adds the walls of one visit, half of each since both visits are counted.
void countWalls(const std::vector<Eigen::Vector3f>& walls, const Visit& other, const Pose& T_other_walls,
                PlaceVisits& counted) {
  const Eigen::Matrix3f R = T_other_walls.R().cast<float>();
  const Eigen::Vector3f t = T_other_walls.t().cast<float>();
  for (const Eigen::Vector3f& wall : walls) {
    const Eigen::Vector3f p = R * wall + t;
    if (other.cubes.isNear(p)) counted.confirmed += 0.5;
    else if (other.free.isFree(p)) counted.contradicted += 0.5;
  }
}

/// Returns the stated standard deviation of the position of b relative to a, m: both relative to the first pose, as if
/// independent, which is an upper bound for errors that grow along the path.
double relativeSigma(const SessionTrajectory& session, StampNs a, StampNs b) {
  double variance = 0.0;
  for (const StampNs stamp : {a, b}) {
    const std::size_t i = session.T_map_base.nearest(stamp);
    if (i >= session.covariances.size()) return HUGE_VAL;
    variance += session.covariances[i].topLeftCorner<3, 3>().trace() / 3.0;
  }
  return std::sqrt(variance);
}

}  // namespace

std::vector<VisitPair> findVisits(const Trajectory& T_map_base) {
  std::vector<Post> posts;
  double travelled = 0.0;
  for (std::size_t i = 0; i < T_map_base.size(); ++i) {
    if (i > 0) travelled += (T_map_base[i].pose.t() - T_map_base[i - 1].pose.t()).norm();
    if (posts.empty() || travelled - posts.back().travelled >= kVisitStep)
      posts.push_back({T_map_base[i].stamp, T_map_base[i].pose.t(), travelled});
  }
  std::vector<VisitPair> pairs;
  double last = -HUGE_VAL;
  for (const Post& later : posts) {
    if (later.travelled - last < 2.0 * kVisitHalfLength) continue;
    const Post* nearest = nullptr;
    double least = kVisitNear;
    for (const Post& earlier : posts) {
      if (earlier.travelled + kVisitPath > later.travelled || earlier.stamp + kVisitApart > later.stamp) break;
      const double distance = (later.p - earlier.p).norm();
      if (distance >= least) continue;
      nearest = &earlier;
      least = distance;
    }
    if (nearest == nullptr) continue;
    pairs.push_back({nearest->stamp, later.stamp});
    last = later.travelled;
  }
  std::vector<VisitPair> some;
  const std::size_t stride = std::max<std::size_t>(1, (pairs.size() + kMostVisits - 1) / kMostVisits);
  for (std::size_t i = 0; i < pairs.size(); i += stride) some.push_back(pairs[i]);
  return some;
}

PlaceVisits compareVisits(const PointCloud& a, const PointCloud& b, const Pose& T_a_b) {
  PlaceVisits counted;
  if (a.points.empty() || b.points.empty()) return counted;
  const Visit earlier(a), later(b);
  countWalls(later.walls, earlier, T_a_b, counted);
  countWalls(earlier.walls, later, T_a_b.inverse(), counted);
  return counted;
}

void compareFreeSpace(const MapContext& context, std::size_t session, urban_nav_trust::TestResults& results) {
  const urban_nav_store::SessionId id = context.ids()[session];
  const SessionOdometry& odometry = *context.runs()[session];
  const SessionTrajectory& path = context.trajectories[session];
  const std::vector<urban_nav_registration::LaserAt> lasers = urban_nav_registration::storedLasers(*context.store, id);
  if (lasers.empty() || odometry.settled.size() < 2) return testFreeSpace({}, "no lasers", results);
  const urban_nav_core::OdometryChain chain = odometryChain(odometry);
  const auto scans = urban_nav_registration::storedScans(context.store->scans(), id, lasers);
  const auto cloudAt = [&](StampNs stamp) {
    return urban_nav_registration::localCloud(chain, stamp, kVisitHalfLength, scans);
  };
  std::vector<PlaceVisits> places;
  const std::vector<VisitPair> pairs = findVisits(path.T_map_base);
  for (const VisitPair& pair : pairs) {
    if (relativeSigma(path, pair.earlier, pair.later) > kLargestVisitSigma) continue;
    const Pose T_a_b = path.T_map_base[path.T_map_base.nearest(pair.earlier)].pose.inverse() *
                       path.T_map_base[path.T_map_base.nearest(pair.later)].pose;
    places.push_back(compareVisits(cloudAt(pair.earlier), cloudAt(pair.later), T_a_b));
    places.back().interval = {pair.earlier, pair.later};
  }
  testFreeSpace(places,
                pairs.empty() ? "the lasers passed no place twice"
                              : "the position of the second visit of a place is too uncertain to compare walls",
                results);
}

}  // namespace urban_nav
