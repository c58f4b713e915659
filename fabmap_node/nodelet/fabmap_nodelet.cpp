// SPDX-License-Identifier: BSD-3-Clause
#include <nav_msgs/Odometry.h>
#include <urban_nav_msgs/FileCommand.h>
#include <urban_nav_msgs/PlaceBelief.h>
#include <pluginlib/class_list_macros.hpp>

#include <optional>
#include <tuple>
#include <variant>

#include "belief_markers.hpp"
#include "live/belief_trail.hpp"
#include "live/live_places.hpp"
#include "live/nodelet_parameters.hpp"
#include "live/place_images.hpp"
#include "urban_nav_ros/closure.hpp"
#include "urban_nav_ros/head_images.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/panorama_feed.hpp"
#include "urban_nav_ros/pose.hpp"
#include "urban_nav_ros/stage_nodelet.hpp"
#include "urban_nav_ros/topics.hpp"

namespace fabmap_node {

using urban_nav_core::MetricClosure;
using urban_nav_ros::HeadImages;
using urban_nav_ros::PanoramaFeed;
using urban_nav_ros::RecordedImage;

namespace {

constexpr double kOdometryTimeout = 5.0;  // s
// Time by stamps that images of the left camera wait for a panoramic head, which begins within a period of its own
// (Ladybug2 of the paper: 3 Hz) and of the start of its driver.
constexpr urban_nav_core::StampNs kHeadPatience = 3'000'000'000;

/// Image of one camera of the head, or of the left camera.
struct CameraImage {
  std::size_t camera = 0;
  RecordedImage image;
};

struct OdometryPose {
  urban_nav_core::StampedPose T_odom_base;
  std::string odom_frame;
};

urban_nav_msgs::PlaceBelief toMessage(const PlaceBelief& belief) {
  urban_nav_msgs::PlaceBelief message;
  message.header.stamp = urban_nav_ros::toRosTime(belief.at.stamp);
  message.knowledge = static_cast<std::uint8_t>(belief.knowledge);
  message.observation = toString(belief.observation);
  message.is_stationary = belief.is_stationary;
  message.p_new = belief.p_new;
  for (const LikelyPlace& place : belief.likeliest) {
    message.places.push_back(urban_nav_ros::toPoseRefMessage(place.at));
    message.probabilities.push_back(place.probability);
    message.verdicts.push_back(static_cast<std::uint8_t>(place.verdict ? 1 + static_cast<int>(*place.verdict) : 0));
  }
  return message;
}

}  // namespace

/// Publishes places/belief and places/closure from panoramas and odometry; places/markers while it has a subscriber.
class FabmapStage {
 public:
  static constexpr const char* name = "fabmap_node";
  static constexpr const char* topic = "place recognition";
  using Input = std::variant<CameraImage, OdometryPose, urban_nav_core::OdometrySessionPtr, MetricClosure>;
  using Node = urban_nav_ros::StageNodeWith<Input>;

  explicit FabmapStage(Node& node);

  void handle(Input& input);
  bool idle();
  std::string reset();
  void close() { topics_->shutDown(); }
  static constexpr int kFinishOrder = 0;  // before the stage that measures its closures
  void finish(std::chrono::milliseconds /*limit*/) {
    images_->finish();
    places_->commit();
  }
  urban_nav_live::StageReport report() const;

 private:
  using Images = PlaceImages<RecordedImage, PanoramaFeed>;
  void takeImages();
  void choose(ImageSource source);
  void subscribeOdometry();
  void advertiseFiles();
  void loadMap();
  void process(urban_nav_core::StampNs stamp, const std::vector<RecordedImage>& images);
  void addOdometry(const OdometryPose& pose);
  void publish(const std::vector<PlaceBelief>& changed);
  void publishMarkers();

