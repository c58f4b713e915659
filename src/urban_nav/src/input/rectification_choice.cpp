// SPDX-License-Identifier: BSD-3-Clause
#include "input/rectification_choice.hpp"

#include <rosbag/view.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "input/bag_order.hpp"
#include "input/image_features.hpp"
#include "urban_nav_core/io/numbers.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav {

using urban_nav_core::ImageView;
using urban_nav_core::StampNs;

namespace {

constexpr StampNs kPartner = 5'000'000;          // ns, between the stamps of a pair
constexpr StampNs kNearReceipt = 1'000'000'000;  // ns, in which the partner is looked for
constexpr std::size_t kLeastPairs = 3, kLeastRowMatches = 100;
constexpr double kFarRow = 20.0;                            // px: chance matches
constexpr double kClearlyWorse = 2.0, kVisiblyWorse = 0.5;  // times and px between the row errors

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

ImageView viewOf(const cv::Mat& image) { return {image.data, image.cols, image.rows, static_cast<int>(image.step)}; }

/// Appends the row errors of matching points, right minus left, px.
void appendRowErrors(const ImageView& left, const ImageView& right, std::vector<double>& errors) {
  const ImageFeatures on_left = extractFeatures(left), on_right = extractFeatures(right);
  for (const cv::DMatch& match : matchFeatures(on_left, on_right)) {
    const double dv = static_cast<double>(on_right.points[static_cast<std::size_t>(match.trainIdx)].pt.y) -
                      static_cast<double>(on_left.points[static_cast<std::size_t>(match.queryIdx)].pt.y);
    if (std::abs(dv) < kFarRow) errors.push_back(std::abs(dv));
  }
}

double medianError(std::vector<double>& errors) {
  const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
  std::nth_element(errors.begin(), middle, errors.end());
  return *middle;
}

}  // namespace

std::vector<ImagePair> samplePairs(std::list<rosbag::Bag>& bags, const StereoTopics& topics, const ReceiptRange& part,
                                   int count) {
  rosbag::View left;
  for (rosbag::Bag& bag : bags) addToView(left, bag, {topics.left}, part);
  const std::size_t step = std::max<std::size_t>(1, left.size() / static_cast<std::size_t>(count));
  std::vector<ImagePair> pairs;
  std::size_t i = 0;
  for (const rosbag::MessageInstance& message : left) {
    if (i++ % step != step / 2 || pairs.size() >= static_cast<std::size_t>(count)) continue;
    ImagePair pair{decodeGrey(message), findPartner(bags, topics.right, readHeaderStamp(message) + topics.right_delay,
                                                    urban_nav_ros::toStampNs(message.getTime()))};
    if (!pair.first.empty() && pair.second.size() == pair.first.size()) pairs.push_back(std::move(pair));
  }
  return pairs;
}

RectificationChoice chooseRectification(const std::vector<ImagePair>& pairs,
                                        const urban_nav_ros::StereoCalibration& rectifying) {
  using urban_nav_ros::Side;
  RectificationChoice choice;
  std::vector<double> as_they_are, rectified;
  std::vector<std::uint8_t> left_pixels, right_pixels;
  for (const auto& [left, right] : pairs) {
    appendRowErrors(viewOf(left), viewOf(right), as_they_are);
    const ImageView left_view = rectifying.rectify(Side::Left, viewOf(left), left_pixels);
    const ImageView right_view = rectifying.rectify(Side::Right, viewOf(right), right_pixels);
    if (left_view.empty() || right_view.empty()) return choice;  // of another size than the calibration
    appendRowErrors(left_view, right_view, rectified);
  }
  if (pairs.size() < kLeastPairs || std::min(as_they_are.size(), rectified.size()) < kLeastRowMatches) return choice;
  choice.as_they_are_px = medianError(as_they_are);
  choice.rectified_px = medianError(rectified);
  const double better = std::min(choice.as_they_are_px, choice.rectified_px);
  const double worse = std::max(choice.as_they_are_px, choice.rectified_px);
  choice.is_decided = worse > kClearlyWorse * better && worse > better + kVisiblyWorse;
  choice.is_rectified = choice.as_they_are_px < choice.rectified_px;
  return choice;
}

urban_nav_ros::StereoCalibration makeCalibration(std::list<rosbag::Bag>& bags, const StereoTopics& topics,
                                                 const ReceiptRange& part, bool named_as_rectified,
                                                 const StereoInfos& infos, std::vector<std::string>& notes) {
  constexpr int kJudgedPairs = 5;
  using urban_nav_ros::StereoCalibration;
  const StereoCalibration as_named(infos.left, infos.right, named_as_rectified, infos.where);
  const StereoCalibration rectifying(infos.left, infos.right, false, infos.where);
  if (!rectifying.rectifies()) return as_named;
  const RectificationChoice choice = chooseRectification(samplePairs(bags, topics, part, kJudgedPairs), rectifying);
  if (!choice.is_decided || choice.is_rectified == named_as_rectified) return as_named;
  const auto px = [](double value) { return urban_nav_core::printNumber(std::round(100.0 * value) / 100.0) + " px"; };
  notes.push_back(std::string(choice.is_rectified
                                  ? "images are rectified already, although their calibration has a distortion"
                                  : "images are raw, although their topic is named as rectified") +
                  ": rows differ by " + px(choice.as_they_are_px) + " as they are, by " + px(choice.rectified_px) +
                  " once rectified");
  return {infos.left, infos.right, choice.is_rectified, infos.where};
}

}  // namespace urban_nav
