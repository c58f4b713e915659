// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "urban_nav_input/session/source.hpp"

namespace urban_nav {

struct MapOptions;

/// Sensors of the odometry of a session.
enum class OdometrySource { Stereo, Laser, Both };
/// Returns "stereo", "laser" or "both".
const char* toString(OdometrySource source);
inline bool usesStereo(OdometrySource source) { return source != OdometrySource::Laser; }
inline bool usesLaser(OdometrySource source) { return source != OdometrySource::Stereo; }

/// Value of --odometry.
enum class OdometryOption {
  Auto,  ///< both if a session has images and sweeps of a 3D LiDAR, else the one it has
  Stereo,
  Laser,
  Both
};
/// Parses "auto", "stereo", "laser" or "both". Throws UserError with the allowed words.
OdometryOption parseOdometryOption(const std::string& word);

/// Returns the source of the odometry of a session. Throws DataError naming the missing input if the session has no
/// data for --odometry.
OdometrySource chooseOdometry(const MapOptions& options, const urban_nav_input::SourceInfo& info);

}  // namespace urban_nav
