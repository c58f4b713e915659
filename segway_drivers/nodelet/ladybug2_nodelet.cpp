// SPDX-License-Identifier: BSD-3-Clause
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <urban_nav_msgs/RawFrame.h>
#include <pluginlib/class_list_macros.hpp>

#include <array>
#include <atomic>
#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>

#include "camera_nodelet.hpp"
#include "segway_drivers/ladybug2/camera.hpp"
#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/topics.hpp"

namespace segway_drivers {

namespace {

constexpr TimeNs kPanoramaStalled = 2'500'000'000;  // ns, five periods at 2 Hz
constexpr int kColourQuality = 90;
constexpr std::size_t kRingCameras = 5;

}  // namespace

/// Panoramic camera: publishes `ladybug/raw` as received; `ladybug/camera{0..4}/image_raw` and `image_raw/compressed`,
/// upright at half resolution, only for cameras with a subscriber.
class Ladybug2Nodelet : public CameraNodelet {
 public:
  ~Ladybug2Nodelet() override { shutDown(); }

 private:
  std::string device() const override { return "ladybug2"; }
  std::string model() const override { return "Compressor"; }
  FrameReader readBag(const std::string& bag) override { return readLadybugFrames(bag); }
  SimCameraOptions::Model simulatedModel() const override { return SimCameraOptions::Model::Ladybug2; }
  TimeNs stalledAfter() const override { return kPanoramaStalled; }
  bool start(std::string& error) override { return camera_->start(error); }
  const std::string& identity() const override { return camera_->identity(); }
  const DeviceCounters& counters() const override { return camera_->counters(); }
  std::vector<DriverEvent> takeEvents() override { return camera_->takeEvents(); }

  void prepare() override {
    ros::NodeHandle& handle = getNodeHandle();
    raw_ = handle.advertise<urban_nav_msgs::RawFrame>(urban_nav_ros::topics::kPanoramaRaw,
                                                      static_cast<std::uint32_t>(nodelet().image_queue));
    for (std::size_t i = 0; i < kRingCameras; ++i) {
      const std::string topic = urban_nav_ros::topics::kPanoramaImages[i];
      images_[i] = handle.advertise<sensor_msgs::Image>(topic, 5);
      compressed_[i] = handle.advertise<sensor_msgs::CompressedImage>(topic + "/compressed", 5);
    }
  }

  void makeCamera(FrameSource& source) override {
    LadybugCamera::Options options;
    options.latency = 1e-3 * parameters().ladybug2_latency_ms;
    options.rate = parameters().ladybug2_rate;
    options.quality = parameters().ladybug2_quality;
    camera_ = std::make_unique<LadybugCamera>(source, options);
  }

  void step(TimeNs wait) override {
    auto frame = camera_->next(wait);
    bad_channels_ = camera_->badChannels();
    if (!frame) return;
    const ros::Time stamp = toRos(frame->stamp);
    publishTimeReference(urban_nav_core::frames::ladybugCamera(0), frame->arrival, frame->bus_time);
    publishColour(frame->bytes, stamp);
    auto message = boost::make_shared<urban_nav_msgs::RawFrame>();
    message->header.stamp = stamp;
    message->header.frame_id = urban_nav_core::frames::ladybugCamera(0);
    message->format = "ladybug2";
    message->sequence = frame->sequence;
    message->bus_time = frame->bus_time;
    message->data = std::move(frame->bytes);
    raw_.publish(message);
    countFrame(frame->stamp);
  }

  void publishColour(const Bytes& bytes, const ros::Time& stamp) const {
    std::optional<LadybugFrame> frame;
    for (std::size_t i = 0; i < kRingCameras; ++i) {
      const bool plain = images_[i].getNumSubscribers() > 0, compressed = compressed_[i].getNumSubscribers() > 0;
      if (!plain && !compressed) continue;
      if (!frame) frame = splitLadybugFrame(bytes, parameters().ladybug2_camera_order == "backward");
      if (!frame) return;
      const MosaicPattern pattern =
          parseMosaicPattern(parameters().ladybug2_pattern).value_or(frame->pattern.value_or(MosaicPattern::Bggr));
      const cv::Mat image = decodeLadybugCamera(*frame, i, pattern);
      if (image.empty()) continue;
      std_msgs::Header header;
      header.stamp = stamp;
      header.frame_id = urban_nav_core::frames::ladybugCamera(static_cast<int>(i));
      if (plain) {
        auto message = boost::make_shared<sensor_msgs::Image>(urban_nav_ros::toColourImageMessage(image));
        message->header = header;
        images_[i].publish(message);
      }
      if (!compressed) continue;
      auto message = boost::make_shared<sensor_msgs::CompressedImage>();
      message->header = header;
      message->format = "bgr8; jpeg compressed bgr8";
      cv::imencode(".jpg", image, message->data, {cv::IMWRITE_JPEG_QUALITY, kColourQuality});
      compressed_[i].publish(message);
    }
  }

  void addDiagnostics(diagnostic_updater::DiagnosticStatusWrapper& status) override {
    status.add("bad channels", bad_channels_.load());
  }

  std::unique_ptr<LadybugCamera> camera_;
  std::atomic<std::int64_t> bad_channels_{0};
  ros::Publisher raw_;
  std::array<ros::Publisher, kRingCameras> images_, compressed_;
};

}  // namespace segway_drivers

PLUGINLIB_EXPORT_CLASS(segway_drivers::Ladybug2Nodelet, nodelet::Nodelet)
