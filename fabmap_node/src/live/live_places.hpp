// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "fabmap_node/decision/belief_history.hpp"
#include "fabmap_node/fab_map.hpp"
#include "live/live_place_store.hpp"
#include "live/place_archive.hpp"
#include "live/session_odometry.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_live/session_namer.hpp"
#include "urban_nav_live/stage_report.hpp"
#include "urban_nav_live/store_writer_link.hpp"
#include "urban_nav_live/time_jump.hpp"
#include "urban_nav_store/tables/place_link.hpp"

namespace fabmap_node {

/// Identity of the session being recorded, in addition to its first stamp; common to all stages of a robot.
struct LiveSessionName {
  std::string robot, recording;
  bool is_announced = false;  ///< odometry announces its sessions, a window of frames after their first pose
};

/// Place recognition of a live robot, independent of ROS. Sessions and their ids are those announced by odometry;
/// observations after a backward jump of stamps belong to the next one. Without an announcement, ids are those of
/// urban_nav_live::SessionNamer after 5 s: the session begins with its first pose of odometry, or, without one for 10
/// s, with its first observation, and has no name in closures before. Descriptors of places are read from the stores
/// they come from, those of places being recorded from a temporary file. Not thread-safe.
class LivePlaces {
 public:
  /// `store`: absolute path of a file to which places are written, and whose places are used as earlier ones; empty:
  /// none. A session recorded from the same start is continued: its places there are observed again. Throws UserError
  /// or DataError if the model cannot be read.
  explicit LivePlaces(const Parameters& parameters, LiveSessionName name = {}, const std::string& store = "",
                      urban_nav_live::StoreWriterLink::Options store_options = {});
  /// Ends the session.
  ~LivePlaces();
  LivePlaces(const LivePlaces&) = delete;
  LivePlaces& operator=(const LivePlaces&) = delete;

  /// Adds a pose of odometry.
  void addOdometry(const urban_nav_core::StampedPose& pose);
  /// Sets the session of odometry; null: not announced.
  void follow(const urban_nav_core::OdometrySessionPtr& announced);
  /// Recognises an observation. `images`: by camera; an empty view is missing.
  PlaceOutput process(urban_nav_core::StampNs stamp, const std::vector<urban_nav_core::ImageView>& images);
  /// Adds a closure with the verdict of loop_metric or pose_graph. Returns the beliefs that it changes, as
  /// BeliefHistory::addVerdict(); empty unless `b` is of the session of the observations and `a` of one in the map.
  /// With an accepted closure, the places at `a` learn the appearance at `b` (FabMap::confirm()); the store keeps it.
  std::vector<PlaceBelief> addVerdict(const urban_nav_core::MetricClosure& closure);
  /// Opens the store when an attempt is due, and passes places to it. Call about ten times a second.
  void syncStore();
  /// Passes all places to the store, if any, and blocks until they are committed or storeState() has a fault.
  void commit();
  /// Removes all places and begins a new session. Places that are stored or pending are kept in the store.
  void reset();
  /// Writes the places of all sessions to a store, which may exist, with the id of the session being recorded. Returns
  /// a summary. Throws UserError for a path that is not absolute or cannot be written, and without places; DataError if
  /// the store has other places of a session at the same times.
  std::string save(const std::string& path);
  /// Adds the places of the sessions of a store as earlier ones. Those of the session being recorded are kept; its
  /// sequence of observations is reset. Returns a summary. Throws UserError for a path that is not absolute or a store
  /// without places of this model, DataError for a damaged one.
  std::string load(const std::string& path);

  urban_nav_live::StoreState storeState() const { return store_.state(); }
  urban_nav_live::StageReport report() const;

 private:
  struct Counts {
    std::int64_t observations = 0, unused = 0, incomplete = 0, known = 0, closures = 0, verdicts = 0;
  };
  struct Added {
    std::vector<urban_nav_store::Session> sessions;  ///< in the map, including earlier ones
    std::size_t known = 0, places = 0;               ///< sessions that were in the map before; places that were not
    std::size_t other_model = 0;                     ///< ignored places
  };
  /// Map whose last session is being recorded.
  struct BuiltMap {
    std::unique_ptr<FabMap> map;
    std::vector<ArchivedSession> earlier;  ///< its earlier sessions
    std::size_t other_model = 0;           ///< ignored places
  };

  /// Names the session once its beginning is known.
  void nameSession(urban_nav_core::StampNs now);
  void beginSession(const urban_nav_store::Session& session);
  void beginOwnSession(urban_nav_core::StampNs start);
  void beginNextSession();
  /// Names the session, if it has places, and marks it complete.
  void endSession();
  void keep(urban_nav_store::StoredPlace place);
  /// Learns from a verdict on a closure between poses with sessions as named in the map.
  void learn(const urban_nav_core::MetricClosure& closure, PlaceVerdict verdict, const urban_nav_core::PoseRef& a,
             const urban_nav_core::PoseRef& b);
  void apply(const urban_nav_store::PlaceLink& link);
  void keep(urban_nav_store::PlaceLink link);
  /// Returns the distance travelled up to a pose; nullopt if it is not in the map.
  std::optional<double> travelled(const urban_nav_core::PoseRef& at) const;
  /// Begins a session in the map. Forgotten places leave it.
  void beginMapSession();
  /// Replaces the map by one without forgotten places and with a session of its own for the recorded ones.
  void compact();
  std::unique_ptr<FabMap> emptyMap();
  /// Returns a map of the earlier sessions that have places, and of the recorded places.
  BuiltMap buildMap(const std::vector<ArchivedSession>& earlier, const std::set<urban_nav_core::PoseRef>& without = {});
  void useMap(BuiltMap built);
  /// Reads the descriptors of a place of the map; if that fails they are empty, and the fault is reported.
  std::string readLook(std::size_t session, urban_nav_core::StampNs stamp);
  /// Returns the name that the session being recorded has, or would have if it were saved.
  urban_nav_store::Session recordedSession() const;
  /// Returns the sessions with places that are not in the store.
  std::vector<ArchivedSession> unstoredSessions() const;
  /// Adds the sessions of a store that are not yet in the map as earlier ones.
  Added addSessions(const std::string& path);

  const Parameters parameters_;
  const LiveSessionName name_;
  const std::string model_bytes_;
  const PlaceModel model_;
  const PlaceDescriber describer_;
  LivePlaceStore store_;
  std::unique_ptr<FabMap> map_;
  urban_nav_live::SessionNamer namer_;
  std::vector<ArchivedSession> earlier_;             // before the one being recorded, as in the map
  std::vector<urban_nav_store::PlaceLink> links_;    // of the map, sessions named as there, in order of arrival
  std::vector<urban_nav_store::Session> resumable_;  // sessions of the store when it was opened
  // Session being recorded.
  std::optional<urban_nav_store::Session> session_;  // nullopt: not yet named
  // As announced by odometry, and the next one, which odometry has begun before the observations; null: none.
  urban_nav_core::OdometrySessionPtr announced_, next_announced_;
  std::shared_ptr<RecordedPlaces> recorded_;
  BeliefHistory history_;
  SessionOdometry odometry_;
  urban_nav_live::TimeJumpDetector time_;                  // of observations
  std::optional<urban_nav_core::StampNs> first_observed_;  // nullopt: no observation yet
  std::vector<urban_nav_store::StoredPlace> unnamed_;      // places to be stored once the session is named
  Counts counts_;
  PlaceBelief last_;
  std::string unreadable_;  // fault of the last descriptors that could not be read; empty: none
};

}  // namespace fabmap_node
