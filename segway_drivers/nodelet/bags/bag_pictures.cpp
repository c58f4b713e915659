// SPDX-License-Identifier: BSD-3-Clause
#include "segway_drivers/camera/bag_pictures.hpp"

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <map>
#include <memory>
#include <opencv2/imgcodecs.hpp>

#include "segway_drivers/bumblebee2/frame.hpp"
#include "segway_drivers/camera/pack_frames.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_input/recording/recording.hpp"
#include "urban_nav_ros/camera_info.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"
#include "urban_nav_ros/topics.hpp"

namespace segway_drivers {

using urban_nav_input::RecordedMessage;
using urban_nav_input::RecordedMessages;
using urban_nav_input::Recording;

namespace {

constexpr int kSimulatedQuality = 90;

std::string withoutSlash(const std::string& topic) { return topic.rfind('/', 0) == 0 ? topic.substr(1) : topic; }

cv::Mat decodeColour(const RecordedMessage& message) {
  if (const auto compressed = message.as<sensor_msgs::CompressedImage>())
    return urban_nav_ros::toColour(*compressed).pixels;
  const auto image = message.as<sensor_msgs::Image>();
  if (!image || image->encoding != "bgr8" || image->step < 3UL * image->width ||
      image->data.size() < std::size_t{image->step} * image->height)
    return {};
  const cv::Mat view(static_cast<int>(image->height), static_cast<int>(image->width), CV_8UC3,
                     const_cast<std::uint8_t*>(image->data.data()), image->step);
  return view.clone();
}

cv::Mat decodeGrey(const RecordedMessage& message) {
  if (const auto image = message.as<sensor_msgs::Image>()) return urban_nav_ros::toGrey(*image).pixels.clone();
  if (const auto compressed = message.as<sensor_msgs::CompressedImage>())
    return urban_nav_ros::toGrey(*compressed).pixels;
  return {};
}

ros::Time readImageStamp(const RecordedMessage& message) {
  if (const auto image = message.as<sensor_msgs::Image>()) return image->header.stamp;
  if (const auto compressed = message.as<sensor_msgs::CompressedImage>()) return compressed->header.stamp;
  return urban_nav_ros::toRosTime(message.receipt());
}

std::vector<std::string> withAndWithoutSlash(const std::map<std::string, std::size_t>& topics) {
  std::vector<std::string> names;
  for (const auto& [topic, place] : topics) {
    names.push_back(topic);
    names.push_back("/" + topic);
  }
  return names;
}

/// Groups images of one stamp, one of each topic.
class BagGroups {
 public:
  BagGroups(const std::string& path, std::map<std::string, std::size_t> topics, std::size_t size)
      : topics_(std::move(topics)),
        size_(size),
        recording_(path),
        messages_(recording_.messages(withAndWithoutSlash(topics_))),
        begin_(urban_nav_ros::toRosTime(recording_.begin())) {
    if (messages_.size() == 0)
      throw urban_nav_core::UserError(path, "no images", "a bag with the images of this camera");
  }

  /// Returns the next complete group and sets the times of `frame`. Empty at the end.
  std::optional<std::vector<cv::Mat>> next(const std::function<cv::Mat(const RecordedMessage&)>& decode,
                                           SimFrame& frame) {
    while (const std::optional<RecordedMessage> message = messages_.next()) {
      const ros::Time stamp = readImageStamp(*message);
      std::vector<cv::Mat>& group = waiting_[stamp];
      group.resize(size_);
      group[topics_.at(withoutSlash(message->topic()))] = decode(*message);
      if (std::any_of(group.begin(), group.end(), [](const cv::Mat& each) { return each.empty(); })) continue;
      frame.time = std::max((stamp - begin_).toSec(), 0.0);
      frame.recorded = static_cast<TimeNs>(stamp.toNSec());
      std::vector<cv::Mat> complete = std::move(group);
      waiting_.erase(waiting_.begin(), waiting_.upper_bound(stamp));
      return complete;
    }
    return std::nullopt;
  }

 private:
  std::map<std::string, std::size_t> topics_;  // position in the group
  std::size_t size_;
  Recording recording_;
  RecordedMessages messages_;
  ros::Time begin_;
  std::map<ros::Time, std::vector<cv::Mat>> waiting_;
};

}  // namespace

FrameReader readStereoFrames(const std::string& bag) {
  std::map<std::string, std::size_t> topics;
  for (const std::string transport : {"", "/compressed"}) {
    for (const char* left : {urban_nav_ros::topics::kLeftImage, urban_nav_ros::topics::kLeftRectified})
      topics[left + transport] = 0;
    for (const char* right : {urban_nav_ros::topics::kRightImage, urban_nav_ros::topics::kRightRectified})
      topics[right + transport] = 1;
  }
  const auto groups = std::make_shared<BagGroups>(bag, topics, 2);
  return [groups]() -> std::optional<SimFrame> {
    SimFrame frame;
    const auto pair = groups->next(decodeGrey, frame);
    if (!pair) return std::nullopt;
    frame.bytes = packBb2Frame((*pair)[0], (*pair)[1]);
    return frame;
  };
}

FrameReader readLadybugFrames(const std::string& bag) {
  std::map<std::string, std::size_t> topics;
  for (std::size_t camera = 0; camera < 5; ++camera) {
    const std::string topic = urban_nav_ros::topics::kPanoramaImages[camera];
    topics[topic] = topics[topic + "/compressed"] = camera;
  }
  const auto groups = std::make_shared<BagGroups>(bag, topics, 5);
  return [groups]() -> std::optional<SimFrame> {
    SimFrame frame;
    const auto images = groups->next(decodeColour, frame);
    if (!images) return std::nullopt;
    std::array<cv::Mat, 5> cameras;
    std::copy(images->begin(), images->end(), cameras.begin());
    frame.bytes = packLadybugFrame(cameras, kSimulatedQuality);
    return frame;
  };
}

std::optional<urban_nav_core::CameraInfo> readStereoInfo(const std::string& path, const std::string& side) {
  if (!urban_nav_input::isRecording(path)) return std::nullopt;  // a camera
  const std::string topic = side == "left" ? urban_nav_ros::topics::kLeftInfo : urban_nav_ros::topics::kRightInfo;
  Recording recording(path);
  RecordedMessages messages = recording.messages({topic, urban_nav_ros::topics::fromRoot(topic)});
  while (const std::optional<RecordedMessage> each = messages.next()) {
    const auto message = each->as<sensor_msgs::CameraInfo>();
    if (!message || message->width == 0 || message->height == 0) continue;
    sensor_msgs::CameraInfo info = *message;
    const double sx = static_cast<double>(kBb2Width) / info.width, sy = static_cast<double>(kBb2Height) / info.height;
    info.width = kBb2Width;
    info.height = kBb2Height;
    for (const auto& [matrix, columns] : {std::pair{info.K.data(), 3}, std::pair{info.P.data(), 4}}) {
      matrix[0] *= sx;
      matrix[2] = (matrix[2] + 0.5) * sx - 0.5;
      matrix[columns + 1] *= sy;
      matrix[columns + 2] = (matrix[columns + 2] + 0.5) * sy - 0.5;
      if (columns == 4) matrix[3] *= sx;
    }
    return urban_nav_ros::toCameraInfo(info);
  }
  return std::nullopt;
}

}  // namespace segway_drivers
