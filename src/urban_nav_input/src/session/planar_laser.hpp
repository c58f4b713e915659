// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/geometry/se3.hpp"
#include "urban_nav_core/laser/planar_sweep.hpp"
#include "urban_nav_input/session/source.hpp"

namespace urban_nav_input {

/// A planar laser of a recording with its mounting.
struct PlacedLaser {
  std::string role, topic;
  urban_nav_core::Pose T_base_laser;
};

/// The horizontal planar laser whose scans are read as sweeps. Not thread-safe.
class PlanarLaser {
 public:
  /// Returns the first horizontal laser; nullopt without one.
  static std::optional<PlanarLaser> choose(const std::vector<PlacedLaser>& lasers);
  /// Returns why none of the lasers, none of which is horizontal, measures the motion of the robot; empty without
  /// lasers.
  static std::string describeOthers(const std::vector<PlacedLaser>& lasers);

  const std::string& role() const { return laser_.role; }
  const std::string& topic() const { return laser_.topic; }
  std::string note() const;
  SweepInput read(const urban_nav_core::PlanarScan& scan);
  void archive(urban_nav_core::Archive& archive);

 private:
  PlacedLaser laser_;
  urban_nav_core::PlanarSweepReader reader_;
};

}  // namespace urban_nav_input