  Node& node_;
  NodeletParameters nodelet_;
  Parameters parameters_;
  ros::Publisher belief_, closure_, markers_;
  std::unique_ptr<Images> images_;
  std::unique_ptr<LivePlaces> places_;
  std::optional<HeadImages> topics_;
  BeliefTrail trail_;
  std::string odom_frame_;
  std::size_t drawn_ = 0;  // count of the trail at the last drawing
};

FabmapStage::FabmapStage(Node& node) : node_(node) {
  std::tie(nodelet_, parameters_) = node.parameters(nodeletTable(), table());
  node.setQueueSize(nodelet_.queue_size, nodelet_.drain_s);
  places_ = std::make_unique<LivePlaces>(parameters_, LiveSessionName{nodelet_.robot, nodelet_.recording, true},
                                         nodelet_.store, LivePlaceStore::defaultOptions());
  loadMap();
  takeImages();
  belief_ = node.nh().advertise<urban_nav_msgs::PlaceBelief>(urban_nav_ros::topics::kPlaceBelief, 100);
  closure_ = node.nh().advertise<urban_nav_msgs::TopologicalClosure>(urban_nav_ros::topics::kPlaceClosure, 1000);
  markers_ = node.nh().advertise<visualization_msgs::MarkerArray>(urban_nav_ros::topics::kPlaceMarkers, 1, true);
  advertiseFiles();
  subscribeOdometry();
  HeadImages::Options options;
  options.cameras = nodelet_.cameras;
  options.compressed = nodelet_.compressed;
  options.left_compressed = nodelet_.left_compressed;
  options.queue = nodelet_.queue_size;
  topics_.emplace(node, options, [this](std::size_t camera, RecordedImage image) {
    node_.push(CameraImage{camera, std::move(image)});
  });
}

void FabmapStage::choose(ImageSource source) {
  if (source == ImageSource::Head) return topics_->chooseHead();
  node_.logInfo("no panoramas: places are recognised in the images of the left camera");
  topics_->chooseLeft();
}

void FabmapStage::subscribeOdometry() {
  urban_nav_ros::TopicOptions options;
  options.timeout = kOdometryTimeout;
  options.queue = nodelet_.queue_size;
  options.is_paused = false;
  node_.subscribeInput<nav_msgs::Odometry>(
      urban_nav_ros::topics::kOdometry, options,
      [](const nav_msgs::OdometryConstPtr& message) -> std::optional<OdometryPose> {
        const auto T_odom_base = urban_nav_ros::toPose(message->pose.pose);
        if (!T_odom_base) return std::nullopt;
        return OdometryPose{{urban_nav_ros::toStampNs(message->header.stamp), *T_odom_base}, message->header.frame_id};
      });
  options.is_monitored = false;
  node_.subscribeInput<urban_nav_msgs::RelativePose>(urban_nav_ros::topics::kRelativePose, options,
                                                     [](const urban_nav_msgs::RelativePoseConstPtr& message) {
                                                       return urban_nav_ros::toOdometrySession(message->session);
                                                     });
  for (const char* verdicts : {urban_nav_ros::topics::kMetricClosure, urban_nav_ros::topics::kGraphVerdicts})
    node_.subscribeInput<urban_nav_msgs::MetricClosure>(
        verdicts, options, [](const auto& message) { return urban_nav_ros::toMetricClosure(*message); });
}

void FabmapStage::advertiseFiles() {
  using urban_nav_msgs::FileCommand;
  node_.advertiseService<FileCommand>("save", [this](const auto& request, auto& response) {
    response.message = node_.ask([this, path = request.path] { return places_->save(path); });
  });
  node_.advertiseService<FileCommand>("load", [this](const auto& request, auto& response) {
    response.message = node_.ask([this, path = request.path] { return places_->load(path); });
  });
}

void FabmapStage::loadMap() {
  if (!nodelet_.map.empty()) places_->load(nodelet_.map);
}

void FabmapStage::takeImages() {
  Images::Options options;
  options.cameras = nodelet_.cameras == 0 ? HeadImages::kHeadCameras : static_cast<std::size_t>(nodelet_.cameras);
  if (nodelet_.cameras == 0) options.head_patience = kHeadPatience;
  options.make_feed = [this, cameras = options.cameras] {
    PanoramaFeed::Options feed;
    feed.cameras = cameras;
    feed.max_lateness = static_cast<urban_nav_core::StampNs>(1e9 * nodelet_.max_lateness);
    feed.delivery = urban_nav_core::DeliveryOrder::OrderedStreams;
    return std::make_unique<PanoramaFeed>(feed);
  };
  images_ = std::make_unique<Images>(
      options, Images::Listener{[this](urban_nav_core::StampNs stamp, const auto& images) { process(stamp, images); },
                                [this](ImageSource source) { choose(source); }});
}

void FabmapStage::handle(Input& input) {
  if (const auto* pose = std::get_if<OdometryPose>(&input)) return addOdometry(*pose);
  if (const auto* session = std::get_if<urban_nav_core::OdometrySessionPtr>(&input)) return places_->follow(*session);
  if (const auto* closure = std::get_if<MetricClosure>(&input)) return publish(places_->addVerdict(*closure));
  const CameraImage& image = std::get<CameraImage>(input);
  images_->add(image.camera, image.image.stamp(), image.image);
}

void FabmapStage::addOdometry(const OdometryPose& pose) {
  places_->addOdometry(pose.T_odom_base);
  images_->addPose(pose.T_odom_base);
  trail_.addOdometry(pose.T_odom_base);
  odom_frame_ = pose.odom_frame;
}

void FabmapStage::process(urban_nav_core::StampNs stamp, const std::vector<RecordedImage>& images) {
  std::vector<cv::Mat> grey;
  std::vector<urban_nav_core::ImageView> views;
  for (const RecordedImage& image : images) {
    const urban_nav_ros::GreyImage decoded = image.empty() ? urban_nav_ros::GreyImage() : image.grey();
    if (!decoded.fault.empty()) node_.logWarning("image", decoded.fault);
    grey.push_back(decoded.pixels);
    views.push_back(urban_nav_ros::toView(grey.back()));
  }
  const PlaceOutput output = places_->process(stamp, views);
  trail_.add(output.belief);
  belief_.publish(toMessage(output.belief));
  for (const auto& closure : output.closures) closure_.publish(urban_nav_ros::toTopologicalClosureMessage(closure));
}

void FabmapStage::publish(const std::vector<PlaceBelief>& changed) {
  for (const PlaceBelief& belief : changed) {
    trail_.revise(belief);
    belief_.publish(toMessage(belief));
  }
}

/// Draws the trail if it has changed.
void FabmapStage::publishMarkers() {
  if (markers_.getNumSubscribers() == 0 || trail_.count() == drawn_ || trail_.points().empty()) return;
  markers_.publish(toMarkers(trail_, odom_frame_));
  drawn_ = trail_.count();
}

bool FabmapStage::idle() {
  places_->syncStore();
  node_.followStore(places_->storeState());
  publishMarkers();
  const urban_nav_live::StageReport report = this->report();
  node_.publishStatus(report.status, report.reason_name, urban_nav_ros::toStampNs(ros::Time::now()));
  return false;
}

urban_nav_live::StageReport FabmapStage::report() const {
  urban_nav_live::StageReport report = places_->report();
  const ImageSource source = images_->source();
  const bool is_waiting = nodelet_.cameras == 0 && source == ImageSource::Unknown;
  if (is_waiting && report.status.health == urban_nav_core::Health::Ok)
    report.summary = "idle: no images of a panoramic head or of the left camera have been received yet";
  const bool is_left = source == ImageSource::Left || nodelet_.cameras == 1;
  report.add("images", is_waiting ? "none yet" : is_left ? "left camera" : "panoramas");
  return report;
}

std::string FabmapStage::reset() {
  places_->reset();
  loadMap();
  images_->reset();
  trail_.clear();
  return std::string("all places ") + (nodelet_.map.empty() ? "" : "but those of the map ") +
         "were removed; the next panorama begins a new session";
}

class FabmapNodelet : public urban_nav_ros::StageNodelet<FabmapStage> {};

}  // namespace fabmap_node

PLUGINLIB_EXPORT_CLASS(fabmap_node::FabmapNodelet, nodelet::Nodelet)
