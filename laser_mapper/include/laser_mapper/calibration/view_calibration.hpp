// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "laser_mapper/calibration/laser_calibration.hpp"
#include "laser_mapper/colour/colour_view.hpp"
#include "laser_mapper/map_point.hpp"
#include "urban_nav_core/sequence/even_thinning.hpp"
#include "urban_nav_core/trajectory/odometry_chain.hpp"

namespace laser_mapper {

/// Image of a head of rigidly connected cameras.
struct MountedView {
  urban_nav_core::RawCamera camera;
  urban_nav_core::Pose T_base_camera;  ///< of the optical frame, according to the extrinsics
  urban_nav_core::StampNs stamp = 0;
  std::size_t image = 0;  ///< number passed to ImageLoader
};

/// Calibration of delay and mounting of a camera head against the laser map and its trajectory. The frame of the head
/// has the axes of base_link and its origin at the centre of the cameras.
struct ViewCalibration {
  DeviceCalibration head;
  urban_nav_core::Vector3d centre = urban_nav_core::Vector3d::Zero();  ///< origin of the head in base_link, m
  std::vector<std::string> unconstrained;  ///< directions, for users: "shift of panorama along its x axis (forward)"
  std::size_t places = 0;                  ///< cubes of 2 m that were used
  std::size_t held_out = 0;                ///< cubes excluded from the estimate, for validation
  double stated_spread = 0.0;              ///< relative spread of a point's brightness over its views, in the held-out
                                           ///< cubes:
  double calibrated_spread = 0.0;          ///< as stated, and with the estimate
  bool is_significant = false;             ///< some terms differ significantly from zero
  bool improves = false;                   ///< held-out cubes agree significantly better

  bool isAdopted() const { return is_significant && improves; }
  /// Returns the correction by the adopted terms: T_base_camera = headCorrection() * T_base_camera as stated.
  urban_nav_core::Pose headCorrection() const;
};

/// Estimates delay and mounting of a camera head from the colours of the map: all views of a point must have the same
/// brightness. Views of a point are compared within 20 s. Differences explained by the odometry covariance of the
/// trajectory are not attributed to the head. Order of calls: addSurface() for all points, then estimate(). The result
/// does not depend on the number of threads. Not thread-safe.
class ViewCalibrator {
 public:
  /// `T_map_base` and `odometry` must outlive it. `odometry`: its covariances bound errors of the trajectory; null: 1
  /// mm and 0.3 mrad per second. `voxel`: distance between points of the map, m. `range_bias`: standard deviation of a
  /// laser's constant error, m. Views at times without poses are ignored, as are whole intervals if the images exceed
  /// the memory.
  ViewCalibrator(std::vector<MountedView> views, const urban_nav_core::Trajectory& T_map_base,
                 const urban_nav_core::OdometryChain* odometry, double voxel, double range_bias);
  ~ViewCalibrator();

  /// Adds points as occluders.
  void addSurface(const std::vector<MapPoint>& points);
  /// `name`: name of the head in the result.
  ViewCalibration estimate(const std::string& name, const ImageLoader& load) const;

 private:
  struct ViewData;

  std::vector<MountedView> views_;
  const urban_nav_core::Trajectory& T_map_base_;
  const urban_nav_core::OdometryChain* const odometry_;
  const double voxel_, range_bias_;
  urban_nav_core::Vector3d centre_ = urban_nav_core::Vector3d::Zero();
  std::vector<ViewData> data_;
  urban_nav_core::EvenThinning<MapPoint> samples_;
};

/// Stores the adopted terms of a session's panoramas for all stages, or removes them if none is adopted; adopted terms
/// of the lasers are kept.
void storeViewCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                          const ViewCalibration& calibration);

}  // namespace laser_mapper
