// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/reference_solver.hpp"

#include "urban_nav_core/types/error.hpp"

namespace pose_graph {

const ReferenceSolver* findReference(const std::string& name, const ReferenceSolvers& references) {
  std::string allowed = "gauss_newton";
  if (name == allowed) return nullptr;
  for (const ReferenceSolver& reference : references) {
    if (reference.name == name) return &reference;
    allowed += ", " + reference.name;
  }
  if (references.empty()) allowed += "; reference solvers are for the commands relax and map";
  throw urban_nav_core::UserError("", "pose_graph.solver = " + name, allowed);
}

}  // namespace pose_graph
