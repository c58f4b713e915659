// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <pluginlib/class_list_macros.hpp>

#include <boost/make_shared.hpp>
#include <opencv2/imgproc.hpp>

#include "camera_nodelet.hpp"
#include "segway_drivers/bumblebee2/camera.hpp"
#include "segway_drivers/bumblebee2/factory_calibration.hpp"
#include "urban_nav_core/io/calibration.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/topics.hpp"

namespace segway_drivers {

namespace topics = urban_nav_ros::topics;
namespace frames = urban_nav_core::frames;

namespace {

constexpr TimeNs kStereoStalled = 500'000'000;  // ns

}  // namespace

/// Stereo camera. With rectify: none it publishes `stereo/{left,right}/image_raw` as sent by the imagers, and
/// `camera_info` if given; with factory `image_rect`, grey, and `camera_info`.
class Bumblebee2Nodelet : public CameraNodelet {
 public:
  ~Bumblebee2Nodelet() override { shutDown(); }

 private:
  std::string device() const override { return "bumblebee2"; }
  std::string model() const override { return "Bumblebee2"; }
  FrameReader readBag(const std::string& bag) override { return readStereoFrames(bag); }
  SimCameraOptions::Model simulatedModel() const override { return SimCameraOptions::Model::Bumblebee2; }
  TimeNs stalledAfter() const override { return kStereoStalled; }
  bool start(std::string& error) override { return camera_->start(error); }
  const std::string& identity() const override { return camera_->identity(); }
  const DeviceCounters& counters() const override { return camera_->counters(); }
  std::vector<DriverEvent> takeEvents() override { return camera_->takeEvents(); }

  void prepare() override {
    const bool rectified = parameters().bumblebee2_rectify == "factory";
    if (rectified) loadCalibration();
    else loadInfos();
    ros::NodeHandle& handle = getNodeHandle();
    const auto queue = static_cast<std::uint32_t>(nodelet().image_queue);
    left_ = handle.advertise<sensor_msgs::Image>(rectified ? topics::kLeftRectified : topics::kLeftImage, queue);
    right_ = handle.advertise<sensor_msgs::Image>(rectified ? topics::kRightRectified : topics::kRightImage, queue);
    if (!left_info_) return;
    left_infos_ = handle.advertise<sensor_msgs::CameraInfo>(topics::kLeftInfo, queue);
    right_infos_ = handle.advertise<sensor_msgs::CameraInfo>(topics::kRightInfo, queue);
  }

  void makeCamera(FrameSource& source) override {
    Bb2Camera::Options options;
    options.latency = 1e-3 * parameters().bumblebee2_latency_ms;
    options.swap = parameters().bumblebee2_swap_images;
    camera_ = std::make_unique<Bb2Camera>(source, options);
  }

  void loadCalibration() {
    const std::string& file = parameters().bumblebee2_calibration;
    if (file.empty()) throw urban_nav_core::UserError("~calibration", "empty", "the file of the factory calibration");
    const FactoryCalibration calibration = parseFactoryCalibration(urban_nav_core::readTextFile(file), file);
    left_map_ = makeRectifyingMap(calibration.left, {kBb2Width, kBb2Height});
    right_map_ = makeRectifyingMap(calibration.right, {kBb2Width, kBb2Height});
    left_info_ = makeInfo(calibration, 0.0);
    right_info_ = makeInfo(calibration, calibration.baseline);
  }

  /// Loads the calibration published with raw images: from two files, or from the bag of a simulation.
  void loadInfos() {
    const std::string& files = parameters().bumblebee2_camera_info;
    const std::size_t comma = files.find(',');
    if (!files.empty()) {
      if (comma == std::string::npos) throw urban_nav_core::UserError("~camera_info", files, "LEFT.yaml,RIGHT.yaml");
      left_info_ = urban_nav_ros::toCameraInfoMessage(urban_nav_core::readCameraInfo(files.substr(0, comma)));
      right_info_ = urban_nav_ros::toCameraInfoMessage(urban_nav_core::readCameraInfo(files.substr(comma + 1)));
    } else if (isSimulated()) {
      if (const auto left = readStereoInfo(nodelet().port, "left"))
        left_info_ = urban_nav_ros::toCameraInfoMessage(*left);
      if (const auto right = readStereoInfo(nodelet().port, "right"))
        right_info_ = urban_nav_ros::toCameraInfoMessage(*right);
    }
    if (!right_info_) left_info_.reset();
  }

  void step(TimeNs wait) override {
    const auto pair = camera_->next(wait);
    if (!pair) return;
    const ros::Time stamp = toRos(pair->stamp);
    publishImage(pair->frame.left, left_map_, stamp, frames::kStereoLeft, left_);
    publishImage(pair->frame.right, right_map_, stamp, frames::kStereoRight, right_);
    publishTimeReference(frames::kStereoLeft, pair->arrival, *pair->frame.bus_time);
    countFrame(pair->stamp);
    if (!left_info_) return;
    left_info_->header.stamp = right_info_->header.stamp = stamp;
    left_info_->header.frame_id = frames::kStereoLeft;
    right_info_->header.frame_id = frames::kStereoRight;
    left_infos_.publish(*left_info_);
    right_infos_.publish(*right_info_);
  }

  void publishImage(const cv::Mat& raw, const RectifyingMap& map, const ros::Time& stamp, const std::string& frame,
                    const ros::Publisher& publisher) const {
    cv::Mat image = raw;
    if (!map.x.empty()) {
      cv::Mat grey = demosaic(raw, camera_->pattern());
      if (grey.channels() == 3) cv::cvtColor(grey, grey, cv::COLOR_BGR2GRAY);
      cv::remap(grey, image, map.x, map.y, cv::INTER_LINEAR);
    }
    auto message = boost::make_shared<sensor_msgs::Image>(urban_nav_ros::toImageMessage(image));
    if (map.x.empty()) message->encoding = mosaicEncoding(camera_->pattern());
    message->header.stamp = stamp;
    message->header.frame_id = frame;
    publisher.publish(message);
  }

  static sensor_msgs::CameraInfo makeInfo(const FactoryCalibration& calibration, double baseline) {
    sensor_msgs::CameraInfo info;
    info.width = kBb2Width;
    info.height = kBb2Height;
    info.distortion_model = "plumb_bob";
    info.D.assign(5, 0.0);
    const double fx = calibration.fx * kBb2Width, fy = calibration.fy * kBb2Height;
    const double cx = calibration.cx * kBb2Width, cy = calibration.cy * kBb2Height;
    info.K = {fx, 0, cx, 0, fy, cy, 0, 0, 1};
    info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    info.P = {fx, 0, cx, -fx * baseline, 0, fy, cy, 0, 0, 0, 1, 0};
    return info;
  }

  std::unique_ptr<Bb2Camera> camera_;
  std::optional<sensor_msgs::CameraInfo> left_info_, right_info_;
  RectifyingMap left_map_, right_map_;
  ros::Publisher left_, right_, left_infos_, right_infos_;
};

}  // namespace segway_drivers

PLUGINLIB_EXPORT_CLASS(segway_drivers::Bumblebee2Nodelet, nodelet::Nodelet)
