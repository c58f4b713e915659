// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "pose_graph/problem.hpp"
#include "urban_nav_core/testing/graphs.hpp"

namespace pose_graph::bench {

/// In the plane or in space, as the file or the simulation has it. std::visit gives the one to a generic function.
using AnyProblem = std::variant<Problem<2>, Problem<3>>;

/// `guess`: where the poses begin.
AnyProblem makeProblem(const urban_nav_core::testing::SimulatedGraph& graph,
                       const std::vector<urban_nav_core::Pose>& guess);

/// One of the public graphs of URBAN_NAV_DATA/graphs with what is known of its optima (its README.md).
struct PublicGraph {
  std::string name;
  AnyProblem problem;
  double chordal = 0.0;  ///< F_certified
  double g2o = 0.0;      ///< chi2_g2o_optimum
};
/// All of them or those that are named, in the order of optima.csv. Needs the program xz. UserError where
/// URBAN_NAV_DATA does not lead to them.
std::vector<PublicGraph> publicGraphs(const std::vector<std::string>& names);

}  // namespace pose_graph::bench
