// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fabmap_node/fab_map.hpp"
#include "live/live_place_store.hpp"
#include "live/place_archive.hpp"
#include "live/session_odometry.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_live/session_namer.hpp"
#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_live/store_writer_link.hpp"
#include "urban_nav_live/time_jump.hpp"

namespace fabmap_node {

/// Identity of the session that is being recorded, beside its first stamp: the same for all stages of a robot.
struct LiveSessionName {
  std::string robot, recording;
  bool is_announced = false;  ///< the odometry announces its sessions, a window of frames after their first pose
};

/// Place recognition of a live robot, free of ROS. Sessions and their ids are those that the odometry announces;
/// observations whose stamps jump back belong to the next one. Where it does not announce it, ids are those of
/// urban_nav_live::SessionNamer after 5 s: the session begins with its first pose of odometry, or, without one for 10
/// s, with its first observation, and is unnamed in closures. Descriptors of places are read from the stores they come
/// from, those of places that are being recorded from a temporary file. Not thread-safe.
class LivePlaces {
 public:
  /// `store`: absolute path of the file to which places are written while they are observed, and whose places are
  /// earlier ones; empty: none. A session that was recorded from the same start continues: its places there are
  /// observed again. Throws UserError or DataError if the model cannot be read.
  explicit LivePlaces(const Parameters& parameters, LiveSessionName name = {}, const std::string& store = "",
                      urban_nav_live::StoreWriterLink::Options store_options = {});
  /// Ends the session.
  ~LivePlaces();
  LivePlaces(const LivePlaces&) = delete;
  LivePlaces& operator=(const LivePlaces&) = delete;

  /// Adds a pose of odometry.
  void addOdometry(const urban_nav_core::StampedPose& pose);
  /// The odometry is in this session; null: it does not announce it.
  void follow(const urban_nav_core::OdometrySessionPtr& announced);
  /// Recognises an observation. `images`: by camera; an empty view is missing.
  PlaceOutput process(urban_nav_core::StampNs stamp, const std::vector<urban_nav_core::ImageView>& images);
  /// Opens the store when an attempt is due, and hands places on to it. To be called some ten times a second.
  void syncStore();
  /// Hands all places on to the store, if one is wanted, and waits until they are committed, or storeState() has a
  /// fault.
  void commit();
  /// Forgets all places and begins a new session. What is in the store, or on its way, remains there.
  void reset();
  /// Writes the places of all sessions to a store, which may exist, with the id of the session that is being recorded.
  /// Returns what was done. Throws UserError for a path that is not absolute or cannot be written, and without places;
  /// DataError if the store holds other places of a session at the same times.
  std::string save(const std::string& path);
  /// Adds the places of the sessions of a store as earlier ones. Those of the session that is being recorded remain;
  /// its sequence of observations begins anew. Returns what was done. Throws UserError for a path that is not absolute
  /// or a store without places of this model, DataError for a damaged one.
  std::string load(const std::string& path);

  urban_nav_live::StoreState storeState() const { return store_.state(); }
  urban_nav_live::StageReport report() const;

 private:
  struct Counts {
    std::int64_t observations = 0, unused = 0, incomplete = 0, known = 0, closures = 0;
  };
  struct Added {
    std::vector<urban_nav_store::Session> sessions;  ///< in the map now, or before
    std::size_t known = 0, places = 0;               ///< sessions in the map before, places that were not
    std::size_t other_model = 0;                     ///< places left out
  };
  /// Map whose last session is being recorded.
  struct BuiltMap {
    std::unique_ptr<FabMap> map;
    std::vector<ArchivedSession> earlier;  ///< its sessions before
    std::size_t other_model = 0;           ///< places left out
  };

  /// Names the session once it is known when it began.
  void nameSession(urban_nav_core::StampNs now);
  void beginSession(const urban_nav_store::Session& session);
  void beginOwnSession(urban_nav_core::StampNs start);
  void beginNextSession();
  /// Names the session, if it has places, and marks it complete.
  void endSession();
  void keep(urban_nav_store::StoredPlace place);
  std::unique_ptr<FabMap> emptyMap();
  /// Returns a map of those earlier sessions that have places, and of what was recorded.
  BuiltMap buildMap(const std::vector<ArchivedSession>& earlier);
  void useMap(BuiltMap built);
  /// Reads the descriptors of a place of the map; what cannot be read agrees with nothing, and is reported.
  std::string readLook(std::size_t session, urban_nav_core::StampNs stamp);
  /// Returns the name that the session that is being recorded has, or would have if it were saved.
  urban_nav_store::Session recordedSession() const;
  /// Returns the sessions with places that are not in the store.
  std::vector<ArchivedSession> unstoredSessions() const;
  /// Adds the sessions of a store that are not in the map yet as earlier ones.
  Added addSessions(const std::string& path);

  const Parameters parameters_;
  const LiveSessionName name_;
  const std::string model_bytes_;
  const PlaceModel model_;
  const PlaceDescriber describer_;
  LivePlaceStore store_;
  std::unique_ptr<FabMap> map_;
  urban_nav_live::SessionNamer namer_;
  std::vector<ArchivedSession> earlier_;             // sessions before the one that is being recorded, as in the map
  std::vector<urban_nav_store::Session> resumable_;  // those of the store when it was opened
  // Of the session that is being recorded.
  std::optional<urban_nav_store::Session> session_;  // nullopt: not named yet
  // As odometry announces it, and the next one, which odometry has begun before the observations; null:
  // nothing.
  urban_nav_core::OdometrySessionPtr announced_, next_announced_;
  std::shared_ptr<RecordedPlaces> recorded_;
  SessionOdometry odometry_;
  urban_nav_live::TimeJumpDetector time_;                  // of observations
  std::optional<urban_nav_core::StampNs> first_observed_;  // nullopt: no observation yet
  std::vector<urban_nav_store::StoredPlace> unnamed_;      // places for the store, before it has a name
  Counts counts_;
  PlaceBelief last_;
  std::string unreadable_;  // fault of the last descriptors that could not be read; empty: none
};

}  // namespace fabmap_node
