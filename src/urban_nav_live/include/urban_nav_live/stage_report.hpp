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
  /// Faults of one kind and the total number of items, counted since the start of the stage (FaultRates).
  struct FaultCount {
    std::string what;  ///< "pairs were dropped"
    std::int64_t faults = 0, total = 0;
    std::string advice;  ///< remedy: "lower the rate of the camera"
  };

  urban_nav_core::Status status;
  std::string reason_name = "None";  ///< name of `status.reason`
  /// First message in `/diagnostics`; empty: the sentence of `status`, or its health.
  std::string summary;
  bool is_error = false;              ///< an error regardless of the health, for example if nothing can be stored
  bool is_warning = false;            ///< at least a warning
  std::vector<Figure> figures;        ///< in display order
  std::vector<std::string> warnings;  ///< messages after the summary; each is at least a warning
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

/// Level of a report, with the values of diagnostic_msgs/DiagnosticStatus.
enum class ReportLevel : unsigned char { Ok = 0, Warning = 1, Error = 2 };

/// Returns the level of a health: OK and RECOVERED are fine, DEGRADED is a warning, LOST an error.
ReportLevel reportLevel(urban_nav_core::Health health);
/// Returns level and summary for the operator. `paused`: the level is OK. `topic_fault`: fault of the topics, appended
/// to the summary with the level `topic_level`; empty: none.
std::pair<ReportLevel, std::string> summarise(const StageReport& report, bool paused, const std::string& topic_fault,
                                              ReportLevel topic_level = ReportLevel::Warning);

}  // namespace urban_nav_live
