// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lo/lo_files.hpp"

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

std::string sweepsCsv(const LoRun& run) {
  std::string text = "stamp_ns,status,reason,points,used,moving,free_directions\n";
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const OdometryFrame& row = run.frames[i];
    const LoFigures& figures = run.figures[i];
    text += std::to_string(row.stamp) + "," + toString(row.status.health) + "," +
            laser_odometry::toString(static_cast<laser_odometry::Reason>(row.status.reason)) + "," +
            std::to_string(figures.statistics.points) + "," + std::to_string(figures.statistics.used) + "," +
            std::to_string(figures.statistics.moving) + ",";
    bool is_first = true;
    for (const urban_nav_core::Vector6d& direction : figures.free_directions)
      for (int k = 0; k < 6; ++k) {
        if (!is_first) text += ' ';
        is_first = false;
        urban_nav_core::appendNumber(text, direction[k]);
      }
    text += '\n';
  }
  return text;
}

}  // namespace urban_nav
