// SPDX-License-Identifier: BSD-3-Clause
#include "recording/bag_order.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <utility>

namespace urban_nav_input {

using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kSamples = 400;          // of a bag
constexpr StampNs kUsualDelays = 150'000'000;  // ns, within the 200 ms for which the reader waits for late images
constexpr StampNs kStep = 1'000'000'000;       // ns: a larger step back means that a clock was set

struct Sample {
  std::string topic;
  StampNs stamp = 0, receipt = 0;
};

std::vector<Sample> drawSamples(Recording& recording, const std::vector<std::string>& topics,
                                const ReceiptRange& range) {
  std::vector<Sample> samples;
  for (RecordingFile* file : recording.files()) {
    MessageSelection selection({file}, topics, range);
    const std::size_t every = std::max<std::size_t>(1, selection.size() / kSamples);
    std::size_t i = 0;
    while (const std::optional<RecordedMessage> message = selection.next())
      if (i++ % every == 0) samples.push_back({message->topic(), readHeaderStamp(*message), message->receipt()});
  }
  return samples;
}

/// Returns whether each topic has several samples, all with the same stamp.
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

StampNs readHeaderStamp(const RecordedMessage& message) {
  // After seq (ROS 1) or the encapsulation (CDR), which are of the same size.
  constexpr std::size_t kSecondsAt = 4, kNanosecondsAt = 8, kEnd = 12;
  const ByteView bytes = message.bytes();
  if (bytes.size < kEnd) return 0;
  const bool is_big_endian = message.connection().encoding == "cdr" && bytes.data[1] == 0;
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < sizeof(value); ++i)
      value |= static_cast<std::uint32_t>(bytes.data[at + i]) << 8U * (is_big_endian ? sizeof(value) - 1 - i : i);
    return value;
  };
  return static_cast<StampNs>(number(kSecondsAt)) * 1'000'000'000 + number(kNanosecondsAt);
}

std::pair<StampNs, StampNs> findStampSpan(MessageSelection& messages) {
  constexpr std::size_t kEnds = 20;  // messages at each end, of several topics
  std::pair<StampNs, StampNs> span(std::numeric_limits<StampNs>::max(), 0);
  for (std::size_t i = 0; const std::optional<RecordedMessage> message = messages.next(); ++i) {
    if (i >= kEnds && i + kEnds < messages.size()) continue;
    const StampNs stamp = readHeaderStamp(*message);
    span = {std::min(span.first, stamp), std::max(span.second, stamp)};
  }
  return span;
}

StampSurvey surveyStamps(Recording& recording, const std::vector<std::string>& topics, const ReceiptRange& range) {
  StampSurvey survey;
  const std::vector<Sample> samples = drawSamples(recording, topics, range);
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

BagMessages::BagMessages(const std::vector<RecordingFile*>& bags, const std::vector<std::string>& topics,
                         bool is_sorted, const ReceiptRange& range)
    : selection_(bags, topics, range), is_sorted_(is_sorted) {
  if (!is_sorted_) return;
  all_.reserve(selection_.size());
  while (const std::optional<RecordedMessage> message = selection_.next()) {
    order_.emplace_back(readHeaderStamp(*message), all_.size());
    all_.push_back(*message);
  }
  std::sort(order_.begin(), order_.end());
}

const RecordedMessage* BagMessages::next() {
  if (is_sorted_) return next_ < order_.size() ? &all_[order_[next_++].second] : nullptr;
  message_ = selection_.next();
  return message_ ? &*message_ : nullptr;
}

}  // namespace urban_nav_input
