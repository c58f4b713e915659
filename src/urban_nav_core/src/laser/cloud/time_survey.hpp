// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "laser/cloud/field_statistics.hpp"
#include "urban_nav_core/laser/cloud/cloud_convention.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Statistics of all fields of one cloud.
struct CloudStatistics {
  StampNs stamp = 0;  ///< of the header
  std::vector<FieldStatistics> fields;

  const FieldStatistics* find(const std::string& name) const;
};

/// Sets point times, their fault and the duration of sweeps in a convention. `clouds`: at least one, in order of time.
void findPointTimes(const std::vector<CloudStatistics>& clouds, const CloudOptions& options,
                    CloudConvention& convention);

}  // namespace urban_nav_core
