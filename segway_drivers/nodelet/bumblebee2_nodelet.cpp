// SPDX-License-Identifier: BSD-3-Clause
#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <pluginlib/class_list_macros.hpp>

#include <atomic>
#include <boost/make_shared.hpp>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <thread>

#include "device_parameters.hpp"
#include "segway_drivers/bumblebee2/camera.hpp"
#include "segway_drivers/bumblebee2/factory_calibration.hpp"
#include "segway_drivers/transport/host_clock.hpp"
#include "urban_nav_core/io/text_file.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace segway_drivers {

namespace topics = urban_nav_ros::topics;

namespace {

constexpr TimeNs camera_wait = 100'000'000, camera_stalled = 1'000'000'000;  // ns
constexpr double reopen_pause = 1.0;                                         // s

const char* encodingOfMosaic(MosaicPattern pattern) {
  switch (pattern) {
    case MosaicPattern::None: return "mono8";
    case MosaicPattern::Rggb: return "bayer_rggb8";
    case MosaicPattern::Gbrg: return "bayer_gbrg8";
    case MosaicPattern::Grbg: return "bayer_grbg8";
    case MosaicPattern::Bggr: return "bayer_bggr8";
  }
  return "mono8";
}

}  // namespace

/// Stereo camera. With rectify: none `stereo/{left,right}/image_raw` as the imagers sent it; with factory `image_rect`,
/// grey, and `camera_info`.
class Bumblebee2Nodelet : public nodelet::Nodelet {
 public:
  ~Bumblebee2Nodelet() override {
    stop_ = true;
    timer_.stop();
    if (reader_.joinable()) reader_.join();
  }

 private:
  void onInit() override {
    try {
      std::tie(nodelet_, parameters_) = readDeviceParameters(getPrivateNodeHandle(), "bumblebee2");
      if (parameters_.bumblebee2_rectify == "factory") loadCalibration();
    } catch (const urban_nav_core::Error& error) {
      NODELET_FATAL("%s", error.what());
      throw;
    }
    ros::NodeHandle& handle = getNodeHandle();
    const bool rectified = calibration_.has_value();
    left_ = handle.advertise<sensor_msgs::Image>(rectified ? topics::left_rectified : topics::left_image, 10);
    right_ = handle.advertise<sensor_msgs::Image>(rectified ? topics::right_rectified : topics::right_image, 10);
    if (rectified) {
      left_info_ = handle.advertise<sensor_msgs::CameraInfo>(topics::left_info, 10);
      right_info_ = handle.advertise<sensor_msgs::CameraInfo>(topics::right_info, 10);
    }
    updater_ = std::make_unique<diagnostic_updater::Updater>(handle, getPrivateNodeHandle(), getName());
    updater_->setHardwareID("Bumblebee2 " + nodelet_.port);
    updater_->add("driver", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { fill(status); });
    timer_ = handle.createWallTimer(ros::WallDuration(1.0),
                                    [this](const ros::WallTimerEvent&) { updater_->force_update(); });
    reader_ = std::thread([this] { run(); });
  }

  void loadCalibration() {
    const std::string& file = parameters_.bumblebee2_calibration;
    if (file.empty()) throw urban_nav_core::UserError("~calibration", "empty", "the file of the factory calibration");
    calibration_ = parseFactoryCalibration(urban_nav_core::readTextFile(file), file);
    left_map_ = makeRectifyingMap(calibration_->left, {bb2_width, bb2_height});
    right_map_ = makeRectifyingMap(calibration_->right, {bb2_width, bb2_height});
  }

  void run() {
    std::string error;
    const std::unique_ptr<FrameSource> source = makeBusCamera(nodelet_.port, "Bumblebee2", error);
    if (!source) {
      NODELET_ERROR("%s", error.c_str());
      setState("absent", error);
      return;
    }
    Bb2Camera::Options options;
    options.latency = 1e-3 * parameters_.bumblebee2_latency_ms;
    options.swap = parameters_.bumblebee2_swap_images;
    Bb2Camera camera(*source, options);
    while (!stop_) {
      if (!camera.start(error)) {
        setState("absent", error);
        ros::WallDuration(reopen_pause).sleep();
        continue;
      }
      setState("streaming", camera.identity());
      TimeNs last = steadyTime();
      while (!stop_ && !source->isGone() && steadyTime() - last < camera_stalled) {
        if (const auto pair = camera.next(camera_wait)) {
          last = steadyTime();
          publish(*pair, camera.pattern());
        }
        clock_.follow();
        for (const DriverEvent& event : camera.takeEvents()) NODELET_WARN("%s", event.text.c_str());
        const std::lock_guard<std::mutex> guard(mutex_);
        counters_ = camera.counters();
      }
      setState("lost", "no image");
      source->stop();
      const std::lock_guard<std::mutex> guard(mutex_);
      ++reconnections_;
    }
  }

