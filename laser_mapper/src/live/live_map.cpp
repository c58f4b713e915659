// SPDX-License-Identifier: BSD-3-Clause
#include "live/live_map.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "laser_mapper/laser_map.hpp"
#include "laser_mapper/map_files.hpp"
#include "laser_mapper/sensors.hpp"
#include "urban_nav_core/types/error.hpp"

namespace laser_mapper {

using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::Trajectory;

namespace {

constexpr const char* kLiveSession = "00000000000000000000";
constexpr const char* kStereoViews = "";  // name of the stream of dense stereo; those of sensors are frames
constexpr int kOdometryStream = 0, kStepStream = 1, kFirstSensorStream = 2;
constexpr StampNs kOdometryPatience = 60'000'000'000;  // ns of scans of a new session that wait for its odometry
constexpr StampNs kFewSeconds = 5'000'000'000;         // from a pose of odometry until closures near it are measured

/// Returns the poses of a trajectory at the given stamps.
Trajectory posesAt(const Trajectory& trajectory, const std::set<StampNs>& stamps) {
  Trajectory some;
  for (const urban_nav_core::StampedPose& pose : trajectory)
    if (stamps.count(pose.stamp) != 0) some.append(pose.stamp, pose.pose);
  return some;
}

/// Returns the last stamp at which the robot was at least `distance` (m) of path before the end; 0: never.
StampNs lastStampBefore(const Trajectory& trajectory, double distance) {
  double left = distance;
  for (std::size_t i = trajectory.size(); i-- > 1;) {
    left -= distanceBetween(trajectory[i - 1].pose, trajectory[i].pose);
    if (left <= 0.0) return trajectory[i - 1].stamp;
  }
  return 0;
}

std::size_t pointsDigest(const std::vector<MapPoint>& points) {
  std::string bytes;
  for (const MapPoint& point : points) appendVertex(bytes, point);
  return std::hash<std::string>()(bytes);
}

}  // namespace

LiveMap::LiveMap(const Parameters& parameters, std::string store_path, double cloud_half_length)
    : parameters_(parameters),
      path_(std::move(store_path)),
      cloud_half_length_(cloud_half_length),
      sensors_(kLiveSession) {
  open();
  sortByRound();
}

void LiveMap::sortByRound() {
  urban_nav_live::RoundGate<Add>::Options options;
  options.leading = {kOdometryStream};
  options.patience = kOdometryPatience;
  rounds_ = std::make_unique<urban_nav_live::RoundGate<Add>>(
      options, urban_nav_live::RoundGate<Add>::Listener{[](Add& add) { add(); }, [this] { clear(); }});
}

int LiveMap::streamNumber(const std::string& frame) {
  return streams_.try_emplace(frame, kFirstSensorStream + static_cast<int>(streams_.size())).first->second;
}

LiveMap::~LiveMap() {
  store_.reset();
  try {
    urban_nav_store::removeStore(path_);
  } catch (const urban_nav_core::Error&) {  // a remaining temporary file is harmless
  }
}

void LiveMap::open() {
  store_.reset();
  urban_nav_store::removeStore(path_);
  store_ = std::make_unique<urban_nav_store::Store>(path_, urban_nav_store::Access::Write);
  store_->sessions().put(urban_nav_store::Session{kLiveSession, "live", "", "", 0, false});
  sensors_.begin(*store_);
}

void LiveMap::clear() {
  open();
  T_odom_base_.clear();
  // The graph may already have sent poses of the new session.
  T_map_base_.erase(announced_);
  T_map_base_.erase("");
  if (!announced_.empty()) ended_.insert(announced_);
  announced_.clear();
  nodes_.clear();
  drift_ = {};
  by_icp_.clear();
  decided_.clear();
  revision_.reset();
  for (auto& [tile, state] : tiles_) setTile(state, {});
  counts_ = {};
}

void LiveMap::addWhenPlaced(const std::string& frame, StampNs stamp, Add add) {
  if (sensors_.isPlaced(frame)) rounds_->add(streamNumber(frame), stamp, std::move(add));
  else sensors_.countUnplaced();
}

LiveSensors::MaybePose LiveMap::newestPose() const {
  return T_odom_base_.empty() ? std::nullopt : LiveSensors::MaybePose(T_odom_base_.rbegin()->second);
}

void LiveMap::addScan(const std::string& frame, const urban_nav_core::Scan& scan) {
  addWhenPlaced(frame, scan.stamp, [this, frame, scan] { sensors_.put(frame, scan); });
}

void LiveMap::addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep) {
  addWhenPlaced(frame, sweep.reference, [this, frame, sweep] { sensors_.put(frame, sweep, newestPose()); });
}

