// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fabmap_node/decision/travelled_distance.hpp"
#include "fabmap_node/fab_map.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace fabmap_node {

/// Place recognition of a live session, free of ROS. Its sessions are unnamed: closures refer to the session that is
/// being recorded. Not thread-safe.
class LivePlaces {
 public:
  /// Throws UserError or DataError if the model cannot be read.
  explicit LivePlaces(const Parameters& parameters);

  /// Adds a pose of odometry.
  void addOdometry(const urban_nav_core::StampedPose& pose);
  /// Recognises an observation. `images`: by camera; an empty view is missing.
  PlaceOutput process(urban_nav_core::StampNs stamp, const std::vector<urban_nav_core::ImageView>& images);
  /// Forgets all places and begins a new session.
  void reset();

  urban_nav_live::StageReport report() const;

 private:
  struct Counts {
    std::int64_t observations = 0, unused = 0, incomplete = 0, known = 0, closures = 0;
  };

  const Parameters parameters_;
  const PlaceModel model_;
  const PlaceDescriber describer_;
  std::unique_ptr<FabMap> map_;
  TravelledDistance travelled_;
  Counts counts_;
  PlaceBelief last_;
};

}  // namespace fabmap_node
