// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/Trigger.h>
#include <unistd.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/MetricClosure.h>
#include <pluginlib/class_list_macros.hpp>

#include <chrono>
#include <filesystem>
#include <memory>
#include <tuple>
#include <variant>

#include "live/live_map.hpp"
#include "live/nodelet_parameters.hpp"
#include "map_messages.hpp"
#include "urban_nav_live/beam_faults.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_ros/laser_scan.hpp"
#include "urban_nav_ros/point_cloud.hpp"
#include "urban_nav_ros/robot_topics.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/sweep_feeds.hpp"
#include "urban_nav_ros/topics.hpp"

namespace laser_mapper {

using urban_nav_ros::ImageInput;
using urban_nav_ros::InfoInput;

namespace {

constexpr double kPointBytes = 50.0, kTileBytes = 100'000.0;  // per point; least amount per round
constexpr int kRestPerWork = 3;                               // pause after a cloud, in units of its computing time
constexpr double kConstraintPeriods = 5.0;                    // between two searches for constraints, at least

enum class MapFault { None = 0, NoOdometry = 1, NoLasers = 2, NoLaserPlace = 3, NotStored = 4 };

const char* toString(MapFault fault) {
  switch (fault) {
    case MapFault::None: return "None";
    case MapFault::NoOdometry: return "NoOdometry";
    case MapFault::NoLasers: return "NoLasers";
    case MapFault::NoLaserPlace: return "NoLaserPlace";
    case MapFault::NotStored: break;
  }
  return "NotStored";
}

std::string temporaryStore(const std::string& node) {
  std::string name = node;
  for (char& letter : name)
    if (letter == '/') letter = '_';
  return (std::filesystem::temp_directory_path() / ("laser_mapper" + name + "_" + std::to_string(::getpid()) + ".db"))
      .string();
}

}  // namespace

/// Publishes the laser map: records scans and poses, and renders a cloud while it has a subscriber.
class LaserMapperStage {
 public:
  static constexpr const char* name = "laser_mapper";
  static constexpr const char* topic = "laser map";
  using Input = std::variant<ImageInput, InfoInput, tf2_msgs::TFMessageConstPtr, sensor_msgs::LaserScanConstPtr,
                             sensor_msgs::PointCloud2ConstPtr, urban_nav_core::StampedPose, urban_nav_core::SessionStep,
                             urban_nav_core::GraphUpdate, urban_nav_core::MetricClosure>;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit LaserMapperStage(Node& node);

  void handle(Input& input);
  bool idle();
  std::string reset();
  void close() {}
  urban_nav_live::StageReport report() const;

 private:
  using Clock = std::chrono::steady_clock;
  void addScan(const sensor_msgs::LaserScan& message);
  void addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep);
  void publish();
  void publishCloud(const std::vector<MapPoint>& points);
  void publishTiles();
  void publishConstraints();
  /// Returns when the next task may begin after one that began at `begin`.
  static Clock::time_point nextTime(Clock::time_point begin, double period);
  bool isWanted() const;
  std::string save(const std::string& path);

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  std::unique_ptr<LiveMap> map_;
  urban_nav_ros::StaticTransforms transforms_;
  ros::Publisher cloud_, tiles_, quality_, constraints_;
  std::uint32_t tile_subscribers_ = 0;
  std::string unplaced_, store_fault_;
  urban_nav_ros::SweepFeeds sweeps_{
      {[this](const std::string& frame, const urban_nav_core::Sweep& sweep) { addSweep(frame, sweep); },
       [this] { node_.gate().countInvalid(); }}};
  urban_nav_live::BeamFaults beams_;
  bool changed_ = false, are_constraints_due_ = false;
  Clock::time_point due_, constraints_due_, tiles_sent_ = Clock::now();
  double seconds_ = 0.0;  ///< computing time of the last cloud
};

