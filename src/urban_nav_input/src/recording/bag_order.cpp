// SPDX-License-Identifier: BSD-3-Clause
#include "recording/bag_order.hpp"

#include <ros/serialization.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kSamples = 400;          // of a bag
constexpr StampNs kUsualDelays = 150'000'000;  // ns: within the 200 ms that the reader waits for late images
constexpr StampNs kStep = 1'000'000'000;       // ns: back by more than that, a clock was set

struct Sample {
  std::string topic;
  StampNs stamp = 0, receipt = 0;
};

std::vector<Sample> drawSamples(std::list<rosbag::Bag>& bags, const std::vector<std::string>& topics,
                                const ReceiptRange& range) {
  std::vector<Sample> samples;
  for (rosbag::Bag& bag : bags) {
    rosbag::View view;
    addToView(view, bag, topics, range);
    const std::size_t every = std::max<std::size_t>(1, view.size() / kSamples);
    std::size_t i = 0;
    for (const rosbag::MessageInstance& message : view)
      if (i++ % every == 0)
        samples.push_back({message.getTopic(), readHeaderStamp(message), urban_nav_ros::toStampNs(message.getTime())});
  }
  return samples;
}

/// Whether each topic has several samples, of one stamp.
bool areConstant(const std::vector<Sample>& samples) {
  std::map<std::string, std::pair<StampNs, std::size_t>> topics;
  for (const Sample& sample : samples) {
    auto& [stamp, count] = topics.emplace(sample.topic, std::make_pair(sample.stamp, std::size_t{0})).first->second;
    if (stamp != sample.stamp) return false;
    ++count;
  }
  return std::all_of(topics.begin(), topics.end(), [](const auto& topic) { return topic.second.second > 1; });
}

}  // namespace

StampNs readHeaderStamp(const rosbag::MessageInstance& message) {
  constexpr std::size_t kSecondsAt = 4, kNanosecondsAt = 8, kEnd = 12;  // after seq, little-endian
  const std::uint32_t size = message.size();
  if (size < kEnd) return 0;
  std::vector<std::uint8_t> bytes(size);
  ros::serialization::OStream stream(bytes.data(), size);
  message.write(stream);
  std::uint32_t seconds = 0, nanoseconds = 0;
  std::memcpy(&seconds, &bytes[kSecondsAt], sizeof(seconds));
  std::memcpy(&nanoseconds, &bytes[kNanosecondsAt], sizeof(nanoseconds));
  return static_cast<StampNs>(seconds) * 1'000'000'000 + nanoseconds;
}

std::pair<StampNs, StampNs> findStampSpan(rosbag::View& view) {
  constexpr std::size_t kEnds = 20;  // messages at either end, of several topics
  std::pair<StampNs, StampNs> span(std::numeric_limits<StampNs>::max(), 0);
  std::size_t i = 0;
  for (const rosbag::MessageInstance& message : view) {
    const bool is_at_end = i < kEnds || i + kEnds >= view.size();
    ++i;
    if (!is_at_end) continue;
    const StampNs stamp = readHeaderStamp(message);
    span = {std::min(span.first, stamp), std::max(span.second, stamp)};
  }
  return span;
}

StampSurvey surveyStamps(std::list<rosbag::Bag>& bags, const std::vector<std::string>& topics,
                         const ReceiptRange& range) {
  StampSurvey survey;
  const std::vector<Sample> samples = drawSamples(bags, topics, range);
  if (samples.empty()) return survey;
  survey.unset = std::all_of(samples.begin(), samples.end(), [](const Sample& sample) { return sample.stamp == 0; });
  if (survey.unset) return survey;
  survey.constant = areConstant(samples);
  if (survey.constant) return survey;
  std::map<std::string, StampNs> latest;
  std::vector<StampNs> delays;
  for (const Sample& sample : samples) {
    delays.push_back(sample.receipt - sample.stamp);
    const auto [before, is_first] = latest.emplace(sample.topic, sample.stamp);
    if (is_first) continue;
    survey.back = std::max(survey.back, before->second - sample.stamp);
    before->second = std::max(before->second, sample.stamp);
  }
  const auto middle = delays.begin() + static_cast<std::ptrdiff_t>(delays.size() / 2);
  std::nth_element(delays.begin(), middle, delays.end());
  const StampNs usual = *middle;
  const bool strays = std::any_of(delays.begin(), delays.end(), [usual](StampNs delay) {
    return delay > usual + kUsualDelays || delay < usual - kUsualDelays;
  });
  survey.needs_sorting = strays && survey.back < kStep;
  return survey;
}

BagMessages::BagMessages(const std::vector<rosbag::Bag*>& bags, const std::vector<std::string>& topics, bool is_sorted,
                         const ReceiptRange& range)
    : is_sorted_(is_sorted) {
  for (rosbag::Bag* bag : bags) addToView(view_, *bag, topics, range);
  position_ = view_.begin();
  if (!is_sorted_) return;
  all_.reserve(view_.size());
  for (const rosbag::MessageInstance& message : view_) {
    order_.emplace_back(readHeaderStamp(message), all_.size());
    all_.push_back(message);
  }
  std::sort(order_.begin(), order_.end());
}

const rosbag::MessageInstance* BagMessages::next() {
  if (is_sorted_) return next_ < order_.size() ? &all_[order_[next_++].second] : nullptr;
  if (position_ == view_.end()) return nullptr;
  message_.emplace(*position_);
  ++position_;
  return &*message_;
}

}  // namespace urban_nav_input
