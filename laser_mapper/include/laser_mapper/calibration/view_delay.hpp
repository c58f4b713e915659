// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "laser_mapper/calibration/laser_calibration.hpp"
#include "laser_mapper/colour/colour_view.hpp"
#include "laser_mapper/map_point.hpp"

namespace laser_mapper {

/// Delay of the stamps of images against the trajectory.
struct ViewDelay {
  CalibrationEstimate delay;   ///< s
  std::size_t places = 0;      ///< cubes of 2 m that it rests on
  std::size_t held_out = 0;    ///< cubes left out, by which it is judged
  double stated_spread = 0.0;  ///< of the brightness of a point over its views, in the held-out cubes, as a share of it
  double calibrated_spread = 0.0;
};

/// Estimates the delay of images by the colours of the map: views of one point at different times must show the same
/// brightness. The estimate is adopted if it differs from zero beyond chance and held-out places agree better. Order of
/// calls: addSurface() for all points, then estimate(). The result does not depend on the number of threads. Not
/// thread-safe.
class ViewDelayEstimator {
 public:
  /// Returns the pose of a view (T_map_camera) if its stamp is late by `delay` (s); nullopt if it is unknown.
  using PoseAt = std::function<std::optional<urban_nav_core::Pose>(std::size_t view, double delay)>;

  /// `voxel`: distance between points of the map, m.
  ViewDelayEstimator(std::vector<ColourView> views, PoseAt pose_at, double voxel);
  ~ViewDelayEstimator();

  /// Notes what points hide.
  void addSurface(const std::vector<MapPoint>& points);
  ViewDelay estimate(const ImageLoader& load) const;

 private:
  struct ViewData;
  struct Sighting;
  void addSightings(const ImageLoader& load, std::size_t view, std::vector<Sighting>& sightings) const;
  std::vector<float> brightnessOf(const std::vector<Sighting>& sightings) const;

  const std::vector<ColourView> views_;
  const PoseAt pose_at_;
  const double voxel_;
  std::vector<ViewData> data_;
  std::vector<MapPoint> samples_;
  std::size_t sample_step_ = 1, seen_ = 0;
};

}  // namespace laser_mapper
