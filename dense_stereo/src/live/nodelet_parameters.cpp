// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

namespace dense_stereo {

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      urban_nav_live::withStereoInput<P>(
          {
              {"always", &P::always, "", false, false, true, {},
               "Whether pairs are matched even if no topic has a subscriber.", "stereo_image_proc"},
              {"gravity", &P::gravity, "", true, false, true, {},
               "Whether the search for the ground uses the direction of gravity from imu/data, if received.",
               "section 6.2"},
          },
          20));
  return rows;
}
// clang-format on

}  // namespace dense_stereo
