// SPDX-License-Identifier: BSD-3-Clause
#include "recording/clock_steps.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "recording/bag_order.hpp"
#include "urban_nav_ros/stamp.hpp"

namespace urban_nav_input {

using urban_nav_core::StampNs;

namespace {

constexpr std::size_t kProbes = 400;              // of a topic
constexpr StampNs kSmallestStep = 1'000'000'000;  // ns
constexpr StampNs kSameStep = 1'000'000'000;      // ns between the receipts of two topics

/// Messages of one topic in the order of receipt; headers are read on demand.
class TopicStamps {
 public:
  TopicStamps(std::list<rosbag::Bag>& bags, const std::string& topic) {
    for (rosbag::Bag& bag : bags) view_.addQuery(bag, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& message : view_) messages_.push_back(message);
  }

  std::size_t size() const { return messages_.size(); }
  StampNs receipt(std::size_t i) const { return urban_nav_ros::toStampNs(messages_[i].getTime()); }
  StampNs stamp(std::size_t i) {
    const auto [known, is_new] = stamps_.try_emplace(i, 0);
    if (is_new) known->second = readHeaderStamp(messages_[i]);  // reads the whole message
    return known->second;
  }
  StampNs delay(std::size_t i) { return receipt(i) - stamp(i); }

 private:
  rosbag::View view_;
  std::vector<rosbag::MessageInstance> messages_;
  std::map<std::size_t, StampNs> stamps_;  // read so far
};

/// Returns the step between two messages, by bisection on the delay from stamp to receipt, which a step back increases.
std::optional<ClockStep> findStepBetween(TopicStamps& topic, std::size_t before, std::size_t after) {
  const StampNs low = topic.delay(before), high = topic.delay(after);
  if (high - low < kSmallestStep) return std::nullopt;
  while (after - before > 1) {
    const std::size_t middle = before + (after - before) / 2;
    (topic.delay(middle) - low < high - topic.delay(middle) ? before : after) = middle;
  }
  const StampNs back = topic.stamp(before) - topic.stamp(after);
  if (back <= kSmallestStep) return std::nullopt;  // a slow link delays stamps that ascend
  return ClockStep{topic.receipt(after), back};
}

}  // namespace

void addToView(rosbag::View& view, rosbag::Bag& bag, const std::vector<std::string>& topics,
               const ReceiptRange& range) {
  const auto toTime = [](StampNs stamp) {
    ros::Time time;
    time.fromNSec(static_cast<std::uint64_t>(stamp));
    return time;
  };
  view.addQuery(bag, rosbag::TopicQuery(topics), range.begin == 0 ? ros::TIME_MIN : toTime(range.begin),
                range.end == 0 ? ros::TIME_MAX : toTime(range.end - 1));
}

std::vector<ClockStep> findClockSteps(std::list<rosbag::Bag>& bags, const std::vector<std::string>& topics) {
  std::vector<ClockStep> found;
  for (const std::string& name : topics) {
    TopicStamps topic(bags, name);
    if (topic.size() < 2) continue;
    const std::size_t stride = std::max<std::size_t>(1, topic.size() / kProbes);
    for (std::size_t i = 0; i + 1 < topic.size(); i += stride) {
      const std::size_t next = std::min(i + stride, topic.size() - 1);
      if (topic.stamp(i) == 0 || topic.stamp(next) == 0) continue;
      if (const std::optional<ClockStep> step = findStepBetween(topic, i, next)) found.push_back(*step);
    }
  }
  std::sort(found.begin(), found.end(), [](const ClockStep& a, const ClockStep& b) { return a.receipt < b.receipt; });
  std::vector<ClockStep> steps;
  for (const ClockStep& step : found)
    if (steps.empty() || step.receipt - steps.back().receipt > kSameStep) steps.push_back(step);
  return steps;
}

}  // namespace urban_nav_input
