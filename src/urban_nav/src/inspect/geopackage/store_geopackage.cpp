// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/geopackage/store_geopackage.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <map>
#include <memory>

#include "inspect/geopackage/coverage_outline.hpp"
#include "inspect/store_results.hpp"
#include "topics/lasers/map_crs.hpp"
#include "urban_nav/stored_results.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/io/csv.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

using urban_nav_core::Matrix6d;
using urban_nav_core::StampNs;
using urban_nav_core::Vector3d;
using urban_nav_store::Store;
using urban_nav_store::StoredTrajectory;

namespace {

using Maps = std::vector<std::vector<StoredTrajectory>>;
using Project = std::function<Vector3d(const Vector3d&)>;
using Column = GeoPackageFile::Column;
using Type = GeoPackageFile::ColumnType;
using Value = GeoPackageFile::Value;

constexpr double kReach = 5.0, kCell = 1.0;  // m: of the coverage around the path, and of its grid
constexpr double kQualitySpacing = 1.0;      // m
constexpr double kQualityDegrees = 57.29577951308232;

/// A session, its name in closures.csv, and the projection of its positions.
struct DrawnSession {
  const StoredTrajectory* trajectory;
  std::string name;
  Project project;
};

/// Returns the sessions of all maps, in the order of their start.
std::vector<DrawnSession> drawnSessions(Store& store, const Maps& maps,
                                        const std::vector<std::shared_ptr<MapCrs>>& crs) {
  const std::map<urban_nav_store::SessionId, std::string> names = sessionNamesById(store);
  std::vector<DrawnSession> drawn;
  for (std::size_t m = 0; m < maps.size(); ++m)
    for (const StoredTrajectory& session : maps[m]) {
      if (session.T_map_base.empty()) continue;
      const std::shared_ptr<MapCrs> of_map = crs[m];
      drawn.push_back({&session, names.at(session.session.id),
                       [of_map](const Vector3d& p) { return of_map == nullptr ? p : of_map->project(p); }});
    }
  std::sort(drawn.begin(), drawn.end(), [](const DrawnSession& a, const DrawnSession& b) {
    const urban_nav_store::Session &first = a.trajectory->session, &second = b.trajectory->session;
    return first.start != second.start ? first.start < second.start : first.id < second.id;
  });
  return drawn;
}

std::vector<Vector3d> positions(const DrawnSession& session) {
  std::vector<Vector3d> all;
  for (const urban_nav_core::StampedPose& pose : session.trajectory->T_map_base) all.push_back(pose.pose.t());
  return all;
}

Geometry projectedLine(const std::vector<Vector3d>& points, const Project& project) {
  std::vector<Vector3d> projected;
  for (const Vector3d& p : points) projected.push_back(project(p));
  if (projected.size() == 1) projected.push_back(projected.front());
  return Geometry::line(projected);
}

double pathLength(const std::vector<Vector3d>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

void addTrajectories(const std::vector<DrawnSession>& sessions, GeoPackageFile& file) {
  file.addLayer("trajectories", "LINESTRING", true,
                {{"session", Type::Text},
                 {"name", Type::Text},
                 {"robot", Type::Text},
                 {"map", Type::Text},
                 {"start_ns", Type::Integer},
                 {"end_ns", Type::Integer},
                 {"distance_m", Type::Real}});
  for (const DrawnSession& each : sessions) {
    const StoredTrajectory& session = *each.trajectory;
    const std::vector<Vector3d> points = positions(each);
    file.addFeature(projectedLine(points, each.project),
                    {session.session.id, each.name, session.session.robot, session.map,
                     session.T_map_base.front().stamp, session.T_map_base.back().stamp, pathLength(points)});
  }
}

/// Returns the position of the pose nearest in time.
Vector3d positionAt(const StoredTrajectory& session, StampNs stamp) {
  const auto after =
      std::lower_bound(session.T_map_base.begin(), session.T_map_base.end(), stamp,
                       [](const urban_nav_core::StampedPose& pose, StampNs value) { return pose.stamp < value; });
  if (after == session.T_map_base.end()) return session.T_map_base.back().pose.t();
  if (after == session.T_map_base.begin() || after->stamp - stamp <= stamp - (after - 1)->stamp) return after->pose.t();
  return (after - 1)->pose.t();
}

void addClosures(Store& store, const std::vector<DrawnSession>& sessions, GeoPackageFile& file) {
  file.addLayer("closures", "LINESTRING", true,
                {{"session_a", Type::Text},
                 {"stamp_a_ns", Type::Integer},
                 {"session_b", Type::Text},
                 {"stamp_b_ns", Type::Integer},
                 {"kind", Type::Text},
                 {"verdict", Type::Text},
                 {"reason", Type::Text},
                 {"probability", Type::Real},
                 {"weight", Type::Real}});
  const urban_nav_core::CsvTable rows = urban_nav_core::CsvTable::parse(readStoredClosures(store), "closures.csv");
  const auto find = [&](const std::string& name) {
    return std::find_if(sessions.begin(), sessions.end(), [&](const DrawnSession& each) { return each.name == name; });
  };
  for (std::size_t i = 0; i < rows.rows(); ++i) {
    const auto text = [&](const char* column) { return rows.text(i, rows.column(column)); };
    const auto a = find(text("session_a")), b = find(text("session_b"));
    if (a == sessions.end() || b == sessions.end()) continue;  // not among those of --session
    const StampNs stamp_a = urban_nav_core::parseInteger(text("stamp_a_ns")).value_or(0);
    const StampNs stamp_b = urban_nav_core::parseInteger(text("stamp_b_ns")).value_or(0);
    const auto number = [&](const char* column) { return urban_nav_core::parseNumber(text(column)).value_or(0.0); };
    file.addFeature(Geometry::line({a->project(positionAt(*a->trajectory, stamp_a)),
                                    b->project(positionAt(*b->trajectory, stamp_b))}),
                    {a->trajectory->session.id, stamp_a, b->trajectory->session.id, stamp_b, text("kind"),
                     text("verdict"), text("reason"), number("probability"), number("weight")});
  }
}

void addCoverage(const std::vector<DrawnSession>& sessions, GeoPackageFile& file) {
  file.addLayer("coverage", "MULTIPOLYGON", false,
                {{"session", Type::Text}, {"map", Type::Text}, {"area_m2", Type::Real}});
  for (const DrawnSession& each : sessions) {
    std::vector<Eigen::Vector2d> path;
    for (const Vector3d& p : positions(each)) path.push_back(p.head<2>());
    Coverage coverage = coverageAround(path, kReach, kCell);
    const double height = positions(each).front().z();
    for (Geometry::Polygon& polygon : coverage.polygons)
      for (Geometry::Ring& ring : polygon)
        for (Eigen::Vector2d& p : ring) p = each.project({p.x(), p.y(), height}).head<2>();
    file.addFeature(Geometry::polygons(coverage.polygons),
                    {each.trajectory->session.id, each.trajectory->map, coverage.area_m2});
  }
}

double largestSigma(const Eigen::Matrix3d& covariance) {
  const auto values = urban_nav_core::symmetricEigenvalues(covariance);
  return values ? std::sqrt(std::max(0.0, (*values)[2])) : 0.0;
}

void addQuality(Store& store, const std::vector<DrawnSession>& sessions, GeoPackageFile& file) {
  file.addLayer("quality", "POINT", true,
                {{"session", Type::Text},
                 {"stamp_ns", Type::Integer},
                 {"status", Type::Text},
                 {"sigma_m", Type::Real},
                 {"sigma_deg", Type::Real}});
  for (const DrawnSession& each : sessions) {
    const urban_nav_store::SessionId& id = each.trajectory->session.id;
    std::map<StampNs, Matrix6d> relaxed;
    store.graph().forEachRelaxed(
        id, [&](const urban_nav_store::RelaxedPose& pose) { relaxed[pose.stamp] = pose.covariance; });
    std::size_t next = 0;
    double driven = 0.0, due = 0.0;
    store.graph().forEachNode(id, [&](const urban_nav_store::Node& node) {
      const std::vector<urban_nav_core::StampedPose>& poses = each.trajectory->T_map_base;
      if (next > 0) driven += distanceBetween(poses[next - 1].pose, poses[next].pose);
      const Vector3d p = poses[next++].pose.t();
      if (driven < due) return;
      due = std::floor(driven / kQualitySpacing) * kQualitySpacing + kQualitySpacing;
      const auto found = relaxed.find(node.stamp);
      const Matrix6d& covariance = found == relaxed.end() ? node.covariance_from_first : found->second;
      file.addFeature(
          Geometry::point(each.project(p)),
          {id, node.stamp, std::string(toString(node.status)), largestSigma(covariance.topLeftCorner<3, 3>()),
           kQualityDegrees * largestSigma(covariance.bottomRightCorner<3, 3>())});
    });
  }
}

/// "2008-11-03T13:44:33.000Z".
std::string isoTime(StampNs stamp) {
  const auto seconds = static_cast<std::time_t>(stamp / 1'000'000'000);
  std::tm utc{};
  if (gmtime_r(&seconds, &utc) == nullptr) return "1970-01-01T00:00:00.000Z";
  char text[32] = "";
  std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%S.000Z", &utc);
  return text;
}

}  // namespace

void writeGeoPackage(Store& store, const Maps& maps, const std::string& path, const std::string& crs,
                     const std::string& control) {
  std::vector<std::shared_ptr<MapCrs>> of_maps(maps.size());
  LayerCrs layer_crs;
  if (!crs.empty() && crs != "local")
    for (std::size_t m = 0; m < maps.size(); ++m) {
      const std::string wanted = m == 0 ? crs : "EPSG:" + std::to_string(layer_crs.epsg);
      of_maps[m] = std::make_shared<MapCrs>(wanted, control, store, maps[m]);
      if (m == 0) layer_crs = {of_maps[m]->epsg(), of_maps[m]->wkt()};
    }
  const std::vector<DrawnSession> sessions = drawnSessions(store, maps, of_maps);
  StampNs last = 0;
  for (const DrawnSession& session : sessions) last = std::max(last, session.trajectory->T_map_base.back().stamp);
  GeoPackageFile file(path, layer_crs, isoTime(last));
  addTrajectories(sessions, file);
  addClosures(store, sessions, file);
  addCoverage(sessions, file);
  addQuality(store, sessions, file);
  file.commit();
}

}  // namespace urban_nav
