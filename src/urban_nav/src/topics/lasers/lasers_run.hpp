// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "base/page.hpp"
#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/quality/map_quality.hpp"
#include "map/context.hpp"
#include "topics/lasers/session_calibration.hpp"

namespace urban_nav {

/// A map of one or several sessions.
struct LaserMapRun {
  std::size_t map = 0;  ///< number of its first session
  std::string file;     ///< "map.ply", in the output folder
  std::size_t points = 0;
  std::map<std::string, std::size_t> points_by_sensor;  ///< names: roles; frames of other planar lasers
  std::size_t coloured = 0;                             ///< points with the colour of a panorama
  std::size_t views = 0;                                ///< images used for its colours
  std::size_t passes = 0;
  std::size_t ghost_beams = 0;  ///< removed since beams of other times passed through their ends
  double sigma_median = 0.0;    ///< m
  laser_mapper::RenderStatistics rendered;
  laser_mapper::QualityFigures walls, ground;  ///< agreement of the passes
  std::string quality_csv;                     ///< content of quality.csv
  std::vector<PagePicture> pictures;
  std::string viewer;  ///< markup of the view in three dimensions
};

/// Result of stage lasers.
struct LasersRun {
  std::vector<LaserMapRun> maps;
  std::vector<SessionCalibration> calibrations;
  double seconds = 0.0;  ///< of the whole stage

  std::size_t points() const;
  std::map<std::string, std::size_t> pointsBySensor() const;
  std::size_t coloured() const;
  std::size_t chunksRendered() const;
  std::size_t ghostBeams() const;
  /// Return the agreement of the passes on walls and on ground, over all maps.
  laser_mapper::QualityFigures walls() const;
  laser_mapper::QualityFigures ground() const;
  laser_mapper::BeamCounts beams() const;
};

/// Estimates the calibration of the lasers of a session of this run along its current trajectory, and applies the
/// adopted terms for all stages. `session`: number over all sessions.
SessionCalibration calibrateSession(const laser_mapper::Parameters& parameters, std::size_t session,
                                    const MapContext& context);

/// Renders the maps of all sessions whose trajectories are written, and writes their files into the output folder.
/// `along_odometry`: calibrations of stage calibration, used if no relaxation has changed the trajectory since.
LasersRun runLasers(const laser_mapper::Parameters& parameters, MapContext& context,
                    const std::vector<SessionCalibration>& along_odometry);

}  // namespace urban_nav
