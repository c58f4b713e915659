// SPDX-License-Identifier: BSD-3-Clause
#include "urban_nav_localization/parameters.hpp"

#include <cstdint>

namespace urban_nav_localization {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "localization",
      {
          {"icp", &P::icp, "", true, false, false, {},
           "Search for local clouds in the map.",
           "paper 4.2"},
          {"gate", &P::gate, "", 5.0, 1.0, 1000.0, {},
           "Largest difference between two matches connected by odometry for mutual support, in standard deviations "
           "(root mean square).",
           "paper 4", {}, Audience::Experts},
          {"map_sigma", &P::map_sigma, "m", 0.05, 0.0, 10.0, {},
           "Standard deviation of positions in the map.",
           "pose_graph/README.md, end to end", {"loop_metric.map_sigma"}},
      });
  return rows;
}
// clang-format on

}  // namespace urban_nav_localization