void LiveMap::addDepth(const std::string& frame, StampNs stamp, const urban_nav_core::Pinhole& pinhole,
                       LiveSensors::DecodeDepth decode) {
  addWhenPlaced(frame, stamp, [this, frame, stamp, pinhole, decode = std::move(decode)] {
    sensors_.put(frame, stamp, pinhole, decode, newestPose());
  });
}

void LiveMap::addView(StampNs stamp, const urban_nav_core::DepthSamples& view, const Pose& T_base_camera) {
  rounds_->add(streamNumber(kStereoViews), stamp,
               [this, stamp, view, T_base_camera] { sensors_.put(stamp, view, T_base_camera, newestPose()); });
}

LiveMap::Counts LiveMap::counts() const {
  Counts counts = counts_;
  counts.sensors = sensors_.counts();
  return counts;
}

void LiveMap::addOdometry(const urban_nav_core::StampedPose& T_odom_base) {
  rounds_->add(kOdometryStream, T_odom_base.stamp, [this, T_odom_base] {
    T_odom_base_[T_odom_base.stamp] = T_odom_base.pose;
    counts_.poses = T_odom_base_.size();
  });
}

void LiveMap::addStep(const urban_nav_core::SessionStep& step) {
  rounds_->add(kStepStream, step.to, [this, step] { take(step); });
}

void LiveMap::take(const urban_nav_core::SessionStep& step) {
  if (step.session && step.session->id != announced_) {
    if (!announced_.empty()) ended_.insert(announced_);
    announced_ = step.session->id;
    ended_.erase(announced_);
  }
  nodes_.insert({step.from, step.to});
  drift_.add(step);
}

void LiveMap::addGraph(const urban_nav_core::GraphUpdate& update) {
  if (revision_ && update.previous != *revision_) ++counts_.updates_missed;
  revision_ = update.revision;
  for (const urban_nav_core::TrajectorySegment& run : update.segments) {
    if (ended_.count(run.session) > 0) continue;
    for (const urban_nav_core::StampedMapPose& pose : run.poses)
      T_map_base_[run.session][pose.stamp] = T_map_base_[""][pose.stamp] = pose.T_map_base;
  }
}

const std::map<StampNs, Pose>& LiveMap::graphPoses() const {
  static const std::map<StampNs, Pose> none;
  const auto own = T_map_base_.find(announced_);
  if (own != T_map_base_.end()) return own->second;
  const auto all = T_map_base_.find("");
  return all == T_map_base_.end() ? none : all->second;
}

void LiveMap::addClosure(const urban_nav_core::MetricClosure& closure) {
  if (closure.verdict == urban_nav_core::ClosureVerdict::Accepted && isOwn(closure.a.session) &&
      isOwn(closure.b.session) && closure.method == urban_nav_core::ClosureMethod::Icp)
    by_icp_.push_back({0, 0, closure.a.stamp, closure.b.stamp, closure.measured});
}

/// Closures with other sessions, whose times are outside this one, share no beams.
std::vector<CloudClosure> LiveMap::cloudClosures(const Trajectory& trajectory) const {
  std::vector<CloudClosure> closures;
  for (const CloudClosure& each : by_icp_)
    if (std::min(each.stamp_a, each.stamp_b) >= trajectory.front().stamp &&
        std::max(each.stamp_a, each.stamp_b) <= trajectory.back().stamp)
      closures.push_back(each);
  return closures;
}

StampNs LiveMap::newest() const { return T_odom_base_.empty() ? 0 : T_odom_base_.rbegin()->first; }

/// Returns the poses of odometry, each corrected by the graph's latest pose before it.
Trajectory LiveMap::trajectory() const {
  Trajectory made;
  Pose T_map_odom;
  const auto& T_map_base = graphPoses();
  auto next = T_map_base.begin();
  bool known = false;
  for (const auto& [stamp, T_odom_base] : T_odom_base_) {
    while (next != T_map_base.end() && next->first < stamp) ++next;
    if (next != T_map_base.end() && next->first == stamp) {
      T_map_odom = next->second * T_odom_base.inverse();
      known = true;
    }
    if (known || T_map_base.empty()) made.append(stamp, T_map_odom * T_odom_base);
  }
  return made;
}

void LiveMap::setTile(TileState& state, std::vector<MapPoint> points) {
  const std::size_t digest = pointsDigest(points);
  if (state.revision > 0 && digest == state.digest) return;
  state.digest = digest;
  state.is_changed = true;
  ++state.revision;
  state.points = std::move(points);
}

