// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_calibration.hpp"

#include <rosbag/view.h>

#include <algorithm>
#include <cmath>

#include "recording/bag_order.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/rectification_choice.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;
using urban_nav_ros::ImagePair;

namespace {

constexpr StampNs kPartner = 5'000'000;          // ns, between the stamps of a pair
constexpr StampNs kNearReceipt = 1'000'000'000;  // ns, in which the partner is looked for

cv::Mat decodeGrey(const rosbag::MessageInstance& message) {
  if (const auto image = message.instantiate<sensor_msgs::Image>()) return urban_nav_ros::toGrey(*image).pixels.clone();
  if (const auto packed = message.instantiate<sensor_msgs::CompressedImage>())
    return urban_nav_ros::toGrey(*packed).pixels.clone();
  return {};
}

/// Returns the right image that belongs to a stamp, received at about the same time.
cv::Mat findPartner(std::list<rosbag::Bag>& bags, const std::string& topic, StampNs stamp, StampNs receipt) {
  for (rosbag::Bag& bag : bags) {
    rosbag::View view;
    addToView(view, bag, {topic}, {std::max<StampNs>(receipt - kNearReceipt, 1), receipt + kNearReceipt});
    for (const rosbag::MessageInstance& message : view)
      if (std::abs(readHeaderStamp(message) - stamp) <= kPartner) return decodeGrey(message);
  }
  return {};
}

/// Returns the indices of about `count` of `size` images, one from each part of the recording but at no fixed interval,
/// so that nothing periodic is met at one phase.
std::vector<std::size_t> drawIndices(std::size_t size, int count) {
  constexpr double kGoldenRatio = 0.6180339887498949;
  std::vector<std::size_t> indices;
  for (int i = 0; i < count; ++i) {
    const double in_part = std::fmod(0.5 + kGoldenRatio * i, 1.0);
    const auto index = static_cast<std::size_t>((i + in_part) * static_cast<double>(size) / count);
    if (index < size && (indices.empty() || index > indices.back())) indices.push_back(index);
  }
  return indices;
}

/// Returns at most `count` decoded pairs of a recording; fewer where partners are not found by their stamps.
std::vector<ImagePair> samplePairs(std::list<rosbag::Bag>& bags, const StereoTopics& topics, const ReceiptRange& part,
                                   int count) {
  rosbag::View left;
  for (rosbag::Bag& bag : bags) addToView(left, bag, {topics.left}, part);
  const std::vector<std::size_t> indices = drawIndices(left.size(), count);
  std::vector<ImagePair> pairs;
  std::size_t i = 0;
  for (const rosbag::MessageInstance& message : left) {
    if (!std::binary_search(indices.begin(), indices.end(), i++)) continue;
    const StampNs stamp = readHeaderStamp(message) + topics.right_delay;
    ImagePair pair{decodeGrey(message),
                   findPartner(bags, topics.right, stamp, urban_nav_ros::toStampNs(message.getTime()))};
    if (!pair.first.empty() && pair.second.size() == pair.first.size()) pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace

urban_nav_ros::StereoCalibration makeCalibration(std::list<rosbag::Bag>& bags, const StereoTopics& topics,
                                                 const ReceiptRange& part, bool named_as_rectified,
                                                 const StereoInfos& infos, std::vector<std::string>& notes) {
  using urban_nav_ros::StereoCalibration;
  const StereoCalibration as_named(infos.left, infos.right, named_as_rectified, infos.where);
  const StereoCalibration rectifying(infos.left, infos.right, false, infos.where);
  if (!rectifying.rectifies()) return as_named;
  const urban_nav_ros::RectificationChoice choice =
      urban_nav_ros::chooseRectification(samplePairs(bags, topics, part, urban_nav_ros::kJudgedPairs), rectifying);
  if (std::string note = choice.contradiction(named_as_rectified); !note.empty()) notes.push_back(std::move(note));
  return {infos.left, infos.right, choice.isRectified(named_as_rectified), infos.where};
}

}  // namespace urban_nav_input
