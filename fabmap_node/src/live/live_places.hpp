// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fabmap_node/decision/travelled_distance.hpp"
#include "fabmap_node/fab_map.hpp"
#include "fabmap_node/store/place_sessions.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_live/stage_report.hpp"

namespace fabmap_node {

/// Identity of the session that is being recorded, beside its first stamp: the same for all stages of a robot.
struct LiveSessionName {
  std::string robot, recording;
};

/// Place recognition of a live session, free of ROS. The session that is being recorded is unnamed in closures; those
/// that load() adds have the ids of their store. Not thread-safe.
class LivePlaces {
 public:
  /// Throws UserError or DataError if the model cannot be read.
  explicit LivePlaces(const Parameters& parameters, LiveSessionName name = {});

  /// Adds a pose of odometry.
  void addOdometry(const urban_nav_core::StampedPose& pose);
  /// Recognises an observation. `images`: by camera; an empty view is missing.
  PlaceOutput process(urban_nav_core::StampNs stamp, const std::vector<urban_nav_core::ImageView>& images);
  /// Forgets all places and begins a new session.
  void reset();
  /// Writes the places of all sessions to a store, which may exist, with the id of the session that is being recorded
  /// (urban_nav_live::SessionNamer). Returns what was done. Throws UserError for a path that is not absolute or cannot
  /// be written, and without places; DataError if the store holds other places of a session at the same times.
  std::string save(const std::string& path) const;
  /// Adds the places of the sessions of a store as earlier ones. Those of the session that is being recorded remain;
  /// its sequence of observations begins anew. Returns what was done. Throws UserError for a path that is not absolute
  /// or a store without places of this model, DataError for a damaged one.
  std::string load(const std::string& path);

  urban_nav_live::StageReport report() const;

 private:
  struct Counts {
    std::int64_t observations = 0, unused = 0, incomplete = 0, known = 0, closures = 0;
  };

  /// Returns the places of the map by session; the last one is being recorded.
  std::vector<PlaceSession> placeSessions() const;

  const Parameters parameters_;
  const LiveSessionName name_;
  const std::string model_bytes_;
  const PlaceModel model_;
  const PlaceDescriber describer_;
  std::unique_ptr<FabMap> map_;
  TravelledDistance travelled_;
  std::vector<urban_nav_store::Session> loaded_;  // earlier sessions, in the order of the map
  std::optional<urban_nav_core::StampNs> begin_;  // of the session that is being recorded
  Counts counts_;
  PlaceBelief last_;
};

}  // namespace fabmap_node
