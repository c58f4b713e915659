// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_live/stage_report.hpp"

#include <algorithm>
#include <sstream>

namespace urban_nav_live {

using urban_nav_core::Health;

void StageReport::add(const std::string& name, double value) {
  std::ostringstream text;
  text << value;
  figures.push_back({name, text.str()});
}

ReportLevel reportLevel(Health health) {
  switch (health) {
    case Health::Ok:
    case Health::Recovered: return ReportLevel::Ok;
    case Health::Degraded: return ReportLevel::Warning;
    case Health::Lost: break;
  }
  return ReportLevel::Error;
}

std::pair<ReportLevel, std::string> summarise(const StageReport& report, bool paused, const std::string& topic_fault,
                                              ReportLevel topic_level) {
  if (paused) return {ReportLevel::Ok, "paused"};
  ReportLevel level = reportLevel(report.status.health);
  if (report.is_warning || !report.warnings.empty()) level = std::max(level, ReportLevel::Warning);
  if (!topic_fault.empty()) level = std::max(level, topic_level);
  if (report.is_error) level = ReportLevel::Error;
  std::string text = report.summary;
  if (text.empty()) text = report.status.sentence;
  if (text.empty()) text = toString(report.status.health);
  if (!topic_fault.empty()) text += ": " + topic_fault;
  for (const std::string& warning : report.warnings) text += "; " + warning;
  return {level, text};
}

}  // namespace urban_nav_live
