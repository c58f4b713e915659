// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav_core {

/// Time between two stamps, both included.
struct Interval {
  StampNs from = 0, to = 0;
};

}  // namespace urban_nav_core