std::vector<LiveMap::ChangedTile> LiveMap::takeChanged(std::size_t most) {
  std::vector<ChangedTile> changed;
  std::size_t points = 0;
  for (auto& [tile, state] : tiles_) {
    if (points >= most) break;
    if (!std::exchange(state.is_changed, false)) continue;
    changed.push_back({tile, state.revision, state.points});
    points += state.points.size();
  }
  return changed;
}

void LiveMap::repeatAll() {
  for (auto& [tile, state] : tiles_) state.is_changed = true;
}

std::optional<LiveLayers> LiveMap::makeLayers(double radius) {
  const Trajectory T_map_base = trajectory();
  if (T_map_base.empty() || counts_.points == 0) return std::nullopt;
  std::vector<urban_nav_core::Vector3d> path;
  for (const urban_nav_core::StampedPose& pose : T_map_base)
    if (distanceBetween(pose.pose, T_map_base.back().pose) <= radius) path.push_back(pose.pose.t());
  const std::map<std::uint8_t, Pose> places = sensorPlaces(*store_, kLiveSession);
  const auto origin = [&](const MapPoint& point) { return beamOrigin(point, T_map_base, places); };
  return makeLiveLayers(
      [this](const std::function<void(const std::vector<MapPoint>&)>& take) {
        for (const auto& [tile, state] : tiles_) take(state.points);
      },
      path, origin);
}

MapQuality LiveMap::measureQuality() {
  const Trajectory T_map_base = trajectory();
  if (T_map_base.empty() || counts_.chunks == 0) return {};
  LaserMap map(parameters_, *store_, {{kLiveSession, &T_map_base, nullptr}});
  map.load();
  return MapQuality(map);
}

std::size_t LiveMap::save(const std::string& path) {
  urban_nav_core::PlyWriter file(path, mapLayout());
  for (const MapPoint& point : render()) {
    std::string bytes;
    appendVertex(bytes, point);
    file.append(bytes);
  }
  const std::size_t points = file.vertices();
  file.commit();
  return points;
}

std::vector<urban_nav_core::RelativeConstraint> LiveMap::takeConstraints() {
  const Trajectory T_map_base = trajectory();
  const Trajectory nodes = posesAt(T_map_base, nodes_);
  if (nodes.empty() || store_->scans().lasers(kLiveSession).empty()) return {};
  LaserMap map(parameters_, *store_, {{kLiveSession, &T_map_base, nullptr}});
  update(map);
  const SharedBeams by_icp({&nodes}, cloudClosures(T_map_base), cloud_half_length_);
  const StampNs complete = std::min(lastStampBefore(nodes, 2.0 * cloud_half_length_), nodes.back().stamp - kFewSeconds);
  std::vector<urban_nav_core::RelativeConstraint> taken;
  for (const PlaneConstraint& found :
       by_icp.discount(findPlaneConstraints(MapQuality(map).places(), {&nodes}, parameters_.range_bias, {&drift_}))) {
    const StampNs end = nodes.front().stamp + (std::max(found.stretch_a, found.stretch_b) + 1) * kPlaneGroupTime;
    if (end > complete || !decided_.insert({found.stretch_a, found.stretch_b}).second) continue;
    if (found.is_shared) ++counts_.constraints_shared;
    if (found.measured.information.isZero(0.0)) continue;
    taken.push_back({{"", found.stamp_a}, {"", found.stamp_b}, found.measured, "plane", "laser_mapper"});
  }
  counts_.constraints += taken.size();
  return taken;
}

void LiveMap::update(LaserMap& map) {
  const RenderStatistics rendered = map.render();
  counts_.chunks = rendered.chunks;
  counts_.chunks_rendered = rendered.chunks_rendered;
}

std::vector<MapPoint> LiveMap::render() {
  std::vector<MapPoint> points;
  const Trajectory T_map_base = trajectory();
  const LiveSensors::Counts& stored = sensors_.counts();
  if (T_map_base.empty() || stored.scans + stored.sweeps + stored.depth_images + stored.stereo_views == 0)
    return points;
  LaserMap map(parameters_, *store_, {{kLiveSession, &T_map_base, nullptr}});
  update(map);
  std::set<Tile> gone;
  for (const auto& [tile, state] : tiles_) gone.insert(tile);
  map.forEachTile([&](const Tile& tile, const std::vector<MapPoint>& made) {
    points.insert(points.end(), made.begin(), made.end());
    setTile(tiles_[tile], made);
    gone.erase(tile);
  });
  for (const Tile& tile : gone) setTile(tiles_[tile], {});
  counts_.points = points.size();
  return points;
}

}  // namespace laser_mapper
