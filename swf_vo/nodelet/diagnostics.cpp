// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics.hpp"

#include <algorithm>
#include <cmath>

namespace swf_vo {

using diagnostic_msgs::DiagnosticStatus;
using urban_nav_core::StampNs;

namespace {

constexpr double silent_after = 1.0;  // s; the slowest cameras that odometry can use have 5 Hz

std::string milliseconds(double ms) { return std::to_string(std::lround(ms)) + " ms"; }

}  // namespace

Diagnostics::Diagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name)
    : updater_(nh, private_nh, name) {
  updater_.setHardwareID("stereo camera");
  updater_.add("odometry", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { report(status); });
}

void Diagnostics::expect(Topic topic, const std::string& name) {
  const std::lock_guard<std::mutex> lock(mutex_);
  arrivals_[topic] = urban_nav_ros::Arrival(name);
}

void Diagnostics::received(Topic topic, StampNs stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  arrivals_[topic].happen();
  stamps_[topic] = stamp;
}

void Diagnostics::worked(const Frame& frame, double process_ms, const Counts& counts) {
  const std::lock_guard<std::mutex> lock(mutex_);
  status_ = frame.status;
  statistics_ = frame.statistics;
  process_ms_ = process_ms;
  counts_ = counts;
}

void Diagnostics::waiting(const std::string& reason) {
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_ = reason;
}

void Diagnostics::paused(bool paused) {
  const std::lock_guard<std::mutex> lock(mutex_);
  paused_ = paused;
}

std::string Diagnostics::topicTrouble() const {
  for (const urban_nav_ros::Arrival& arrival : arrivals_)
    if (const std::string absence = arrival.absence(); !absence.empty()) return absence;
  const bool left_leads = stamps_[LeftImage] > stamps_[RightImage];
  const Topic leader = left_leads ? LeftImage : RightImage, partner = left_leads ? RightImage : LeftImage;
  // Between two messages one side is ahead of the other in good health too; only a pair that was incomplete makes it a
  // fault.
  const double behind_ms = 1e-6 * static_cast<double>(stamps_[leader] - stamps_[partner]);
  const bool incomplete =
      status_.reason == static_cast<int>(Reason::ImageMissing) || arrivals_[partner].age() > silent_after;
  if (incomplete && behind_ms > 0.0 && arrivals_[leader].age() < silent_after)
    return arrivals_[partner].name() + " is " + milliseconds(behind_ms) + " behind " + arrivals_[leader].name();
  for (const Topic topic : {LeftImage, RightImage, Motion})
    if (const std::string silence = arrivals_[topic].silence(silent_after); !silence.empty()) return silence;
  return {};
}

void Diagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string trouble = topicTrouble();
  if (paused_) {
    status.summary(DiagnosticStatus::OK, "paused");
  } else if (!waiting_.empty()) {
    status.summary(DiagnosticStatus::WARN, waiting_ + (trouble.empty() ? "" : ": " + trouble));
  } else {
    std::string text = status_.sentence.empty() ? toString(status_.health) : status_.sentence;
    if (!trouble.empty()) text += ": " + trouble;
    const unsigned char at_least = trouble.empty() ? DiagnosticStatus::OK : DiagnosticStatus::WARN;
    status.summary(std::max(urban_nav_ros::diagnosticLevelOf(status_.health), at_least), text);
  }
  status.add("status", std::string(toString(status_.health)));
  status.add("reason", std::string(toString(static_cast<Reason>(status_.reason))));
  status.add("features", statistics_.features);
  status.add("tracked", statistics_.tracked);
  status.add("reprojection error (px)", statistics_.reprojection_px);
  status.add("disparity offset (px)", statistics_.disparity_offset_px);
  status.add("row offset (px)", statistics_.row_offset_px);
  status.add("noise, of what images say", statistics_.noise_scale);
  status.add("time of the last frame (ms)", process_ms_);
  status.add("frames", counts_.frames);
  status.add("sessions", counts_.sessions);
  status.add("dropped: queue full", counts_.queue_dropped);
  status.add("dropped: paused", counts_.paused_dropped);
  status.add("dropped: too late", counts_.late);
  status.add("dropped: came twice", counts_.doubled);
  status.add("left images missing", counts_.left_missing);
  status.add("right images missing", counts_.right_missing);
  status.add("images damaged", counts_.damaged);
}

}  // namespace swf_vo
