// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/parameters.hpp"

#include <cstdint>

namespace pose_graph {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would give each of the columns a line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "pose_graph",
      {
          {"solver", &P::solver, "", std::string("gauss_newton"), false, false, {"gauss_newton", "relative_pcg",
           "ceres"},
           "How the graph is relaxed: sparse Gauss-Newton over the condensed graph. relax and map know two slower "
           "references for the accepted closures, which the nodelet refuses: relative_pcg, the paper's conjugate "
           "gradients over relative transforms, and ceres.",
           "paper 5, eq. 8-19", {}, Audience::Experts},
          {"robust", &P::robust, "", true, false, false, {},
           "Closures that disagree with the others are rejected; without, every edge is taken as it is.", "paper 5"},
          {"gravity", &P::gravity, "", true, false, false, {},
           "Accelerometer measurements remove the drift of roll and pitch from odometry; without, they only determine "
           "which direction is up.", "paper 5; measured"},
          {"gps", &P::gps, "", false, false, false, {},
           "Positions that satellites measured (gps/fix) take part in the relaxation, robustly; useful over ways of "
           "more than some hundreds of metres without closures.",
           "measured"},
          {"gps_correlation", &P::gps_correlation, "s", 180.0, 0.01, 10000.0, {},
           "How long errors of satellite navigation last: fixes within twice this time share their information.",
           "Parkinson and Spilker 1996, ch. 11", {}, Audience::Experts},
          {"iterations", &P::iterations, "", std::int64_t{100}, std::int64_t{1}, std::int64_t{10000}, {},
           "Steps of one minimisation, at most; fewer where nothing is left to gain.",
           "paper 5", {}, Audience::Experts},
          {"confirmation_distance", &P::confirmation_distance, "m", 0.5, 0.0, 1000.0, {},
           "A single closure that would move a pose by more than this waits for a second one that agrees, unless it "
           "is a stereo closure that odometry allows.",
           "docs/derivations/pose_graph.md", {"jump_distance"}},
          {"confirmation_angle", &P::confirmation_angle, "deg", 2.0, 0.0, 180.0, {},
           "The same for a rotation.", "docs/derivations/pose_graph.md", {"jump_angle"}, Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace pose_graph
