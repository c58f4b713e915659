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

/// An image of a head of cameras that are fixed to each other.
struct MountedView {
  urban_nav_core::RawCamera camera;
  urban_nav_core::Pose T_base_camera;  ///< of the optical frame, as stated
  urban_nav_core::StampNs stamp = 0;
  std::size_t image = 0;  ///< number for ImageLoader
};

/// Delay and mounting of a head of cameras against the map of the lasers and its trajectory. The frame of the head has
/// the axes of base_link, and its origin in the middle of the cameras.
struct ViewCalibration {
  DeviceCalibration head;
  urban_nav_core::Vector3d centre = urban_nav_core::Vector3d::Zero();  ///< origin of the head in base_link, m
  std::vector<std::string> unconstrained;  ///< directions in words: "shift of panorama along its x axis (forward)"
  std::size_t places = 0;                  ///< cubes of 2 m that it rests on
  std::size_t held_out = 0;                ///< cubes left out, by which it is judged
  double stated_spread = 0.0;              ///< of the brightness of a point over its views, in the held-out cubes, as a
  double calibrated_spread = 0.0;          ///< share of it: as stated, and with the estimate
  bool is_significant = false;             ///< some terms differ from zero beyond chance
  bool improves = false;                   ///< held-out cubes agree better, beyond chance

  bool isAdopted() const { return is_significant && improves; }
  /// Returns what the adopted terms make of poses of the cameras: T_base_camera = this * T_base_camera as stated.
  urban_nav_core::Pose headCorrection() const;
};

/// Estimates delay and mounting of a head of cameras by the colours of the map: views of one point must show the same
/// brightness. Each view of a point is compared with the others of the same 20 s. What errors of the trajectory, as
/// odometry states them, may explain is not taken for an error of the head. Order of
/// calls: addSurface() for all points, then estimate(). The result does not depend on the number of threads. Not
/// thread-safe.
class ViewCalibrator {
 public:
  /// `T_map_base` and `odometry` must outlive it. `odometry`: its covariances say how far the trajectory may be off;
  /// null: by 1 mm and 0.3 mrad a second. `voxel`: distance between points of the map, m. `range_bias`:
  /// standard deviation of a laser's constant error, m. Views at times without poses are left out, and whole stretches
  /// of time where there are more images than fit into memory.
  ViewCalibrator(std::vector<MountedView> views, const urban_nav_core::Trajectory& T_map_base,
                 const urban_nav_core::OdometryChain* odometry, double voxel, double range_bias);
  ~ViewCalibrator();

  /// Notes what points hide.
  void addSurface(const std::vector<MapPoint>& points);
  /// `name`: of the head, in the result.
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

/// Makes all stages use the adopted terms of a calibration of a session's panoramas, or, with none adopted, its
/// extrinsics and stamps; what is adopted of the lasers stays.
void storeViewCalibration(urban_nav_store::Store& store, const urban_nav_store::SessionId& session,
                          const ViewCalibration& calibration);

}  // namespace laser_mapper
