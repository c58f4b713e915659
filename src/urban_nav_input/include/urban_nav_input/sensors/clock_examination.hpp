// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Compares the delays from stamp to receipt between topics: for synchronised clocks they agree within a second.
/// Ignores topics whose times of receipt do not follow the stamps (converted bags). Not thread-safe.
class ClockExamination {
 public:
  /// Adds a message of a role, "images", "laser_left" and so on.
  void add(const std::string& role, const std::string& topic, urban_nav_core::StampNs stamp,
           urban_nav_core::StampNs receipt);
  /// Returns a finding for each topic whose clock differs from that of the images. The options set its delay,
  /// `input.ROLE _delay`. `present`: returns the delay, ms, already subtracted from the stamps of a role; nullopt for a
  /// role without such a parameter.
  std::vector<Finding> findings(const std::function<std::optional<double>(const std::string& role)>& present) const;
  void archive(urban_nav_core::Archive& archive) { archive(names_, delays_); }

 private:
  std::vector<std::pair<std::string, std::string>> names_;                       // role, topic
  std::vector<std::vector<std::pair<urban_nav_core::StampNs, double>>> delays_;  // stamp; s, receipt minus stamp
};

}  // namespace urban_nav_input
