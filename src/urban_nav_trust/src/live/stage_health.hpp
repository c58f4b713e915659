// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

namespace urban_nav_trust {

/// Health of all nodes of a robot by their diagnostics, as a short text for an operator. Not thread-safe.
class StageHealth {
 public:
  /// 0: OK, 1: warning, 2: error, as in diagnostic_msgs/DiagnosticStatus.
  static constexpr int kOk = 0, kWarning = 1, kError = 2;
  static constexpr double kSilence = 5.0;  ///< s: nodes publish once a second

  /// Adds the latest status of a node, received at time `now`, s.
  void add(const std::string& name, int level, const std::string& message, double now);

  /// Highest level, and one line for each node that is not OK, errors first; "all N nodes are OK" without any.
  struct Text {
    int level = kOk;
    std::string lines;
  };
  /// A node without a status for kSilence is an error.
  Text text(double now) const;

 private:
  struct Latest {
    int level = kOk;
    std::string message;
    double received = 0.0;  // s
  };
  std::map<std::string, Latest> nodes_;
};

/// Breaks a text at blanks into lines of at most `columns` characters, where words permit.
std::string wrapText(const std::string& text, std::size_t columns);

}  // namespace urban_nav_trust
