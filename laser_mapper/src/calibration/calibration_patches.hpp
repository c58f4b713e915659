// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "calibration/scan_places.hpp"

namespace laser_mapper {

/// Planar piece of surface measured by one laser within a second.
struct CalibrationSurfel {
  std::uint64_t block = 0;  ///< key of its block
  std::uint32_t window = 0;
  std::uint8_t laser = 0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< m, in the map
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< towards the laser
  double thickness = 0.0;                             ///< m, standard deviation about the plane
  std::uint32_t first = 0, last = 0;                  ///< beams SurfelSet::beams[first...last - 1]
  std::uint32_t beams() const { return last - first; }
};

struct SurfelSet {
  std::vector<CalibrationSurfel> surfels;  ///< by window, then laser
  std::vector<std::uint32_t> beams;        ///< indices in SampledScans::beams
};

/// Surfels of several times or lasers that appear to lie on one plane.
struct CalibrationPatch {
  std::vector<std::uint32_t> surfels;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< mean normal of the surfels
  bool is_held_out = false;
};

/// Returns the planar pieces of surface in blocks of 0.8 m.
SurfelSet findSurfels(const SampledScans& samples, const std::vector<ScanPlace>& places);
/// Fits the surfels again to the same beams after the scan poses changed.
void moveSurfels(const SampledScans& samples, const std::vector<ScanPlace>& places, SurfelSet& set);

/// Groups surfels within 0.6 m along the surface and `reach` (m) across it whose normals agree; each surfel is in at
/// most one group. One fifth of the places, by position, is held out.
std::vector<CalibrationPatch> matchSurfels(const std::vector<CalibrationSurfel>& surfels, double reach);

/// Recomputes centre and normal of a patch from its surfels.
void updatePatch(const std::vector<CalibrationSurfel>& surfels, CalibrationPatch& patch);

/// Returns the distance of each surfel of a patch from the plane through their weighted median, along its normal, m.
std::vector<double> surfelOffsets(const CalibrationPatch& patch, const std::vector<CalibrationSurfel>& surfels);

}  // namespace laser_mapper
