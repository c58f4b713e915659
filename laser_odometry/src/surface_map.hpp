// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "moments.hpp"
#include "motion_space.hpp"
#include "sweep_points.hpp"
#include "urban_nav_registration/cloud/cell_table.hpp"

namespace laser_odometry {

/// A cube of the local map at one level: moments of its points, relative to its centre.
struct MapCell {
  std::uint64_t key = 0;
  Vector3d centre = Vector3d::Zero();  ///< in odom, m
  Moments moments;
  /// Ring of the points; kNoRing without points, kSeveralRings if they are of different or unknown rings.
  std::int32_t ring = kNoRing;
  std::int32_t first_sweep = 0, last_sweep = 0;  ///< first and last sweep with points here
  /// Mean distance of the patches of a sweep from the plane, m, and the number of that sweep (-1: none).
  double residual = 0.0;
  std::int32_t residual_sweep = -1;

  bool is_current = false;  ///< `plane` is up to date with `moments`
  Plane plane;

  static constexpr std::int32_t kNoRing = -1, kSeveralRings = -2;

  void addRing(std::int32_t other) {
    const bool is_same = (ring == kNoRing || ring == other) && other != Segment::kUnknownRing;
    ring = is_same ? other : kSeveralRings;
  }
  /// Fits a plane to the points. Not usable if they are of a single ring: where surfaces are uneven or meet, they
  /// spread in the cone of the ring, which is no surface and moves with the sensor. `space`: in planar motion, a wall.
  Plane fit(MotionSpace space) const {
    if (space == MotionSpace::Planar) return fitWall(moments, centre);
    return ring == kSeveralRings ? fitPlane(moments, centre) : Plane();
  }
  const Plane& currentPlane(MotionSpace space);
  void archive(urban_nav_core::Archive& archive);
};

/// Local map of surface elements, in odom: cubes of several sizes, each twice as large as at the level below, with the
/// moments of their points. Not thread-safe.
class SurfaceMap {
 public:
  /// `cell`: edge of the smallest cubes, m. `reach`: maximum distance at which points are added to the smallest cubes,
  /// m; doubles with each level, since beams diverge.
  SurfaceMap(double cell, int levels, double reach, MotionSpace space = MotionSpace::Spatial);

  bool empty() const { return levels_.front().cells.empty() && levels_.back().cells.empty(); }
  std::size_t size() const;
  void clear();

  /// Adds the segments of one sweep (in odom), measured from `origin`, each to the cubes that hold its mean.
  void insert(const std::vector<Segment>& segments, const Vector3d& origin, std::int32_t sweep);

  /// Returns the cube of the finest level not below `level` with a usable plane whose extent contains a point; null if
  /// there is none.
  MapCell* find(const Vector3d& p, int level);

  /// Removes the cubes further than `distance` from `p`, m.
  void prune(const Vector3d& p, double distance);

  /// Returns whether the cube of a finer `level` that contains the mean of the cell's points has a usable plane.
  bool hasPlane(const MapCell& cell, int level) const;
  /// Returns the plane of one of the cells.
  Plane findPlane(const MapCell& cell) const { return cell.is_current ? cell.plane : cell.fit(space_); }

  int levels() const { return static_cast<int>(levels_.size()); }
  /// Cells of one level in order of insertion.
  const std::vector<MapCell>& cells(int level) const { return levels_[static_cast<std::size_t>(level)].cells; }

  void archive(urban_nav_core::Archive& archive);

 private:
  struct Level {
    double size = 1.0;   // m
    double reach = 1.0;  // m
    std::vector<MapCell> cells;
    urban_nav_registration::CellTable table{64};
    void reindex();
    MapCell* obtain(const Vector3d& p, std::int32_t sweep);
  };
  std::vector<Level> levels_;
  MotionSpace space_;
};

/// Returns the key of the cube of edge `size` that contains a point; nullopt if it is too far from the origin.
std::optional<std::uint64_t> findKey(const Vector3d& p, double size);

}  // namespace laser_odometry
