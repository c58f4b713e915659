// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/PointCloud2.h>
#include <std_srvs/Trigger.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/MetricClosure.h>
#include <pluginlib/class_list_macros.hpp>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <tuple>
#include <variant>

#include "live/live_map.hpp"
#include "live/live_report.hpp"
#include "live/nodelet_parameters.hpp"
#include "map_messages.hpp"
#include "urban_nav_live/beam_faults.hpp"
#include "urban_nav_registration/parameters.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/depth_inputs.hpp"
#include "urban_nav_ros/depth_view.hpp"
#include "urban_nav_ros/extrinsics.hpp"
#include "urban_nav_ros/graph.hpp"
#include "urban_nav_ros/grid_message.hpp"
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

constexpr int kViewQueue = 5;
constexpr double kPointBytes = 50.0, kTileBytes = 100'000.0;  // per point; least amount per round
constexpr int kRestPerWork = 3;                               // pause after a cloud, in units of its computing time
constexpr double kConstraintPeriods = 5.0;                    // between two searches for constraints, at least

}  // namespace

/// Publishes the laser map: records scans and poses, and renders a cloud while it has a subscriber.
class LaserMapperStage {
 public:
  static constexpr const char* name = "laser_mapper";
  static constexpr const char* topic = "laser map";
  using Input = std::variant<ImageInput, InfoInput, tf2_msgs::TFMessageConstPtr, sensor_msgs::LaserScanConstPtr,
                             sensor_msgs::PointCloud2ConstPtr, urban_nav_core::StampedPose, urban_nav_core::SessionStep,
                             urban_nav_core::GraphUpdate, urban_nav_core::MetricClosure, urban_nav_ros::DepthMessage,
                             urban_nav_msgs::DepthViewConstPtr>;
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
  void placeLaser(const std::string& frame, const urban_nav_core::Pose& T_base_laser);
  void addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep);
  void addDepth(const urban_nav_ros::DepthInputs::Image& image);
  void addView(const urban_nav_msgs::DepthView& message);
  /// Returns the mounting of a sensor, or notes that it is unknown.
  std::optional<urban_nav_core::Pose> findPlace(const std::string& frame);
  void publish();
  void publishCloud(const std::vector<MapPoint>& points);
  void publishTiles();
  void publishConstraints();
  /// Returns when the next task may begin after one that began at `begin`.
  static Clock::time_point nextTime(Clock::time_point begin, double period);
  bool isWanted() const;
  bool areLayersWanted() const;
  /// Publishes the layers for planners within the bandwidth.
  void publishLayers();
  std::string save(const std::string& path);

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  std::unique_ptr<LiveMap> map_;
  urban_nav_ros::StaticTransforms transforms_;
  ros::Publisher cloud_, tiles_, quality_, constraints_, grid_, traversability_, terrain_;
  std::uint32_t tile_subscribers_ = 0;
  std::set<std::string> unplaced_;  ///< frames of sensors with unknown mounting
  std::string store_fault_;
  urban_nav_ros::SweepFeeds sweeps_{
      {[this](const std::string& frame, const urban_nav_core::Sweep& sweep) { addSweep(frame, sweep); },
       [this] { node_.gate().countInvalid(); }}};
  urban_nav_ros::DepthInputs depth_{[this](const auto& image) { addDepth(image); }};
  urban_nav_live::BeamFaults beams_;
  bool changed_ = false, are_constraints_due_ = false, have_layers_changed_ = false;
  Clock::time_point due_, constraints_due_, layers_due_, tiles_sent_ = Clock::now();
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
  grid_ = node.nh().advertise<nav_msgs::OccupancyGrid>(urban_nav_ros::topics::kMapGrid, 1, true);
  traversability_ = node.nh().advertise<nav_msgs::OccupancyGrid>(urban_nav_ros::topics::kMapTraversability, 1, true);
  terrain_ = node.nh().advertise<sensor_msgs::PointCloud2>(urban_nav_ros::topics::kMapTerrain, 1, true);
  node.advertiseService<urban_nav_msgs::FileCommand>("save", [this](const auto& request, auto& response) {
    response.message = node_.ask([&] { return save(request.path); });
  });
  node.advertiseService<std_srvs::Trigger>(
      "clear", [this](const auto&, auto& response) { response.message = node_.ask([this] { return reset(); }); });
  subscribeRobot(node, nodelet_.queue_size, false, false, true);
  urban_nav_ros::subscribeDepth(node, static_cast<std::size_t>(nodelet_.depth_cameras), nodelet_.compressed_depth);
  if (parameters_.stereo) {
    urban_nav_ros::TopicOptions of_views;
    of_views.is_monitored = false;
    of_views.queue = kViewQueue;
    node.subscribeInput<urban_nav_msgs::DepthView>(urban_nav_ros::topics::kDepthView, of_views,
                                                   [](const auto& message) { return Input(message); });
  }
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
    else if (const auto* depth = std::get_if<urban_nav_ros::DepthMessage>(&input)) depth_.handle(*depth);
    else if (const auto* view = std::get_if<urban_nav_msgs::DepthViewConstPtr>(&input)) addView(**view);
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
  if (!map_->sensors().isPlaced(frame))
    if (const auto T_base_laser = findPlace(frame)) placeLaser(frame, *T_base_laser);
  map_->addScan(frame, urban_nav_core::toScan(*planar));
}

