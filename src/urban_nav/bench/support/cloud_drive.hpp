// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "scene_labeler/training/training_data.hpp"

namespace urban_nav::bench {

/// Simulated drive whose clouds train the model of clouds.
struct CloudDrive {
  std::string world, route;
  std::uint32_t seed = 1;
  int day = 1;
  std::string device;  ///< number of rings, "livox", or "lasers": the side lasers, which sweep push-broom
  double seconds = 10.0;

  std::string name() const { return world + "_" + std::to_string(seed) + "_" + device; }
};

/// Returns of a drive in the world, along its true path, with their true classes.
struct DriveReturns {
  std::vector<Eigen::Vector3f> points;   ///< m
  std::vector<std::uint8_t> classes;     ///< SceneClass
  std::vector<std::uint32_t> sweeps;     ///< one per point, ascending; of the side lasers: tenths of a second
  std::vector<Eigen::Vector3f> origins;  ///< of the sweeps, m

  std::size_t sweepCount() const { return origins.size(); }
};

/// Simulates a drive, or reads its returns from FOLDER/NAME.returns, which is written otherwise.
DriveReturns simulateReturns(const CloudDrive& drive, const std::string& folder);

/// A labelled cloud for training. None: not a label.
struct LabelledCloud {
  scene_labeler::Scene scene;
  std::vector<scene_labeler::SceneClass> labels;
};

/// Returns clouds of a drive as different programs have them: single sweeps, a second of sweeps, and all of the drive.
/// The simulator's grass, gravel and soil are flat: their returns are moved by the relief that they have (see the
/// source). Walls of both kinds are one class; panes and doors in a wall have no label.
std::vector<LabelledCloud> makeClouds(const CloudDrive& drive, const DriveReturns& returns);

}  // namespace urban_nav::bench
