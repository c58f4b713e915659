// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/parameters.hpp"

#include <cstdint>

namespace pose_graph {

using urban_nav_core::Audience;
using urban_nav_core::Table;

Parameters::Parameters() { table().setDefaults(*this); }

// clang-format would put each column on its own line.
// clang-format off
const Table<Parameters>& table() {
  using P = Parameters;
  static const Table<Parameters> rows(
      "pose_graph",
      {
          {"solver", &P::solver, "", std::string("gauss_newton"), false, false, {"gauss_newton", "relative_pcg",
           "ceres"},
           "Solver: sparse Gauss-Newton over the condensed graph. relax and map support two slower references for the "
           "accepted closures, which the nodelet rejects: relative_pcg, the paper's conjugate gradients over relative "
           "transforms, and ceres.",
           "paper 5, eq. 8-19", {}, Audience::Experts},
          {"robust", &P::robust, "", true, false, false, {},
           "Rejects closures that are inconsistent with the others; if off, every edge is used as given.", "paper 5"},
          {"gravity", &P::gravity, "", true, false, false, {},
           "Corrects the drift of roll and pitch of odometry by the accelerometer; if off, it only aligns the map with "
           "gravity.", "paper 5; measured"},
          {"gps", &P::gps, "", false, false, false, {},
           "Uses position fixes of satellite navigation (gps/fix) in the relaxation, robustly; useful over paths of "
           "more than some hundreds of metres without closures.",
           "measured"},
          {"gps_correlation", &P::gps_correlation, "s", 180.0, 0.01, 10000.0, {},
           "Correlation time of errors of satellite navigation: fixes within twice this time share their information.",
           "Parkinson and Spilker 1996, ch. 11", {}, Audience::Experts},
          {"iterations", &P::iterations, "", std::int64_t{100}, std::int64_t{1}, std::int64_t{10000}, {},
           "Limit of steps of one minimisation, which ends earlier on convergence.",
           "paper 5", {}, Audience::Experts},
          {"confirmation_distance", &P::confirmation_distance, "m", 0.5, 0.0, 1000.0, {},
           "A closure that would move a pose by more than this waits for confirmation by a second closure, unless it "
           "is a stereo closure within the odometry gate.",
           "docs/derivations/pose_graph.md", {"jump_distance"}},
          {"confirmation_angle", &P::confirmation_angle, "deg", 2.0, 0.0, 180.0, {},
           "A closure that would rotate a pose by more than this waits as for confirmation_distance.",
           "docs/derivations/pose_graph.md", {"jump_angle"}, Audience::Experts},
      });
  return rows;
}
// clang-format on

}  // namespace pose_graph
