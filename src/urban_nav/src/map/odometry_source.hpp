// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "urban_nav_input/session/source.hpp"

namespace urban_nav {

struct MapOptions;

/// Sensor that the odometry of a session comes from.
enum class OdometrySource { Stereo, Laser };
/// Returns "stereo" or "laser".
const char* toString(OdometrySource source);

/// Value of --odometry.
enum class OdometryOption {
  Auto,  ///< stereo, or laser where a session has sweeps of a 3D LiDAR but no images
  Stereo,
  Laser
};
/// Parses "auto", "stereo" or "laser". Throws UserError with the allowed words.
OdometryOption parseOdometryOption(const std::string& word);

/// Returns the source of a session's odometry. Throws DataError that names the missing input if --odometry asks for one
/// that the session has no data for.
OdometrySource chooseOdometry(const MapOptions& options, const urban_nav_input::SourceInfo& info);

}  // namespace urban_nav