  void publish(const Bb2StampedPair& pair, MosaicPattern pattern) {
    const ros::Time stamp = urban_nav_ros::toRosTime(clock_.toReal(pair.stamp));
    publishImage(pair.frame.left, pattern, left_map_, stamp, urban_nav_core::frames::stereo_left, left_);
    publishImage(pair.frame.right, pattern, right_map_, stamp, urban_nav_core::frames::stereo_right, right_);
    if (!calibration_) return;
    left_info_.publish(makeInfo(stamp, urban_nav_core::frames::stereo_left, 0.0));
    right_info_.publish(makeInfo(stamp, urban_nav_core::frames::stereo_right, calibration_->baseline));
  }

  void publishImage(const cv::Mat& raw, MosaicPattern pattern, const RectifyingMap& map, const ros::Time& stamp,
                    const std::string& frame, const ros::Publisher& publisher) const {
    cv::Mat image = raw;
    if (!map.x.empty()) {
      cv::Mat grey = demosaic(raw, pattern);
      if (grey.channels() == 3) cv::cvtColor(grey, grey, cv::COLOR_BGR2GRAY);
      cv::remap(grey, image, map.x, map.y, cv::INTER_LINEAR);
    }
    auto message = boost::make_shared<sensor_msgs::Image>(urban_nav_ros::toImageMessage(image));
    if (map.x.empty()) message->encoding = encodingOfMosaic(pattern);
    message->header.stamp = stamp;
    message->header.frame_id = frame;
    publisher.publish(message);
  }

  sensor_msgs::CameraInfo makeInfo(const ros::Time& stamp, const std::string& frame, double baseline) const {
    sensor_msgs::CameraInfo info;
    info.header.stamp = stamp;
    info.header.frame_id = frame;
    info.width = bb2_width;
    info.height = bb2_height;
    info.distortion_model = "plumb_bob";
    info.D.assign(5, 0.0);
    const double fx = calibration_->fx * bb2_width, fy = calibration_->fy * bb2_height;
    const double cx = calibration_->cx * bb2_width, cy = calibration_->cy * bb2_height;
    info.K = {fx, 0, cx, 0, fy, cy, 0, 0, 1};
    info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    info.P = {fx, 0, cx, -fx * baseline, 0, fy, cy, 0, 0, 0, 1, 0};
    return info;
  }

  void setState(const std::string& state, const std::string& detail) {
    const std::lock_guard<std::mutex> guard(mutex_);
    if (state != state_) NODELET_INFO("%s: %s", state.c_str(), detail.c_str());
    state_ = state;
    detail_ = detail;
  }

  void fill(diagnostic_updater::DiagnosticStatusWrapper& status) {
    const std::lock_guard<std::mutex> guard(mutex_);
    status.summary(static_cast<unsigned char>(state_ == "streaming" ? 0 : 2), state_);
    status.add("detail", detail_);
    status.add("frames", counters_.frames);
    status.add("corrupt frames", counters_.bad_checksums);
    status.add("pairs lost", counters_.gaps);
    status.add("reconnections", reconnections_);
  }

  NodeletParameters nodelet_;
  Parameters parameters_;
  std::optional<FactoryCalibration> calibration_;
  RectifyingMap left_map_, right_map_;
  HostClock clock_;
  ros::Publisher left_, right_, left_info_, right_info_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  ros::WallTimer timer_;
  std::thread reader_;
  std::atomic<bool> stop_{false};

  std::mutex mutex_;  // guards what follows
  std::string state_ = "absent", detail_;
  DeviceCounters counters_;
  int reconnections_ = 0;
};

}  // namespace segway_drivers

PLUGINLIB_EXPORT_CLASS(segway_drivers::Bumblebee2Nodelet, nodelet::Nodelet)
