// SPDX-License-Identifier: BSD-3-Clause
#include "diagnostics.hpp"

#include "urban_nav_ros/diagnostics.hpp"

namespace loop_metric {

using diagnostic_msgs::DiagnosticStatus;
using urban_nav_core::Health;
using urban_nav_core::Status;

Diagnostics::Diagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name,
                         const HeardTopics& topics, bool views, bool clouds)
    : topics_(topics), views_(views), clouds_(clouds), updater_(nh, private_nh, name) {
  updater_.setHardwareID("none");
  updater_.add("loop closures", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { report(status); });
}

void Diagnostics::judged(const urban_nav_core::MetricClosure& closure, double ms) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_verdict_ = std::string(toString(closure.verdict)) + " (" +
                  (closure.reason_name.empty() ? toString(closure.method) : closure.reason_name) +
                  "): " + closure.sentence;
  last_ms_ = ms;
}

void Diagnostics::worked(const Recorder::State& recorder, const Judge::Counts& judge, const StoreState& store,
                         const Counts& counts) {
  const std::lock_guard<std::mutex> lock(mutex_);
  recorder_ = recorder;
  judge_ = judge;
  store_ = store;
  counts_ = counts;
}

void Diagnostics::paused(bool paused) {
  const std::lock_guard<std::mutex> lock(mutex_);
  paused_ = paused;
}

Status Diagnostics::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return trouble();
}

Status Diagnostics::trouble() const {
  const auto degraded = [](Trouble reason, const std::string& sentence) {
    return Status{Health::Degraded, static_cast<int>(reason), sentence};
  };
  if (paused_) return {};
  if (!store_.fault.empty()) return degraded(Trouble::NotStored, "nothing is stored: " + store_.fault);
  if (const std::string silence = topics_.silenceOf(HeardTopics::Kind::Odometry); !silence.empty())
    return degraded(Trouble::NoOdometry, silence);
  if (views_ && !recorder_.camera_fault.empty()) return degraded(Trouble::NoCamera, recorder_.camera_fault);
  if (const std::string silence = topics_.silenceOf(HeardTopics::Kind::Images); views_ && !silence.empty())
    return degraded(Trouble::NoImages, "no views are kept: " + silence);
  if (!clouds_) return {};
  if (const std::string silence = topics_.silenceOf(HeardTopics::Kind::Lasers); !silence.empty())
    return degraded(Trouble::NoLasers, "no whole clouds: " + silence);
  if (!recorder_.laser_fault.empty()) return degraded(Trouble::NoLaserPlace, recorder_.laser_fault);
  return {};
}

void Diagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Status now = trouble();
  if (paused_) {
    status.summary(DiagnosticStatus::OK, "paused");
  } else {
    const unsigned char level = static_cast<Trouble>(now.reason) == Trouble::NotStored
                                    ? static_cast<unsigned char>(DiagnosticStatus::ERROR)
                                    : urban_nav_ros::diagnosticLevelOf(now.health);
    status.summary(level, now.sentence.empty() ? toString(now.health) : now.sentence);
  }
  status.add("status", std::string(toString(now.health)));
  status.add("reason", std::string(toString(static_cast<Trouble>(now.reason))));
  status.add("session", recorder_.session);
  status.add("parts of its odometry", judge_.parts);
  status.add("views kept", recorder_.views.kept);
  status.add("stereo pairs", recorder_.views.pairs);
  status.add("stereo pairs without odometry", recorder_.views.unplaced);
  status.add("scans", recorder_.scans);
  status.add("candidates", counts_.candidates);
  status.add("candidates that wait", judge_.waiting);
  status.add("accepted by stereo", judge_.stereo);
  status.add("accepted by ICP", judge_.icp);
  status.add("rejected", judge_.rejected);
  status.add("last verdict", last_verdict_);
  status.add("time of the last candidate (ms)", last_ms_);
  status.add("dropped: queue full", recorder_.dropped + judge_.dropped);
  status.add("dropped: paused", counts_.paused_dropped);
  status.add("dropped: before odometry", recorder_.not_kept);
  status.add("steps of odometry refused", recorder_.refused_steps);
  status.add("messages damaged", counts_.damaged + recorder_.damaged_scans + recorder_.views.damaged);
  status.add("camera", recorder_.camera_note);
  status.add("store", store_.path);
  status.add("store: writes committed", store_.committed);
  status.add("store: writes that wait", store_.waiting);
  status.add("store: writes refused", store_.refused);
  status.add("store: writes lost", store_.lost);
  status.add("store: fault", store_.fault);
}

}  // namespace loop_metric
