// SPDX-License-Identifier: BSD-3-Clause
#include "localise_diagnostics.hpp"

#include <utility>

#include "urban_nav_ros/diagnostics.hpp"

namespace loop_metric {

using diagnostic_msgs::DiagnosticStatus;
using urban_nav_core::Health;
using urban_nav_core::Status;

LocaliseDiagnostics::LocaliseDiagnostics(ros::NodeHandle& nh, ros::NodeHandle& private_nh, const std::string& name,
                                         const HeardTopics& topics, std::string map)
    : topics_(topics), map_(std::move(map)), updater_(nh, private_nh, name) {
  updater_.setHardwareID("none");
  updater_.add("localisation", [this](diagnostic_updater::DiagnosticStatusWrapper& status) { report(status); });
}

void LocaliseDiagnostics::worked(const LocaliseWorker::State& worker, const Counts& counts) {
  const std::lock_guard<std::mutex> lock(mutex_);
  worker_ = worker;
  counts_ = counts;
}

Status LocaliseDiagnostics::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return trouble();
}

Status LocaliseDiagnostics::trouble() const {
  const auto degraded = [](LocaliseTrouble reason, const std::string& sentence) {
    return Status{Health::Degraded, static_cast<int>(reason), sentence};
  };
  if (counts_.paused) return {};
  if (!worker_.map_fault.empty()) return degraded(LocaliseTrouble::NoMap, worker_.map_fault);
  if (const std::string silence = topics_.silenceOf(HeardTopics::Kind::Odometry); !silence.empty())
    return degraded(LocaliseTrouble::NoOdometry, silence);
  if (!worker_.camera_fault.empty()) return degraded(LocaliseTrouble::NoCamera, worker_.camera_fault);
  if (const std::string silence = topics_.silenceOf(HeardTopics::Kind::Images); !silence.empty())
    return degraded(LocaliseTrouble::NoImages, silence);
  if (worker_.map_views_read < worker_.map_views)
    return degraded(LocaliseTrouble::ReadingMap, "the map is being read: " + std::to_string(worker_.map_views_read) +
                                                     " of " + std::to_string(worker_.map_views) + " views");
  return {};
}

void LocaliseDiagnostics::report(diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Status now = trouble();
  const Located& located = worker_.located;
  const std::string known = toString(located.knowledge) + std::string(": ") + located.sentence;
  if (counts_.paused) {
    status.summary(DiagnosticStatus::OK, "paused");
  } else if (now.health != Health::Ok) {
    status.summary(static_cast<LocaliseTrouble>(now.reason) == LocaliseTrouble::NoMap
                       ? static_cast<unsigned char>(DiagnosticStatus::ERROR)
                       : urban_nav_ros::diagnosticLevelOf(now.health),
                   now.sentence);
  } else {
    status.summary(located.knowledge == Knowledge::Known ? DiagnosticStatus::OK : DiagnosticStatus::WARN, known);
  }
  status.add("status", std::string(toString(now.health)));
  status.add("reason", std::string(toString(static_cast<LocaliseTrouble>(now.reason))));
  status.add("knowledge", std::string(toString(located.knowledge)));
  status.add("why", std::string(toString(located.reason)));
  status.add("witnesses", located.witnesses);
  status.add("probability", located.probability);
  status.add("map", map_);
  status.add("views of the map", worker_.map_views);
  status.add("views of the map read", worker_.map_views_read);
  status.add("looks", worker_.looks);
  status.add("sightings", worker_.sightings);
  status.add("time of the last look (ms)", worker_.look_ms);
  status.add("places of the map", worker_.map_places);
  status.add("places of the map read", worker_.map_places_read);
  status.add("looks at clouds", worker_.cloud_looks);
  status.add("sightings of clouds", worker_.cloud_sightings);
  status.add("time of the last look at a cloud (ms)", worker_.cloud_look_ms);
  status.add("scans", worker_.scans);
  status.add("lasers",
             worker_.laser_fault.empty() ? std::string(worker_.scans > 0 ? "ok" : "none") : worker_.laser_fault);
  status.add("stereo pairs", worker_.views.pairs);
  status.add("stereo pairs without odometry", worker_.views.unplaced);
  status.add("initial poses taken", worker_.beliefs);
  status.add("initial poses refused", counts_.beliefs_refused);
  status.add("begun anew", worker_.begun_anew);
  status.add("dropped: queue full", worker_.dropped);
  status.add("dropped: views that waited", worker_.dropped_views);
  status.add("dropped: paused", counts_.paused_dropped);
  status.add("steps of odometry refused", worker_.refused_steps);
  status.add("messages damaged", counts_.damaged + worker_.views.damaged + worker_.damaged_scans);
  status.add("camera", worker_.camera_note);
}

}  // namespace loop_metric
