// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "base/console.hpp"
#include "base/parameter_set.hpp"
#include "scene_labeler/drive/drive_window.hpp"
#include "topics/labels/labels.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"

namespace urban_nav {

/// Sides of the robot covered by a laser and a camera of the panoramic head.
enum class DriveSide : std::uint8_t { Left, Right };
constexpr std::array<DriveSide, 2> kBothSides = {DriveSide::Left, DriveSide::Right};
const char* toString(DriveSide side);

/// Options for reading the bags of `labels`.
struct DriveOptions {
  OdometryRunner run_odometry;
  const ParameterSet* parameters = nullptr;  ///< of the stages
  std::vector<std::string> topics;           ///< ROLE:=NAME
  std::string trajectory;                    ///< TUM file of base_link; empty: odometry or tf of the bag
};

/// Returns T_world_base of a bag: the file, else the odometry of its stereo images or, without these, of its 3D LiDAR,
/// else its tf from odom or map to base_link. Throws UserError if there is none.
urban_nav_core::Trajectory readDriveTrajectory(const std::string& bag, const DriveOptions& options, Console& console);

/// Reads the returns of the side lasers of a bag, and an image of the camera of their side every
/// `scene_labeler.spacing` along the path, and passes them to the windows of the sides. Throws UserError if the bag has
/// no scans of a laser with extrinsics, DataError if it cannot be read.
void readDrive(const std::string& bag, const DriveOptions& options, Console& console,
               const std::array<scene_labeler::DriveWindow*, 2>& windows);

/// Returns whether the name of a source is that of a bag.
bool isBag(const std::string& path);

}  // namespace urban_nav
