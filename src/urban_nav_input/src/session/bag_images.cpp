// SPDX-License-Identifier: BSD-3-Clause
#include "session/bag_images.hpp"

#include <cmath>
#include <utility>

#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav_input {

namespace {

constexpr urban_nav_core::StampNs kClockStep = 1'000'000'000;  // ns

}  // namespace

std::vector<std::string> droppedMessages(const urban_nav_ros::StereoFeed& feed, const BagTopics& topics) {
  using urban_nav_core::MotionSource;
  using urban_nav_ros::Side;
  std::vector<std::string> sentences;
  for (const auto& [side, role] : {std::pair(Side::Left, Role::Left), std::pair(Side::Right, Role::Right)}) {
    const urban_nav_core::TimeOrderedQueueCounts& counts = feed.counts(side);
    const std::string topic = topics.find(role)->name;
    if (counts.late > 0)
      sentences.push_back(topic + ": " + std::to_string(counts.late) +
                          " images came too late by their stamps and were dropped");
    if (counts.duplicate > 0)
      sentences.push_back(topic + ": " + std::to_string(counts.duplicate) +
                          " images have the stamp of another and were dropped");
  }
  for (const auto& [source, role] :
       {std::pair(MotionSource::Gyroscope, Role::Imu), std::pair(MotionSource::Wheels, Role::Wheels)}) {
    const urban_nav_core::TimeOrderedQueueCounts counts = feed.counts(source);
    const auto topic = topics.find(role);
    if (counts.late > 0 && topic)
      sentences.push_back(topic->name + ": " + std::to_string(counts.late) + " of " + std::to_string(counts.received) +
                          " messages were not used: by their stamps they are more than 1 s before, or 10 s after, the "
                          "images received with them; synchronise the clocks, or set input." +
                          (role == Role::Imu ? "imu" : "wheels") + "_delay (`urban_nav doctor` states it)");
  }
  return sentences;
}

std::vector<std::string> describeOrder(const StampSurvey& survey, bool is_sorted) {
  std::vector<std::string> notes;
  if (survey.unset || survey.constant)
    notes.push_back(std::string(survey.unset ? "no header has a stamp" : "all stamps of a topic are equal") +
                    ": the times at which messages were received are used instead");
  if (is_sorted) notes.push_back("messages are not in the order of their stamps: sorted by stamp");
  if (survey.back > kClockStep)
    notes.push_back("stamps step back by " +
                    urban_nav_core::printNumber(std::round(1e-7 * static_cast<double>(survey.back)) / 100.0) +
                    " s during the recording (a clock was set): images after the step are left out "
                    "until the stamps have caught up");
  return notes;
}

}  // namespace urban_nav_input