LaserMapperStage::LaserMapperStage(Node& node) : node_(node) {
  urban_nav_registration::Parameters registration;
  std::tie(nodelet_, parameters_, registration) = urban_nav_ros::readParameters(
      node.nh(), node.privateHandle(), nodeletTable(), table(), urban_nav_registration::table());
  node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
  map_ = std::make_unique<LiveMap>(parameters_, temporaryStore(node.name()), registration.cloud_half_length);
  cloud_ = node.nh().advertise<sensor_msgs::PointCloud2>(urban_nav_ros::topics::kMapCloud, 1, true);
  tiles_ = node.nh().advertise<urban_nav_msgs::MapTile>(urban_nav_ros::topics::kMapTiles, 100);
  quality_ = node.nh().advertise<urban_nav_msgs::MapQuality>(urban_nav_ros::topics::kMapQuality, 1, true);
  node.advertiseService<urban_nav_msgs::FileCommand>("save", [this](const auto& request, auto& response) {
    response.message = node_.ask([&] { return save(request.path); });
  });
  node.advertiseService<std_srvs::Trigger>(
      "clear", [this](const auto&, auto& response) { response.message = node_.ask([this] { return reset(); }); });
  subscribeRobot(node, nodelet_.queue_size, false, false, true);
  urban_nav_ros::TopicOptions options;
  options.is_monitored = options.is_paused = false;
  options.queue = nodelet_.queue_size;
  node.subscribeInput<urban_nav_msgs::GraphUpdate>(
      urban_nav_ros::topics::kGraphUpdate, options,
      [](const urban_nav_msgs::GraphUpdateConstPtr& message) { return urban_nav_ros::toGraphUpdate(*message); });
  if (!nodelet_.live_constraints) return;
  constraints_ = node.nh().advertise<urban_nav_msgs::RelativeConstraint>(urban_nav_ros::topics::kMapConstraints, 1000);
  node.subscribeInput<urban_nav_msgs::MetricClosure>(
      urban_nav_ros::topics::kMetricClosure, options,
      [](const urban_nav_msgs::MetricClosureConstPtr& message) { return urban_nav_ros::toMetricClosure(*message); });
}

void LaserMapperStage::handle(Input& input) {
  try {
    if (const auto* transforms = std::get_if<tf2_msgs::TFMessageConstPtr>(&input)) transforms_.add(**transforms);
    else if (const auto* scan = std::get_if<sensor_msgs::LaserScanConstPtr>(&input)) addScan(**scan);
    else if (const auto* cloud = std::get_if<sensor_msgs::PointCloud2ConstPtr>(&input)) sweeps_.add(*cloud);
    else if (const auto* odometry = std::get_if<urban_nav_core::StampedPose>(&input)) map_->addOdometry(*odometry);
    else if (const auto* update = std::get_if<urban_nav_core::GraphUpdate>(&input)) map_->addGraph(*update);
    else if (const auto* closure = std::get_if<urban_nav_core::MetricClosure>(&input)) map_->addClosure(*closure);
    else if (const auto* step = std::get_if<urban_nav_core::SessionStep>(&input)) map_->addStep(*step);
    changed_ = are_constraints_due_ = true;  // scans may arrive after the poses of their time, which may be the last
  } catch (const urban_nav_core::Error& error) {
    store_fault_ = error.what();
  }
}

void LaserMapperStage::addScan(const sensor_msgs::LaserScan& message) {
  const auto planar = urban_nav_ros::toPlanarScan(message);
  if (!planar) return node_.gate().countInvalid();
  beams_.add(*planar);
  const std::string& frame = message.header.frame_id;
  if (!map_->isPlaced(frame)) {
    const auto T_base_laser = transforms_.lookup(nodelet_.base_frame, frame);
    if (T_base_laser) map_->placeLaser(frame, *T_base_laser);
    unplaced_ = T_base_laser ? "" : frame;
  }
  map_->addScan(frame, urban_nav_core::toScan(*planar));
}

void LaserMapperStage::addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep) {
  if (!map_->isPlaced(frame)) {
    const auto T_base_lidar = transforms_.lookup(nodelet_.base_frame, frame);
    if (T_base_lidar) map_->placeLidar(frame, *T_base_lidar);
    unplaced_ = T_base_lidar ? "" : frame;
  }
  map_->addSweep(frame, sweep);
}

bool LaserMapperStage::idle() {
  const urban_nav_live::StageReport now = report();
  node_.publishStatus(now.status, now.reason_name, map_->newest());
  publishTiles();
  publishConstraints();
  if (!changed_ || !isWanted() || Clock::now() < due_) return false;
  const Clock::time_point begin = Clock::now();
  try {
    publish();
    store_fault_.clear();
  } catch (const urban_nav_core::Error& error) {
    store_fault_ = error.what();
    node_.logError(store_fault_);
  }
  changed_ = false;
  seconds_ = std::chrono::duration<double>(Clock::now() - begin).count();
  due_ = nextTime(begin, nodelet_.period);
  return false;
}

LaserMapperStage::Clock::time_point LaserMapperStage::nextTime(Clock::time_point begin, double period) {
  const Clock::duration taken = Clock::now() - begin;
  return Clock::now() +
         std::max<Clock::duration>(kRestPerWork * taken, std::chrono::milliseconds(static_cast<int>(1e3 * period)));
}

void LaserMapperStage::publishConstraints() {
  if (!nodelet_.live_constraints || !are_constraints_due_ || Clock::now() < constraints_due_ ||
      constraints_.getNumSubscribers() == 0)
    return;
  const Clock::time_point begin = Clock::now();
  try {
    for (const urban_nav_core::RelativeConstraint& constraint : map_->takeConstraints())
      constraints_.publish(urban_nav_ros::toRelativeConstraintMessage(constraint, nodelet_.base_frame));
  } catch (const urban_nav_core::Error& error) {
    store_fault_ = error.what();
    node_.logError(store_fault_);
  }
  are_constraints_due_ = false;
  constraints_due_ = nextTime(begin, kConstraintPeriods * nodelet_.period);
}

