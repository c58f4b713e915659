// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lasers/files/point_files.hpp"

#include <utility>

#include "laser_mapper/map_files.hpp"

namespace urban_nav {

using laser_mapper::MapPoint;

namespace {

constexpr const char* kLocalSystem =
    R"(LOCAL_CS["map of urban_nav",LOCAL_DATUM["first pose",0],UNIT["metre",1],AXIS["x",OTHER],AXIS["y",OTHER],AXIS["z",UP]])";
constexpr std::uint8_t kUnclassified = 1, kGround = 2;  // ASPRS, LAS Specification 1.4 R15, table 17

}  // namespace

PointFiles::PointFiles(const MapFilePaths& paths, const MapAxes& axes, const laser_mapper::GroundGrid* ground,
                       const std::vector<laser_mapper::SensorName>& sensors, std::optional<PointAttributes> more)
    : axes_(axes), ground_(ground), more_(std::move(more)) {
  std::vector<urban_nav_core::LasAttribute> attributes = laser_mapper::mapLasAttributes();
  if (more_) attributes.push_back(more_->las);
  if (!paths.ply.empty()) ply_.emplace(paths.ply, plyLayout(sensors));
  if (!paths.pcd.empty()) pcd_.emplace(paths.pcd, laser_mapper::mapPcdFields());
  if (!paths.las.empty()) las_.emplace(paths.las, attributes, axes.areOfMap() ? kLocalSystem : axes.crs()->wkt());
}

void PointFiles::append(const std::vector<MapPoint>& points) {
  for (const MapPoint& point : points) {
    if (ply_) appendPly(point);
    if (pcd_) appendPcd(point);
    if (las_) appendLas(point);
    ++next_;
  }
}

void PointFiles::commit() {
  if (ply_) ply_->commit();
  if (pcd_) pcd_->commit();
  if (las_) las_->commit();
}

urban_nav_core::PlyLayout PointFiles::plyLayout(const std::vector<laser_mapper::SensorName>& sensors) const {
  urban_nav_core::PlyLayout layout = laser_mapper::mapLayout(sensors);
  if (!more_) return layout;
  layout.properties.insert(layout.properties.end(), more_->ply.properties.begin(), more_->ply.properties.end());
  layout.comments.insert(layout.comments.end(), more_->ply.comments.begin(), more_->ply.comments.end());
  return layout;
}

void PointFiles::appendPly(const MapPoint& point) {
  bytes_.clear();
  laser_mapper::appendVertex(bytes_, point);
  if (more_) more_->append_ply(next_, bytes_);
  ply_->append(bytes_);
}

void PointFiles::appendPcd(const MapPoint& point) {
  bytes_.clear();
  laser_mapper::appendPcdPoint(bytes_, point);
  pcd_->append(bytes_);
}

void PointFiles::appendLas(const MapPoint& point) {
  bytes_.clear();
  laser_mapper::appendLasAttributes(bytes_, point);
  urban_nav_core::LasPoint result = laser_mapper::lasPoint(point);
  if (more_) {
    result.classification = more_->las_classification(next_);
    more_->append_las(next_, bytes_);
  }
  if (!axes_.areOfMap()) result.p = axes_.crs()->project(result.p);
  if (result.classification == kUnclassified && ground_ != nullptr) {
    MapPoint placed = point;
    placed.p = (result.p - axes_.offset()).cast<float>();
    if (ground_->isGround(placed)) result.classification = kGround;
  }
  las_->append(result, bytes_);
}

}  // namespace urban_nav
