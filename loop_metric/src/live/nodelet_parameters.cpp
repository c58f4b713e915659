// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"

namespace loop_metric {

using urban_nav_core::Table;

NodeletParameters::NodeletParameters() { nodeletTable().setDefaults(*this); }

// clang-format would put each column on a separate line.
// clang-format off
const Table<NodeletParameters>& nodeletTable() {
  using P = NodeletParameters;
  static const Table<NodeletParameters> rows(
      "",
      urban_nav_live::withStereoInput<P>({
          {"robot", &P::robot, "", "", false, false, {},
           "Name of the robot; with the name of the recording and the first stamp it makes the id of the session.",
           "docs/files.md"},
          {"recording", &P::recording, "", "", false, false, {},
           "Name of the recording, the same on all computers of the robot.", "docs/files.md"},
          {"store", &P::store, "", "", false, false, {},
           "Absolute path of the session store for keyframes, scans and odometry, committed each second; candidates "
           "may refer to its earlier sessions. Empty: a temporary file. One writer per file.",
           "docs/files.md"},
          {"candidate_timeout", &P::candidate_timeout, "s", 10.0, 0.0, 3600.0, {},
           "Largest time, by stamps, that a candidate waits until the robot has driven on by cloud_half_length "
           "(keyframe_search_distance without lasers); by the clock without odometry.", "paper 4.2", {"patience"}},
      }, 2000));
  return rows;
}
// clang-format on

}  // namespace loop_metric
