// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_calibration.hpp"

#include <algorithm>
#include <cmath>

#include "recording/bag_order.hpp"
#include "urban_nav_ros/image.hpp"
#include "urban_nav_ros/rectification_choice.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;
using urban_nav_ros::ImagePair;

namespace {

constexpr StampNs kReceiptPartner = 25'000'000;  // ns, between the times of receipt of a pair without stamps

/// Returns grey values in the depth of the image.
cv::Mat decodeGrey(const RecordedMessage& message) {
  if (const auto image = message.as<sensor_msgs::Image>()) return urban_nav_ros::toDeepGrey(*image).pixels.clone();
  if (const auto packed = message.as<sensor_msgs::CompressedImage>())
    return urban_nav_ros::toDeepGrey(*packed).pixels.clone();
  return {};
}

/// Converts all images to 8 bits by their common range.
void toEightBits(std::vector<ImagePair>& pairs) {
  urban_nav_ros::GreyRange range;
  for (const ImagePair& pair : pairs)
    for (const cv::Mat* image : {&pair.first, &pair.second}) range.add(*image);
  for (ImagePair& pair : pairs)
    for (cv::Mat* image : {&pair.first, &pair.second})
      if (image->depth() == CV_16U) *image = urban_nav_ros::toEightBits(*image, range.scale());
}

/// Messages of a topic in the order of receipt, accessed by stamp.
class StampedMessages {
 public:
  /// `by_receipt`: use times of receipt, since stamps are not set.
  StampedMessages(Recording& recording, const std::string& topic, const ReceiptRange& part, bool by_receipt)
      : by_receipt_(by_receipt) {
    MessageSelection messages = recording.select(std::vector<std::string>{topic}, part);
    messages_.reserve(messages.size());
    while (const std::optional<RecordedMessage> message = messages.next()) messages_.push_back(*message);
  }

  std::size_t size() const { return messages_.size(); }
  const RecordedMessage& operator[](std::size_t i) const { return messages_[i]; }
  StampNs stamp(std::size_t i) const { return by_receipt_ ? messages_[i].receipt() : readHeaderStamp(messages_[i]); }

  /// Returns the message whose stamp is nearest to `stamp`, if within the tolerance of a pair: by bisection, since
  /// stamps mostly ascend, then among the neighbours.
  const RecordedMessage* find(StampNs stamp, StampNs tolerance) const {
    constexpr std::size_t kNeighbours = 8;
    std::size_t low = 0, high = messages_.size();
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (this->stamp(middle) < stamp) low = middle + 1;
      else high = middle;
    }
    const RecordedMessage* found = nullptr;
    StampNs least = by_receipt_ ? std::max(kReceiptPartner, tolerance) : tolerance;
    for (std::size_t i = low > kNeighbours ? low - kNeighbours : 0; i < std::min(size(), low + kNeighbours); ++i) {
      const StampNs apart = std::abs(this->stamp(i) - stamp);
      if (apart > least) continue;
      found = &messages_[i];
      least = apart;
    }
    return found;
  }

 private:
  bool by_receipt_;
  std::vector<RecordedMessage> messages_;
};

/// Returns the indices of about `count` of `size` images, one from each part of the recording at irregular intervals,
/// to avoid aliasing with periodic changes.
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

/// Returns at most `count` decoded pairs of a recording; fewer if partners are not found by their stamps.
std::vector<ImagePair> samplePairs(Recording& recording, const StereoTopics& topics, const ReceiptRange& part,
                                   int count) {
  const StampSurvey survey = surveyStamps(recording, {topics.left, topics.right}, part);
  const bool by_receipt = survey.unset || survey.constant;
  const StampedMessages left(recording, topics.left, part, by_receipt),
      right(recording, topics.right, part, by_receipt);
  std::vector<ImagePair> pairs;
  for (const std::size_t i : drawIndices(left.size(), count)) {
    const RecordedMessage* partner = right.find(left.stamp(i) + topics.pairing.right_delay, topics.pairing.tolerance);
    if (partner == nullptr) continue;
    ImagePair pair{decodeGrey(left[i]), decodeGrey(*partner)};
    if (!pair.first.empty() && pair.second.size() == pair.first.size()) pairs.push_back(std::move(pair));
  }
  toEightBits(pairs);
  return pairs;
}

}  // namespace

urban_nav_ros::StereoCalibration makeCalibration(Recording& recording, const StereoTopics& topics,
                                                 const ReceiptRange& part, bool named_as_rectified,
                                                 const StereoInfos& infos, std::vector<std::string>& notes) {
  using urban_nav_ros::StereoCalibration;
  const StereoCalibration as_named(infos.left, infos.right, named_as_rectified, infos.where);
  const StereoCalibration rectifying(infos.left, infos.right, false, infos.where);
  if (!rectifying.rectifies()) return as_named;
  const urban_nav_ros::RectificationChoice choice =
      urban_nav_ros::chooseRectification(samplePairs(recording, topics, part, urban_nav_ros::kJudgedPairs), rectifying);
  if (std::string note = choice.contradiction(named_as_rectified); !note.empty()) notes.push_back(std::move(note));
  return {infos.left, infos.right, choice.isRectified(named_as_rectified), infos.where};
}

void noteDistortionModel(const urban_nav_core::CameraInfo& info, std::vector<std::string>& notes) {
  if (!info.distortion_model.empty() || !urban_nav_core::needsRectification(info)) return;
  notes.push_back("distortion_model is empty: coefficients are read as those of " +
                  std::string(info.D.size() > 5 ? "rational_polynomial" : "plumb_bob"));
}

}  // namespace urban_nav_input
