// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "scene_labeler/drive/drive_window.hpp"
#include "scene_labeler/drive/travelled_path.hpp"
#include "urban_nav_core/laser/beam_renderer.hpp"

namespace scene_labeler {

/// Laser and camera of one side of the robot.
struct SideRig {
  struct Camera {
    urban_nav_core::RawCamera raw;
    urban_nav_core::Pose T_base_camera;  ///< of the optical frame
  };
  urban_nav_core::Pose T_base_laser;
  std::optional<Camera> camera;  ///< nullopt: returns are labelled by shape
};

/// Longest interval between poses in which beams are rendered, ns.
constexpr urban_nav_core::StampNs kLongestPoseGap = 500'000'000;

/// Passes the scans of one side and an image every `spacing` of the path to a window. Not thread-safe.
class SideDrive {
 public:
  /// Trajectory, path and window must outlive this object; the trajectory may grow, with TravelledPath::update().
  SideDrive(SideRig rig, const urban_nav_core::Trajectory& T_world_base, const TravelledPath& path, double spacing,
            DriveWindow& window);

  /// Adds the beams at times covered by the trajectory.
  void add(const urban_nav_core::PlanarScan& scan);
  /// Returns whether an image at this time begins a new frame.
  bool wants(urban_nav_core::StampNs stamp) const;
  /// Adds an image for which wants() is true; one whose size is not that of the camera is ignored. `classes`:
  /// SideView::classes.
  void add(urban_nav_core::StampNs stamp, const cv::Mat& image, const cv::Mat& classes = {});

 private:
  void addFrame(DriveFrame frame);

  const SideRig rig_;
  const urban_nav_core::Trajectory& T_world_base_;
  const TravelledPath& path_;
  const double spacing_;
  DriveWindow& window_;
  urban_nav_core::BeamRenderer renderer_;
  double next_ = 0.0, latest_ = 0.0;  // m along the path: next frame, last scan
  std::vector<urban_nav_core::LaserPoint> points_;
};

}  // namespace scene_labeler
