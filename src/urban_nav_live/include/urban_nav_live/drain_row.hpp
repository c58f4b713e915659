// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "urban_nav_core/parameters/table.hpp"

namespace urban_nav_live {

/// Returns the row of the parameter `drain_s` of nodelets, s. `seconds`: its default.
template <typename P>
urban_nav_core::Row<P> drainRow(double P::*drain_s, double seconds = 5.0) {
  return {"drain_s",
          drain_s,
          "s",
          seconds,
          0.0,
          3600.0,
          {},
          "Time after an interrupt to process pending inputs.",
          "docs/architecture.md"};
}

}  // namespace urban_nav_live
