// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_input/session/grey_survey.hpp"

#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <optional>

namespace urban_nav_input {

namespace {

constexpr std::size_t kDepthSamples = 20;  // images at the beginning of each topic

}  // namespace

urban_nav_ros::GreyRange surveyGreyRange(Recording& recording, const std::vector<std::string>& topics) {
  urban_nav_ros::GreyRange range;
  for (const std::string& topic : topics) {
    RecordedMessages messages = recording.messages({topic});
    for (std::size_t seen = 0; seen < kDepthSamples; ++seen) {
      const std::optional<RecordedMessage> message = messages.next();
      if (!message) break;
      if (const auto image = message->as<sensor_msgs::Image>()) range.add(*image);
      else if (const auto packed = message->as<sensor_msgs::CompressedImage>()) range.add(*packed);
    }
  }
  range.settle();
  return range;
}

}  // namespace urban_nav_input
