// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "urban_nav_core/types/gps_reading.hpp"

namespace urban_nav_input {

/// The fixes of a session.
struct BagFixes {
  std::string topic;  ///< empty: the bags have none
  std::vector<urban_nav_core::GpsReading> readings;
  urban_nav_core::Vector3d p_base = urban_nav_core::Vector3d::Zero();  ///< m, of the antenna
  bool is_placed = false;                                              ///< by /tf_static; otherwise at base_link
};

/// Reads the fixes of the bags of one session, in the order of the bags. `topics`: wishes for chooseTopics().
/// `transforms`, `delay` (ns): as SourceOptions::transforms and gps_delay. Omits messages without a fix, or with
/// numbers that are not finite (toGpsReading()). Empty if `paths` are not bags. Throws DataError for a damaged bag.
BagFixes readBagFixes(const std::vector<std::string>& paths, const std::vector<std::string>& topics,
                      const std::vector<std::string>& transforms = {}, urban_nav_core::StampNs delay = 0);

}  // namespace urban_nav_input
