// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

#include <cstdint>

#include "urban_nav_core/types/frames.hpp"
#include "urban_nav_live/drain_row.hpp"

namespace urban_nav_trust {

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      {
          {"map_frame", &P::map_frame, "", urban_nav_core::frames::kMap, false, false, {},
           "Frame of the positions whose probabilities are published.", "REP-105"},
          {"queue_size", &P::queue_size, "messages", std::int64_t{200}, std::int64_t{2}, std::int64_t{1000000}, {},
           "Largest number of waiting inputs; beyond it the oldest is dropped and counted.", "docs/architecture.md"},
          urban_nav_live::drainRow(&P::drain_s),
      });
  return rows;
}
// clang-format on

}  // namespace urban_nav_trust