bool LaserMapperStage::isWanted() const {
  return cloud_.getNumSubscribers() + tiles_.getNumSubscribers() + quality_.getNumSubscribers() > 0;
}

void LaserMapperStage::publish() {
  const std::vector<MapPoint> points = map_->render();
  if (cloud_.getNumSubscribers() > 0 && !points.empty()) publishCloud(points);
  if (quality_.getNumSubscribers() > 0)
    quality_.publish(toMapQualityMessage(map_->measureQuality(), nodelet_.map_frame, map_->newest()));
}

/// Publishes changes within the bandwidth; all tiles to a new subscriber.
void LaserMapperStage::publishTiles() {
  const std::uint32_t subscribers = tiles_.getNumSubscribers();
  if (subscribers > tile_subscribers_) map_->repeatAll();
  tile_subscribers_ = subscribers;
  if (subscribers == 0) return;
  const double allowed =
      1e6 * nodelet_.tile_bandwidth * std::chrono::duration<double>(Clock::now() - tiles_sent_).count();
  if (allowed < kTileBytes) return;
  tiles_sent_ = Clock::now();
  for (const LiveMap::ChangedTile& tile : map_->takeChanged(static_cast<std::size_t>(allowed / kPointBytes)))
    tiles_.publish(toMapTileMessage(tile, parameters_.voxel, nodelet_.map_frame, map_->newest()));
}

std::string LaserMapperStage::save(const std::string& path) {
  return path + ": " + std::to_string(map_->save(path)) + " points";
}

void LaserMapperStage::publishCloud(const std::vector<MapPoint>& points) {
  std::vector<Eigen::Vector4f> rows;
  rows.reserve(points.size());
  for (const MapPoint& point : points)
    rows.emplace_back(point.p.x(), point.p.y(), point.p.z(), static_cast<float>(point.intensity));
  sensor_msgs::PointCloud2 cloud = urban_nav_ros::toPointCloudMessage(rows, "intensity");
  cloud.header.frame_id = nodelet_.map_frame;
  cloud.header.stamp = urban_nav_ros::toRosTime(map_->newest());
  cloud_.publish(cloud);
}

std::string LaserMapperStage::reset() {
  map_->clear();
  return "the map is empty";
}

urban_nav_live::StageReport LaserMapperStage::report() const {
  const urban_nav_live::TopicMonitor& monitor = node_.monitor();
  const std::string odometry = monitor.fault(urban_nav_ros::topic_groups::kOdometry);
  const std::string lasers = monitor.fault(urban_nav_ros::topic_groups::kLasers);
  MapFault fault = MapFault::None;
  std::string sentence;
  const auto set = [&](MapFault as, const std::string& text) {
    if (text.empty() || fault != MapFault::None || node_.gate().isPaused()) return;
    fault = as;
    sentence = text;
  };
  set(MapFault::NotStored, store_fault_);
  set(MapFault::NoOdometry, odometry);
  set(MapFault::NoLasers, sweeps_.fault());
  if (map_->counts().sweeps == 0) set(MapFault::NoLasers, lasers);
  if (!unplaced_.empty()) set(MapFault::NoLaserPlace, "no static tf from " + nodelet_.base_frame + " to " + unplaced_);
  urban_nav_live::StageReport report;
  if (fault != MapFault::None) report.status = {urban_nav_core::Health::Degraded, static_cast<int>(fault), sentence};
  report.reason_name = toString(fault);
  report.is_error = fault == MapFault::NotStored;
  const LiveMap::Counts& counts = map_->counts();
  report.add("scans", counts.scans);
  report.add("sweeps stored", counts.sweeps);
  report.add("scans and sweeps of lasers without a pose on the robot", counts.scans_unplaced);
  report.add("poses of odometry", counts.poses);
  report.add("revisions of the graph missed", counts.updates_missed);
  beams_.addTo(report);
  report.add("points", counts.points);
  report.add("chunks", counts.chunks);
  report.add("chunks rendered last", counts.chunks_rendered);
  report.add("time of the last cloud (s)", seconds_);
  if (nodelet_.live_constraints) {
    report.add("constraints from planes", counts.constraints);
    report.add("constraints discounted for ICP closures", counts.constraints_shared);
  }
  return report;
}

class LaserMapperNodelet : public urban_nav_ros::StageNodelet<LaserMapperStage> {};

}  // namespace laser_mapper

PLUGINLIB_EXPORT_CLASS(laser_mapper::LaserMapperNodelet, nodelet::Nodelet)
