// SPDX-License-Identifier: BSD-3-Clause
#include "session/planar_laser.hpp"

#include <algorithm>
#include <cmath>

#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/io/format_number.hpp"

namespace urban_nav_input {

std::optional<PlanarLaser> PlanarLaser::choose(const std::vector<PlacedLaser>& lasers) {
  const auto horizontal = std::find_if(lasers.begin(), lasers.end(), [](const PlacedLaser& laser) {
    return urban_nav_core::isHorizontal(laser.T_base_laser);
  });
  if (horizontal == lasers.end()) return std::nullopt;
  PlanarLaser chosen;
  chosen.laser_ = *horizontal;
  return chosen;
}

std::string PlanarLaser::describeOthers(const std::vector<PlacedLaser>& lasers) {
  std::string text;
  for (const PlacedLaser& laser : lasers)
    text += (text.empty() ? "" : ", ") + laser.topic + " by " +
            urban_nav_core::formatNumber(urban_nav_core::tiltOfLaser(laser.T_base_laser) * 180.0 / M_PI, 3) + " deg";
  if (text.empty()) return text;
  return "planar lasers are tilted against the ground (" + text +
         "): none of their scans measures again what an earlier one did, so that the motion of the robot is not "
         "observed; a horizontal laser (within 10 deg by tf) is required";
}

std::string PlanarLaser::note() const {
  return laser_.role + ": " + laser_.topic + ", a horizontal planar laser: planar motion only";
}

SweepInput PlanarLaser::read(const urban_nav_core::PlanarScan& scan) {
  return {laser_.role, laser_.T_base_laser, reader_.read(scan), true};
}

void PlanarLaser::archive(urban_nav_core::Archive& archive) {
  archive(laser_.role, laser_.topic, laser_.T_base_laser, reader_);
}

}  // namespace urban_nav_input
