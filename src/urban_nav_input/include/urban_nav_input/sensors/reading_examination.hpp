// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "urban_nav_core/io/archive.hpp"
#include "urban_nav_core/types/stamp.hpp"
#include "urban_nav_input/examination/finding.hpp"

namespace urban_nav_input {

/// Counts the readings of one topic that are not finite, and those equal to the previous one. Not thread-safe.
class ReadingExamination {
 public:
  /// Adds the numbers of a message.
  void add(urban_nav_core::StampNs stamp, const std::array<double, 6>& numbers);
  /// `kind`: of the findings. `is_frozen_odd`: whether readings that repeat are a fault; those of wheels at rest are
  /// not.
  std::vector<Finding> findings(const std::string& topic, FindingKind kind, bool is_frozen_odd) const;
  void archive(urban_nav_core::Archive& archive) {
    archive(messages_, no_stamp_, not_finite_, repeated_, first_, first_not_finite_, last_not_finite_, last_);
  }

 private:
  std::int64_t messages_ = 0, no_stamp_ = 0, not_finite_ = 0, repeated_ = 0;
  urban_nav_core::StampNs first_ = 0, first_not_finite_ = 0, last_not_finite_ = 0;  // stamps
  std::array<double, 6> last_ = {{}};
};

}  // namespace urban_nav_input
