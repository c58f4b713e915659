// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_point.hpp"
#include "laser_mapper/parameters.hpp"
#include "laser_mapper/quality/map_quality.hpp"
#include "laser_mapper/quality/odometry_drift.hpp"
#include "laser_mapper/quality/plane_constraints.hpp"
#include "laser_mapper/quality/shared_beams.hpp"
#include "live/live_layers.hpp"
#include "live/live_sensors.hpp"
#include "urban_nav_core/laser/scan.hpp"
#include "urban_nav_core/laser/sweep.hpp"
#include "urban_nav_core/trajectory/trajectory.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_core/types/graph_update.hpp"
#include "urban_nav_core/types/odometry_session.hpp"
#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_live/round_gate.hpp"
#include "urban_nav_store/store.hpp"

namespace laser_mapper {

/// Map of a running session: LaserMap over a temporary session store. Between the poses of the graph the robot moves by
/// odometry; without a graph the map is in the frame of odometry. When poses of the graph move, the chunks along them
/// are rendered again. Odometry whose stamps jump back begins a new session, with an empty map
/// (urban_nav_live::RoundGate). Not thread-safe. Throws UserError or DataError if the store cannot be written.
class LiveMap {
 public:
  /// Statistics for the operator.
  struct Counts {
    LiveSensors::Counts sensors;
    std::size_t poses = 0;                        ///< of odometry
    std::size_t points = 0;                       ///< in the last map
    std::size_t chunks = 0, chunks_rendered = 0;  ///< all; in the last render()
    std::size_t updates_missed = 0;               ///< revisions of the graph that did not arrive
    std::size_t constraints = 0;                  ///< from planes, published
    std::size_t constraints_shared = 0;           ///< discounted, since an ICP closure uses some of their beams
  };

  /// `cloud_half_length`: of the clouds of ICP closures, m of path to either side of their stamps.
  LiveMap(const Parameters& parameters, std::string store_path, double cloud_half_length);
  ~LiveMap();
  LiveMap(const LiveMap&) = delete;
  LiveMap& operator=(const LiveMap&) = delete;

  /// Returns the sensors, whose mounting must be set before their measurements are added.
  LiveSensors& sensors() { return sensors_; }
  const LiveSensors& sensors() const { return sensors_; }
  void addScan(const std::string& frame, const urban_nav_core::Scan& scan);
  void addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep);
  void addDepth(const std::string& frame, urban_nav_core::StampNs stamp, const urban_nav_core::Pinhole& pinhole,
                LiveSensors::DecodeDepth decode);
  /// Adds depths of dense stereo, which are used if no planar laser measures surfaces around the robot.
  void addView(urban_nav_core::StampNs stamp, const urban_nav_core::DepthSamples& view,
               const urban_nav_core::Pose& T_base_camera);
  void addOdometry(const urban_nav_core::StampedPose& T_odom_base);
  void addGraph(const urban_nav_core::GraphUpdate& update);
  /// Adds a step of odometry between two poses of the graph, which constraints connect. It names the session, to which
  /// poses and closures are then restricted.
  void addStep(const urban_nav_core::SessionStep& step);
  /// Adds a closure of the running session; ignored unless it is accepted and measured by ICP.
  void addClosure(const urban_nav_core::MetricClosure& closure);

  /// Part of the map changed by render().
  struct ChangedTile {
    Tile tile;
    std::int64_t revision = 0;  ///< counted from 1
    std::vector<MapPoint> points;
  };

  /// Returns the points of the whole map.
  std::vector<MapPoint> render();
  /// Returns tiles that have changed since they were last taken, in the order of Tile, until they have at least `most`
  /// points; none if nothing has changed.
  std::vector<ChangedTile> takeChanged(std::size_t most);
  /// Makes takeChanged() return all tiles again.
  void repeatAll();
  /// Returns the layers for planners of the last map along the path within `radius` (m) of the newest pose; nullopt
  /// without points.
  std::optional<LiveLayers> makeLayers(double radius);
  /// Returns the consistency of the passes of the last map.
  MapQuality measureQuality();
  /// Updates the chunks and returns constraints between poses of the graph from planes measured in two passes
  /// (plane_constraints.hpp), each pair of intervals once: when the robot is so far away that neither further beams nor
  /// ICP closures from these beams will follow. Poses are those of the running session.
  std::vector<urban_nav_core::RelativeConstraint> takeConstraints();
  /// Renders the map and writes it as map.ply. Returns the number of points. Throws UserError or DataError naming the
  /// path.
  std::size_t save(const std::string& path);
  /// Removes all scans and poses.
  void clear();

  Counts counts() const;
  /// Returns the stamp of the newest pose; 0 without poses.
  urban_nav_core::StampNs newest() const;

 private:
  using Add = std::function<void()>;
  void sortByRound();
  /// Adds a measurement of the sensor when its round has begun.
  void addWhenPlaced(const std::string& frame, urban_nav_core::StampNs stamp, Add add);
  LiveSensors::MaybePose newestPose() const;
  int streamNumber(const std::string& frame);
  void take(const urban_nav_core::SessionStep& step);
  /// Returns whether a pose belongs to this session, as far as odometry has announced it.
  bool isOwn(const std::string& session) const {
    return session.empty() || announced_.empty() || session == announced_;
  }
  /// Returns the poses of the graph in this session.
  const std::map<urban_nav_core::StampNs, urban_nav_core::Pose>& graphPoses() const;
  void open();
  void update(LaserMap& map);
  std::vector<CloudClosure> cloudClosures(const urban_nav_core::Trajectory& trajectory) const;
  urban_nav_core::Trajectory trajectory() const;
  /// Published and current state of a tile.
  struct TileState {
    std::int64_t revision = 0;
    std::size_t digest = 0;
    bool is_changed = false;
    std::vector<MapPoint> points;
  };
  static void setTile(TileState& state, std::vector<MapPoint> points);

  const Parameters parameters_;
  const std::string path_;
  const double cloud_half_length_;
  std::unique_ptr<urban_nav_store::Store> store_;
  LiveSensors sensors_;
  std::map<urban_nav_core::StampNs, urban_nav_core::Pose> T_odom_base_;
  std::string announced_;        ///< id of the session; empty: not announced by odometry
  std::set<std::string> ended_;  ///< earlier sessions announced by odometry
  /// By session, because replays of a recording have equal stamps. Under "": poses of all sessions that have not ended.
  std::map<std::string, std::map<urban_nav_core::StampNs, urban_nav_core::Pose>> T_map_base_;
  std::set<urban_nav_core::StampNs> nodes_;
  OdometryDrift drift_;
  std::vector<CloudClosure> by_icp_;                         ///< accepted
  std::set<std::pair<std::int64_t, std::int64_t>> decided_;  ///< pairs of intervals with published constraints
  std::optional<std::int64_t> revision_;
  std::map<Tile, TileState> tiles_;
  Counts counts_;
  std::map<std::string, int> streams_;  ///< indices of the streams of sensors
  std::unique_ptr<urban_nav_live::RoundGate<Add>> rounds_;
};

}  // namespace laser_mapper
