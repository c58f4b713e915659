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

/// Compares how long after its stamp each topic's messages were received: topics whose clocks agree are received within
/// a second of their stamps all alike. Topics that were not received as they were stamped (bags that were converted)
/// are left out. Not thread-safe.
class ClockExamination {
 public:
  /// Adds a message of a role, "images", "laser_left" and so on.
  void add(const std::string& role, const std::string& topic, urban_nav_core::StampNs stamp,
           urban_nav_core::StampNs receipt);
  /// Returns a finding for each topic whose clock is off that of the images. The options state its delay, `input.ROLE
  /// _delay`. `present`: returns the delay, ms, by which the stamps of a role that add() got were reduced; nullopt for
  /// a role without such a parameter.
  std::vector<Finding> findings(const std::function<std::optional<double>(const std::string& role)>& present) const;
  void archive(urban_nav_core::Archive& archive) { archive(names_, delays_); }

 private:
  std::vector<std::pair<std::string, std::string>> names_;                       // role, topic
  std::vector<std::vector<std::pair<urban_nav_core::StampNs, double>>> delays_;  // stamp; s, receipt minus stamp
};

}  // namespace urban_nav_input
