// SPDX-License-Identifier: BSD-3-Clause
#include "map/odometry_source.hpp"

#include <algorithm>
#include <utility>

#include "map/map_options.hpp"
#include "urban_nav_core/types/error.hpp"

namespace urban_nav {

namespace {

bool hasSweeps(const urban_nav_input::SourceInfo& info) {
  return !info.planar_role.empty() ||
         std::any_of(info.inputs.begin(), info.inputs.end(),
                     [](const urban_nav_input::InputStream& stream) { return stream.lidar.has_value(); });
}

/// Returns the input that a source lacks.
std::string missingSweeps(OdometrySource source) {
  return std::string("sweeps of a 3D LiDAR") +
         (source == OdometrySource::Laser ? ", and no scans of a horizontal planar laser" : "");
}

/// Returns whether --stages names a stage, unlike isRequested(), which is also true in a run of all stages.
bool isNamed(const MapOptions& options, const char* stage) {
  return std::find(options.stages.begin(), options.stages.end(), stage) != options.stages.end();
}

}  // namespace

const char* toString(OdometrySource source) {
  switch (source) {
    case OdometrySource::Stereo: return "stereo";
    case OdometrySource::Laser: return "laser";
    case OdometrySource::Both: break;
  }
  return "both";
}

OdometryOption parseOdometryOption(const std::string& word) {
  if (word.empty()) return OdometryOption::Auto;
  for (const auto& [name, option] :
       {std::pair{"auto", OdometryOption::Auto}, std::pair{"stereo", OdometryOption::Stereo},
        std::pair{"laser", OdometryOption::Laser}, std::pair{"both", OdometryOption::Both}})
    if (word == name) return option;
  throw urban_nav_core::UserError("--odometry", word, "auto, stereo, laser, both");
}

OdometrySource chooseOdometry(const MapOptions& options, const urban_nav_input::SourceInfo& info) {
  const bool has_sweeps = hasSweeps(info);
  const auto required = [&](OdometrySource source) {
    const bool is_without_images = usesStereo(source) && !info.has_images;
    if (is_without_images || (usesLaser(source) && !has_sweeps))
      throw urban_nav_core::DataError(info.name,
                                      std::string("--odometry ") + toString(source) + " cannot be run: no " +
                                          (is_without_images ? "stereo images" : missingSweeps(source)),
                                      "");
    return source;
  };
  switch (options.odometry) {
    case OdometryOption::Stereo: return required(OdometrySource::Stereo);
    case OdometryOption::Laser: return required(OdometrySource::Laser);
    case OdometryOption::Both: return required(OdometrySource::Both);
    case OdometryOption::Auto: break;
  }
  if (!info.has_images || !has_sweeps) return info.has_images ? OdometrySource::Stereo : OdometrySource::Laser;
  if (options.stages.empty()) return OdometrySource::Both;
  if (!isNamed(options, "lo")) return OdometrySource::Stereo;
  return isNamed(options, "vo") ? OdometrySource::Both : OdometrySource::Laser;
}

}  // namespace urban_nav
