// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "calibration/free_trajectory.hpp"
#include "calibration/view_motion.hpp"
#include "urban_nav_core/image/pyramid.hpp"

namespace laser_mapper {

/// Sample of the map visible in a view, by their indices.
struct HeadSighting {
  std::uint32_t point = 0, view = 0;
};

/// Images of a camera head, and the points of the map visible in them.
struct HeadImages {
  std::vector<MountedView> views;
  std::vector<urban_nav_core::Pyramid> pyramids;  ///< of the views, kHeadLevels each; empty ones are not used
  std::vector<Eigen::Vector3d> points, normals;   ///< m, in the map; unit
  std::vector<urban_nav_core::StampNs> stamps;    ///< of the beams of the points
  std::vector<HeadSighting> sightings;            ///< by point, then view
};
constexpr int kHeadLevels = 4;

/// Time and position of a measurement.
struct HeadMoment {
  std::uint32_t stretch = 0;  ///< interval of the trajectory
  FreeTrajectory::Share share;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();  ///< position of the robot in the map, m
};

/// Point with its observations first...last - 1.
struct HeadPoint {
  HeadMoment measured;
  std::size_t first = 0, last = 0;
};

/// Brightness of a point in a view at some terms.
struct HeadRow {
  using TermShifts = Eigen::Matrix<float, 2, kCalibrationTerms>;
  using PointShifts = Eigen::Matrix<float, 2, 3>;

  float brightness = 0.0F;  ///< logarithm
  bool is_seen = false;
  std::array<float, 2> texture{};  ///< gradient of brightness along two axes of the surface, per m
  /// Displacement of the observed surface point along these axes, m per s, m and rad of the terms: TermShifts.
  std::array<float, 2 * kCalibrationTerms> shifts{};
  std::array<float, 6> motion{};  ///< and per m of displacement of the point along each axis of the map: PointShifts
};

/// Samples the views of a camera head at points of the map. Thread-safe while the intervals do not change.
class HeadViews {
 public:
  /// The arguments must outlive this object. `centre`: of the head, in base_link. `stretches`: of the trajectory, in
  /// order of time.
  HeadViews(const HeadImages& images, const urban_nav_core::Trajectory& T_map_base,
            const urban_nav_core::Vector3d& centre, const std::vector<FreeTrajectory>& stretches);

  const HeadImages& images() const { return images_; }
  /// Returns the visible points, in the order of the observations.
  const std::vector<HeadPoint>& points() const { return points_; }
  /// Returns time and position of the view of an observation.
  const HeadMoment& moment(std::size_t sighting) const { return moments_[images_.sightings[sighting].view]; }
  /// Returns a row per observation. `level`: of the images. `corrected`: use the corrections of the intervals instead
  /// of the given trajectory.
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
