// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "urban_nav_core/io/kitti.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_odometry {

/// Raw sweeps of KITTI with the true poses of the left camera. The base has the position of the camera and the axes of
/// REP-103.
struct VelodyneFolder {
  std::vector<std::string> files;
  std::vector<urban_nav_core::StampNs> times;
  std::vector<urban_nav_core::Pose> truth;  ///< T_first_base
  urban_nav_core::Pose T_base_lidar;

  /// `folder`: times.txt, poses.txt, calib.txt with Tr; `sweeps`: the .bin files.
  VelodyneFolder(const std::string& folder, const std::string& sweeps) {
    for (const auto& entry : std::filesystem::directory_iterator(sweeps))
      if (entry.path().extension() == ".bin") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    times = urban_nav_core::readTimes(folder + "/times.txt");
    urban_nav_core::Matrix3d axes;
    axes << 0, -1, 0, 0, 0, -1, 1, 0, 0;
    const urban_nav_core::Pose T_camera_base(axes, urban_nav_core::Vector3d::Zero());
    for (const urban_nav_core::Pose& pose : urban_nav_core::readKitti(folder + "/poses.txt"))
      truth.push_back(T_camera_base.inverse() * pose * T_camera_base);
    std::istringstream lines(urban_nav_core::readTextFile(folder + "/calib.txt"));
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("Tr:", 0) != 0) continue;
      std::istringstream numbers(line.substr(3));
      Eigen::Matrix<double, 3, 4> Tr;
      for (int i = 0; i < 12; ++i) numbers >> Tr(i / 4, i % 4);
      T_base_lidar = T_camera_base.inverse() * urban_nav_core::Pose(urban_nav_core::Matrix3d(Tr.leftCols<3>()),
                                                                    urban_nav_core::Vector3d(Tr.col(3)));
    }
    if (files.size() < 2)
      throw urban_nav_core::DataError(sweeps, std::to_string(files.size()) + " files *.bin", "at least 2");
    if (times.size() < files.size() || truth.size() < files.size())
      throw urban_nav_core::DataError(
          folder, std::to_string(times.size()) + " times and " + std::to_string(truth.size()) + " poses",
          "one of each for every sweep, " + std::to_string(files.size()));
  }

  /// The laser turns clockwise seen from above, in 0.1 s from backwards to backwards. Files hold the rings one after
  /// the other, each from 0 to 360 deg.
  urban_nav_core::Sweep read(std::size_t i) const {
    const std::string bytes = urban_nav_core::readTextFile(files[i]);
    urban_nav_core::Sweep sweep;
    sweep.reference = times[i];
    sweep.duration = 0.1;
    sweep.times = urban_nav_core::Sweep::Times::Measured;
    double before = 0.0;
    std::uint16_t ring = 0;
    for (std::size_t at = 0; at + 16 <= bytes.size(); at += 16) {
      float values[4];
      std::memcpy(values, bytes.data() + at, 16);
      const Eigen::Vector3f p(values[0], values[1], values[2]);
      if (!(p.norm() > 0.0F)) continue;
      urban_nav_core::Beam beam;
      beam.range = p.norm();
      beam.direction = p / beam.range;
      const double azimuth = static_cast<double>(std::atan2(p.y(), p.x()));
      const double positive = azimuth < 0.0 ? azimuth + 2.0 * M_PI : azimuth;
      if (positive < before - M_PI) ++ring;
      before = positive;
      beam.ring = ring;
      beam.stamp = sweep.reference - std::llround(5e7 * azimuth / M_PI);
      sweep.beams.push_back(beam);
    }
    return sweep;
  }
};

}  // namespace laser_odometry
