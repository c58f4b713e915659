// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "urban_nav_core/types/status.hpp"

namespace urban_nav_live {

/// State of a stage for its operator.
struct StageReport {
  struct Figure {
    std::string name, value;
  };
  /// Faults among things of one kind, counted from the start of the stage (FaultRates).
  struct FaultCount {
    std::string what;  ///< "pairs were dropped"
    std::int64_t faults = 0, total = 0;
    std::string advice;  ///< what to do about it: "lower the rate of the camera"
  };

  urban_nav_core::Status status;
  std::string reason_name = "None";  ///< of `status.reason`
  /// Sentence that `/diagnostics` begins with; empty: the sentence of `status`, or its health.
  std::string summary;
  bool is_error = false;              ///< an error whatever the health, for example nothing can be stored
  bool is_warning = false;            ///< a warning at least
  std::vector<Figure> figures;        ///< in the order in which they are shown
  std::vector<std::string> warnings;  ///< sentences, each a warning at least; they follow the summary
  std::vector<FaultCount> fault_counts;

  /// Appends a warning, unless the sentence is empty.
  void warn(const std::string& sentence) {
    if (!sentence.empty()) warnings.push_back(sentence);
  }
  /// Appends a figure.
  void add(const std::string& name, const std::string& value) { figures.push_back({name, value}); }
  void add(const std::string& name, const char* value) { figures.push_back({name, value}); }
  void add(const std::string& name, double value);
  template <typename Integer, typename = std::enable_if_t<std::is_integral_v<Integer>>>
  void add(const std::string& name, Integer value) {
    figures.push_back({name, std::to_string(value)});
  }
};

/// Level of a report as diagnostic_msgs/DiagnosticStatus counts it.
enum class ReportLevel : unsigned char { Ok = 0, Warning = 1, Error = 2 };

/// Returns the level of a health: OK and RECOVERED are fine, DEGRADED is a warning, LOST an error.
ReportLevel reportLevel(urban_nav_core::Health health);
/// Returns the level and the summary that an operator is shown. `paused`: nothing is wrong. `topic_fault`: what is
/// wrong with the topics, appended to the summary with the level `topic_level`; empty: nothing.
std::pair<ReportLevel, std::string> summarise(const StageReport& report, bool paused, const std::string& topic_fault,
                                              ReportLevel topic_level = ReportLevel::Warning);

}  // namespace urban_nav_live
