// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pose_graph/graph_file.hpp"

namespace pose_graph {

/// Adds the remaining contents of a file as poses, edges and fixed poses, which all solvers and objectives support.
///
/// A landmark becomes a pose, and a measurement of it an edge without rotation information. The first measurement of
/// each landmark also constrains its rotation to that of the observing pose, which adds no cost at the optimum and
/// leaves no free direction. A prior becomes an edge from a fixed pose at the origin, the reference frame of the file;
/// the offset of its sensor is the lever arm of that edge. Fixed vertices become fixed poses.
///
/// Requires: `file.ids`, and the poses and edges of the vertices in `file`.
/// Throws UserError with `name` if a parameter or a landmark is missing, or information is indefinite.
template <int D>
void addConstraints(const urban_nav_core::G2oGraph& graph, const std::string& name, Semidefinite demanded,
                    FileProblem<D>& file);

}  // namespace pose_graph
