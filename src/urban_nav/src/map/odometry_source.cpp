// SPDX-License-Identifier: BSD-3-Clause
#include "map/odometry_source.hpp"

#include <algorithm>
#include <utility>

#include "map/map_options.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

bool hasSweeps(const urban_nav_input::SourceInfo& info) {
  return std::any_of(info.inputs.begin(), info.inputs.end(),
                     [](const urban_nav_input::InputStream& stream) { return stream.lidar.has_value(); });
}

/// Returns whether --stages names a stage, unlike isRequested(), which is also true in a run of all stages.
bool isNamed(const MapOptions& options, const char* stage) {
  return std::find(options.stages.begin(), options.stages.end(), stage) != options.stages.end();
}

}  // namespace

const char* toString(OdometrySource source) { return source == OdometrySource::Laser ? "laser" : "stereo"; }

OdometryOption parseOdometryOption(const std::string& word) {
  if (word.empty()) return OdometryOption::Auto;
  for (const auto& [name, option] :
       {std::pair{"auto", OdometryOption::Auto}, std::pair{"stereo", OdometryOption::Stereo},
        std::pair{"laser", OdometryOption::Laser}})
    if (word == name) return option;
  throw urban_nav_core::UserError("--odometry", word, "auto, stereo, laser");
}

OdometrySource chooseOdometry(const MapOptions& options, const urban_nav_input::SourceInfo& info) {
  switch (options.odometry) {
    case OdometryOption::Stereo:
      if (!info.has_images)
        throw urban_nav_core::DataError(info.name, "--odometry stereo cannot be run: no stereo images", "");
      return OdometrySource::Stereo;
    case OdometryOption::Laser:
      if (!hasSweeps(info))
        throw urban_nav_core::DataError(info.name, "--odometry laser cannot be run: no sweeps of a 3D LiDAR", "");
      return OdometrySource::Laser;
    case OdometryOption::Auto: break;
  }
  if (isNamed(options, "lo") && !isNamed(options, "vo") && hasSweeps(info)) return OdometrySource::Laser;
  return info.has_images ? OdometrySource::Stereo : OdometrySource::Laser;
}

}  // namespace urban_nav
