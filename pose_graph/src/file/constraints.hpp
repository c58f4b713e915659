// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pose_graph/graph_file.hpp"

namespace pose_graph {

/// Adds what a file holds besides poses and edges between them, as poses, edges and fixed poses, so that every solver
/// and every objective knows it:
///
/// A landmark is a pose, and a measurement of it an edge without information on its rotation; the first measurement of
/// each ties the rotation to the observing pose, which costs nothing at the optimum and leaves nothing free. A prior is
/// an edge from a fixed pose at the origin, which is the frame of the file; a sensor away from its vertex is the lever
/// arm of that edge. Fixed vertices are fixed poses.
///
/// Requires `file.ids`, the poses and the edges of the vertices in `file`.
/// Throws UserError with `name` where a parameter or a landmark is missing, or information is indefinite.
template <int D>
void addConstraints(const urban_nav_core::G2oGraph& graph, const std::string& name, Semidefinite demanded,
                    FileProblem<D>& file);

}  // namespace pose_graph
