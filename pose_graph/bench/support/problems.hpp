// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "pose_graph/problem.hpp"
#include "urban_nav_core/testing/graphs.hpp"

namespace pose_graph::bench {

/// A problem in the plane or in space, depending on the file or simulation.
using AnyProblem = std::variant<Problem<2>, Problem<3>>;

/// `guess`: initial poses.
AnyProblem makeProblem(const urban_nav_core::testing::SimulatedGraph& graph,
                       const std::vector<urban_nav_core::Pose>& guess);

/// A public graph of URBAN_NAV_DATA/graphs with its known optima (see its README.md).
struct PublicGraph {
  std::string name;
  AnyProblem problem;
  double chordal = 0.0;  ///< F_certified
  double g2o = 0.0;      ///< chi2_g2o_optimum
};
/// Returns all public graphs, or those named, in the order of optima.csv. Requires the program xz. Throws UserError if
/// URBAN_NAV_DATA does not contain them.
std::vector<PublicGraph> publicGraphs(const std::vector<std::string>& names);

}  // namespace pose_graph::bench
