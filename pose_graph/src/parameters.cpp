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
           "Solver of the graph: sparse Gauss-Newton on the condensed graph. relax and map offer two slower reference "
           "solvers for the accepted closures, not available in the nodelet: relative_pcg, conjugate gradients on "
           "relative transforms as in the paper, and ceres.",
           "paper 5, eq. 8-19", {}, Audience::Experts},
          {"robust", &P::robust, "", true, false, false, {},
           "Reject closures that are inconsistent with the others; otherwise all edges are used.", "paper 5"},
          {"gravity", &P::gravity, "", true, false, false, {},
           "Correct the drift of roll and pitch by the accelerometer; otherwise it only determines the vertical of "
           "the map.", "paper 5; measured"},
          {"gps", &P::gps, "", false, false, false, {},
           "Use GPS positions (gps/fix) in the relaxation, with a robust loss; useful on paths of more than some "
           "hundreds of metres without closures.",
           "measured"},
          {"gps_correlation", &P::gps_correlation, "s", 180.0, 0.01, 10000.0, {},
           "Correlation time of GPS errors: fixes within twice this time share their information.",
           "Parkinson and Spilker 1996, ch. 11", {}, Audience::Experts},
          {"iterations", &P::iterations, "", std::int64_t{100}, std::int64_t{1}, std::int64_t{10000}, {},
           "Maximum number of steps of one minimisation; fewer at convergence.",
           "paper 5", {}, Audience::Experts},
          {"confirmation_distance", &P::confirmation_distance, "m", 0.5, 0.0, 1000.0, {},
           "A single closure that would move a pose by more than this waits for confirmation by a second one, unless "
           "it is a stereo closure consistent with odometry.",
           "docs/derivations/pose_graph.md", {"jump_distance"}},
          {"confirmation_angle", &P::confirmation_angle, "deg", 2.0, 0.0, 180.0, {},
           "A single closure that would rotate a pose by more than this waits for confirmation by a second one, as "
           "for confirmation_distance.", "docs/derivations/pose_graph.md", {"jump_angle"}, Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace pose_graph
