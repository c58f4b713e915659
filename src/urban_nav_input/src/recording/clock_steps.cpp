// SPDX-License-Identifier: BSD-3-Clause
#include "recording/clock_steps.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "recording/bag_order.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kProbes = 400;          // of a topic
constexpr std::size_t kPersistence = 5;       // messages after a step with the new clock
constexpr StampNs kSameStep = 1'000'000'000;  // ns between the receipts of two topics

/// Messages of one topic in the order of receipt; headers are read on demand.
class TopicStamps {
 public:
  TopicStamps(Recording& recording, const std::string& topic) {
    MessageSelection selection = recording.select(std::vector<std::string>{topic});
    messages_.reserve(selection.size());
    while (const std::optional<RecordedMessage> message = selection.next()) messages_.push_back(*message);
  }

  std::size_t size() const { return messages_.size(); }
  StampNs receipt(std::size_t i) const { return messages_[i].receipt(); }
  StampNs stamp(std::size_t i) {
    const auto [known, is_new] = stamps_.try_emplace(i, 0);
    if (is_new) known->second = readHeaderStamp(messages_[i]);  // reads the whole message
    return known->second;
  }
  StampNs delay(std::size_t i) { return receipt(i) - stamp(i); }

 private:
  std::vector<RecordedMessage> messages_;
  std::map<std::size_t, StampNs> stamps_;  // read so far
};

/// Returns the median interval between the stamps of a topic over the probes, ns.
StampNs usualInterval(TopicStamps& topic, std::size_t stride) {
  std::vector<StampNs> intervals;
  for (std::size_t i = 0; i + stride < topic.size(); i += stride)
    if (const StampNs step = topic.stamp(i + stride) - topic.stamp(i); step > 0)
      intervals.push_back(step / static_cast<StampNs>(stride));
  if (intervals.empty()) return 0;
  const auto middle = intervals.begin() + static_cast<std::ptrdiff_t>(intervals.size() / 2);
  std::nth_element(intervals.begin(), middle, intervals.end());
  return *middle;
}

/// Returns whether the messages from `after` on keep their offset to the previous clock, unlike a single message out of
/// order.
bool isPersistent(TopicStamps& topic, std::size_t after, StampNs low, StampNs least) {
  const std::size_t end = std::min(topic.size(), after + kPersistence);
  for (std::size_t i = after; i < end; ++i)
    if (topic.delay(i) - low < least) return false;
  return true;
}

/// Returns the step between two messages, by bisection on the delay from stamp to receipt, which a step back increases.
/// `interval`: between the stamps; smaller steps cannot be distinguished from jitter.
std::optional<ClockStep> findStepBetween(TopicStamps& topic, std::size_t before, std::size_t after, StampNs interval) {
  const StampNs low = topic.delay(before), high = topic.delay(after);
  if (high - low < interval) return std::nullopt;
  while (after - before > 1) {
    const std::size_t middle = before + (after - before) / 2;
    (topic.delay(middle) - low < high - topic.delay(middle) ? before : after) = middle;
  }
  const StampNs back = topic.stamp(before) - topic.stamp(after);
  // A slow link delays ascending stamps. The clock stepped back by one interval more than the stamps.
  if (back <= 0 || !isPersistent(topic, after, topic.delay(before), (back + interval) / 2)) return std::nullopt;
  return ClockStep{topic.receipt(after), back + interval};
}

}  // namespace

std::vector<ClockStep> findClockSteps(Recording& recording, const std::vector<std::string>& topics) {
  std::vector<ClockStep> found;
  for (const std::string& name : topics) {
    TopicStamps topic(recording, name);
    if (topic.size() < 2) continue;
    const std::size_t stride = std::max<std::size_t>(1, topic.size() / kProbes);
    const StampNs interval = usualInterval(topic, stride);
    if (interval == 0) continue;
    for (std::size_t i = 0; i + 1 < topic.size(); i += stride) {
      const std::size_t next = std::min(i + stride, topic.size() - 1);
      if (topic.stamp(i) == 0 || topic.stamp(next) == 0) continue;
      if (const std::optional<ClockStep> step = findStepBetween(topic, i, next, interval)) found.push_back(*step);
    }
  }
  std::sort(found.begin(), found.end(), [](const ClockStep& a, const ClockStep& b) { return a.receipt < b.receipt; });
  std::vector<ClockStep> steps;
  for (const ClockStep& step : found)
    if (steps.empty() || step.receipt - steps.back().receipt > kSameStep) steps.push_back(step);
  return steps;
}

}  // namespace urban_nav_input
