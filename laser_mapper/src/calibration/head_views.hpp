// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "calibration/free_trajectory.hpp"
#include "calibration/view_motion.hpp"
#include "urban_nav_core/image/pyramid.hpp"

namespace laser_mapper {

/// A sample of the map that a view shows, by their indices.
struct HeadSighting {
  std::uint32_t point = 0, view = 0;
};

/// Images of a head of cameras, and what they show of the map.
struct HeadImages {
  std::vector<MountedView> views;
  std::vector<urban_nav_core::Pyramid> pyramids;  ///< of the views, kHeadLevels each; empty ones are not used
  std::vector<Eigen::Vector3d> points, normals;   ///< m, in the map; unit
  std::vector<urban_nav_core::StampNs> stamps;    ///< of the beams that made the points
  std::vector<HeadSighting> sightings;            ///< by point, then view
};
constexpr int kHeadLevels = 4;

/// When and from where something of the map was measured.
struct HeadMoment {
  std::uint32_t stretch = 0;  ///< of the trajectory
  FreeTrajectory::Share share;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();  ///< position of the robot in the map, m
};

/// A point with its sightings first...last - 1.
struct HeadPoint {
  HeadMoment measured;
  std::size_t first = 0, last = 0;
};

/// What a view shows of a point at some terms.
struct HeadRow {
  using TermShifts = Eigen::Matrix<float, 2, kCalibrationTerms>;
  using PointShifts = Eigen::Matrix<float, 2, 3>;

  float brightness = 0.0F;  ///< logarithm
  bool is_seen = false;
  std::array<float, 2> texture{};  ///< slope of the brightness along two axes of the surface, per m
  /// How far what the view shows moves along these axes, m per s, m and rad of the terms: TermShifts.
  std::array<float, 2 * kCalibrationTerms> shifts{};
  std::array<float, 6> motion{};  ///< and per m by which the point moves along each axis of the map: PointShifts
};

/// Looks up what the views of a head of cameras show of points of the map. Thread-safe while the stretches do not
/// change.
class HeadViews {
 public:
  /// References must outlive it. `centre`: of the head, in base_link. `stretches`: of the trajectory, in order of time.
  HeadViews(const HeadImages& images, const urban_nav_core::Trajectory& T_map_base,
            const urban_nav_core::Vector3d& centre, const std::vector<FreeTrajectory>& stretches);

  const HeadImages& images() const { return images_; }
  /// Points that are seen, in the order of the sightings.
  const std::vector<HeadPoint>& points() const { return points_; }
  /// Returns when the view of a sighting was taken.
  const HeadMoment& moment(std::size_t sighting) const { return moments_[images_.sightings[sighting].view]; }
  /// Returns a row for each sighting. `level`: of the images. `corrected`: along the trajectory as its stretches
  /// correct it, not as it was given.
  std::vector<HeadRow> rowsAt(const TermVector& terms, int level, bool corrected) const;

 private:
  HeadMoment momentAt(urban_nav_core::StampNs stamp) const;
  Eigen::Vector3d displacement(const HeadMoment& measured, const HeadMoment& seen, const Eigen::Vector3d& p) const;

  const HeadImages& images_;
  const urban_nav_core::Trajectory& T_map_base_;
  const urban_nav_core::Vector3d centre_;
  const std::vector<FreeTrajectory>& stretches_;
  std::vector<HeadMoment> moments_;  ///< of the views
  std::vector<HeadPoint> points_;
};

}  // namespace laser_mapper
