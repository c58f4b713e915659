// SPDX-License-Identifier: BSD-3-Clause
#include "topics/lo/lo_summary.hpp"

#include <algorithm>

#include "map/motion_summary.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav {

namespace {

constexpr std::size_t kFaultsInSummary = 20;
constexpr double kLaserScaleSigma = 5e-4;  // relative, as laser_odometry states it

std::string reasonName(const OdometryFrame& row) {
  return laser_odometry::toString(static_cast<laser_odometry::Reason>(row.status.reason));
}

/// Appends the number of sweeps by reason, with the sentence of the first one.
void addReasons(const LoRun& run, std::vector<std::string>& warnings) {
  struct Problem {
    std::int64_t count = 0;
    std::string sentence;
  };
  std::map<std::string, Problem> problems;
  for (const OdometryFrame& row : run.frames) {
    if (row.status.reason == 0) continue;
    Problem& problem = problems[reasonName(row)];
    if (problem.count++ == 0) problem.sentence = row.status.sentence;
  }
  for (const auto& [name, problem] : problems)
    warnings.push_back(run.input + ": " + std::to_string(problem.count) + " of " + std::to_string(run.frames.size()) +
                       " sweeps (" + name + "): " + problem.sentence);
}

void addWarnings(const LoRun& run, std::vector<std::string>& warnings) {
  const std::size_t shown = std::min(run.faults.size(), kFaultsInSummary);
  for (std::size_t i = 0; i < shown; ++i) warnings.push_back(run.faults[i]);
  const auto more = run.faults_total - static_cast<std::int64_t>(shown);
  if (more > 0) warnings.push_back(run.input + ": " + std::to_string(more) + " more faults of the data");
}

}  // namespace

LoSummary summariseLo(const std::vector<const LoRun*>& runs) {
  LoSummary summary;
  summary.status_counts = {{"OK", 0}, {"DEGRADED", 0}, {"LOST", 0}, {"RECOVERED", 0}};
  std::vector<double> ms;
  double points = 0.0, used = 0.0, moving = 0.0, residuals = 0.0;
  std::int64_t registered = 0;
  for (const LoRun* run : runs) {
    for (std::size_t i = 0; i < run->frames.size(); ++i) {
      const OdometryFrame& row = run->frames[i];
      const LoFigures& figures = run->figures[i];
      ++summary.sweeps;
      ++summary.status_counts[toString(row.status.health)];
      if (row.status.reason != 0) ++summary.reason_counts[reasonName(row)];
      if (!row.accepted) ++summary.dropped;
      if (row.status.health != urban_nav_core::Health::Lost && !figures.free_directions.empty()) ++summary.degenerate;
      summary.deskewed = summary.deskewed || figures.statistics.deskewed;
      ms.push_back(figures.process_ms);
      points += figures.statistics.points;
      used += figures.statistics.used;
      moving += figures.statistics.moving;
      if (figures.statistics.patches == 0) continue;
      residuals += figures.statistics.residual_m;
      ++registered;
    }
    addWarnings(*run, summary.warnings);
    summary.motion = run->motion;
    if (!run->frames.empty())
      addMotionFaults(run->motion, run->input, run->frames.front().stamp, summary.reason_sentences);
    addReasons(*run, summary.reason_sentences);
  }
  summary.warnings.insert(summary.warnings.end(), summary.reason_sentences.begin(), summary.reason_sentences.end());
  if (summary.sweeps > 0) summary.points_mean = points / static_cast<double>(summary.sweeps);
  if (used + moving > 0.0) summary.moving_share = moving / (used + moving);
  if (registered > 0) summary.residual_mean = residuals / static_cast<double>(registered);
  summary.ms_median = urban_nav_core::quantile(ms, 0.5);
  summary.ms_p99 = urban_nav_core::quantile(std::move(ms), 0.99);
  return summary;
}

Json toJson(const LoSummary& summary) {
  Json json = Json::object();
  json["sweeps"] = summary.sweeps;
  json["sweeps_dropped"] = summary.dropped;
  json["ms_median"] = summary.ms_median;
  json["ms_p99"] = summary.ms_p99;
  json["points_mean"] = summary.points_mean;
  json["moving_share"] = summary.moving_share;
  json["residual_m_mean"] = summary.residual_mean;
  json["degenerate"] = summary.degenerate;
  json["deskewed"] = summary.deskewed;
  addMotion(summary.motion, kLaserScaleSigma, json);
  Json& sensors = json["motion_sensors"] = Json::array();
  if (summary.motion.uses_gyroscope) sensors.append("gyroscope");
  if (summary.motion.uses_wheels) sensors.append("wheels");
  Json& statuses = json["status_counts"] = Json::object();
  for (const char* name : {"OK", "DEGRADED", "LOST", "RECOVERED"}) statuses[name] = summary.status_counts.at(name);
  Json& reasons = json["reason_counts"] = Json::object();
  for (const auto& [reason, count] : summary.reason_counts) reasons[reason] = count;
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : summary.warnings) warnings.append(warning);
  return json;
}

}  // namespace urban_nav