void LaserMapperStage::placeLaser(const std::string& frame, const urban_nav_core::Pose& T_base_laser) {
  map_->sensors().placeLaser(frame, T_base_laser);
  // Dense stereo need not be computed for the map.
  if (map_->sensors().hasTiltedLaser()) node_.unsubscribe(urban_nav_ros::topics::kDepthView);
}

void LaserMapperStage::addSweep(const std::string& frame, const urban_nav_core::Sweep& sweep) {
  if (!map_->sensors().isPlaced(frame))
    if (const auto T_base_lidar = findPlace(frame)) map_->sensors().placeLidar(frame, *T_base_lidar);
  map_->addSweep(frame, sweep);
}

void LaserMapperStage::addDepth(const urban_nav_ros::DepthInputs::Image& image) {
  if (!map_->sensors().isPlaced(image.frame))
    if (const auto T_base_camera = findPlace(image.frame))
      map_->sensors().placeDepthCamera(image.frame, *T_base_camera);
  map_->addDepth(image.frame, image.stamp, image.pinhole, image.decode);
}

void LaserMapperStage::addView(const urban_nav_msgs::DepthView& message) {
  const std::optional<urban_nav_core::DepthSamples> view = urban_nav_ros::toDepthSamples(message);
  if (!view) return node_.gate().countInvalid();
  if (const auto T_base_camera = findPlace(message.header.frame_id))
    map_->addView(urban_nav_ros::toStampNs(message.header.stamp), *view, *T_base_camera);
}

std::optional<urban_nav_core::Pose> LaserMapperStage::findPlace(const std::string& frame) {
  const auto T_base_sensor = transforms_.lookup(nodelet_.base_frame, frame);
  if (T_base_sensor) unplaced_.erase(frame);
  else unplaced_.insert(frame);
  return T_base_sensor;
}

bool LaserMapperStage::idle() {
  const urban_nav_live::StageReport now = report();
  node_.publishStatus(now.status, now.reason_name, map_->newest());
  publishTiles();
  publishConstraints();
  publishLayers();
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
  return areLayersWanted() ||
         cloud_.getNumSubscribers() + tiles_.getNumSubscribers() + quality_.getNumSubscribers() > 0;
}

bool LaserMapperStage::areLayersWanted() const {
  return grid_.getNumSubscribers() + traversability_.getNumSubscribers() + terrain_.getNumSubscribers() > 0;
}

void LaserMapperStage::publish() {
  const std::vector<MapPoint> points = map_->render();
  if (cloud_.getNumSubscribers() > 0 && !points.empty()) publishCloud(points);
  if (quality_.getNumSubscribers() > 0)
    quality_.publish(toMapQualityMessage(map_->measureQuality(), nodelet_.map_frame, map_->newest()));
  have_layers_changed_ = true;
}

void LaserMapperStage::publishLayers() {
  if (!have_layers_changed_ || !areLayersWanted() || Clock::now() < layers_due_) return;
  const Clock::time_point begin = Clock::now();
  const std::optional<LiveLayers> layers = map_->makeLayers(nodelet_.layer_radius);
  have_layers_changed_ = false;
  if (!layers) return;
  std::size_t bytes = 0;
  const Raster& cells = layers->elevation;
  const urban_nav_ros::GridCells places{cells.width, cells.height, cells.x0, cells.y0, cells.cell};
  const auto publishGrid = [&](const ros::Publisher& publisher, const std::vector<std::int8_t>& values) {
    if (publisher.getNumSubscribers() == 0) return;
    publisher.publish(urban_nav_ros::toGridMessage(places, values, nodelet_.map_frame, map_->newest()));
    bytes += values.size();
  };
  publishGrid(grid_, layers->occupancy);
  publishGrid(traversability_, layers->traverse_cost);
  if (terrain_.getNumSubscribers() > 0) {
    sensor_msgs::PointCloud2 terrain = urban_nav_ros::toPointCloudMessage(terrainFields(), terrainPoints(*layers));
    terrain.header.frame_id = nodelet_.map_frame;
    terrain.header.stamp = urban_nav_ros::toRosTime(map_->newest());
    terrain.is_dense = 0U;
    terrain_.publish(terrain);
    bytes += terrain.data.size();
  }
  const double seconds = static_cast<double>(bytes) / (1e6 * nodelet_.tile_bandwidth);
  layers_due_ = nextTime(begin, std::max(seconds, nodelet_.period));
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
  have_layers_changed_ = false;
  return "the map is empty";
}

urban_nav_live::StageReport LaserMapperStage::report() const {
  const urban_nav_live::TopicMonitor& monitor = node_.monitor();
  MapFaults faults;
  faults.store = store_fault_;
  faults.odometry = monitor.fault(urban_nav_ros::topic_groups::kOdometry);
  faults.clouds = sweeps_.fault();
  faults.depth = depth_.fault();
  if (!unplaced_.empty()) faults.places = "no static tf from " + nodelet_.base_frame + " to " + *unplaced_.begin();
  faults.lasers = monitor.fault(urban_nav_ros::topic_groups::kLasers);
  faults.is_paused = node_.gate().isPaused();
  const LiveMap::Counts counts = map_->counts();
  urban_nav_live::StageReport report = reportOnMap(counts, faults);
  beams_.addTo(report);
  depth_.addTo(report);
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
