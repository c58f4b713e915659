// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/problem.hpp"
#include "urban_nav_core/io/g2o.hpp"

namespace pose_graph {

/// A pose-graph file as a problem: its ids, whatever they are, become 0...n-1 in ascending order; its edges stay in the
/// order of the file. Vertices that edges name and the file does not list are placed by following edges, and named in
/// `notes`.
template <int D>
struct FileProblem {
  Problem<D> problem;
  std::vector<urban_nav_core::G2oGraph::Id> ids;  ///< of each pose
  std::vector<std::string> notes;                 ///< what a user should know, a sentence each
};

/// What of an edge's information must be positive semidefinite.
enum class Semidefinite {
  Whole,   ///< all of it
  Blocks,  ///< its translation and its rotation block, all that the chordal objective reads: public graphs exist of
           ///< which the rest is not
};

/// `graph.dimension` must be D. Information of 3D files is that of the quaternion's vector, half the rotation vector:
/// its rotation block is divided by 4 and its cross blocks by 2. Throws UserError with `name` for information that is
/// not positive semidefinite (to 1e-9 of its largest eigenvalue) and for a file without edges.
template <int D>
FileProblem<D> makeProblem(const urban_nav_core::G2oGraph& graph, const std::string& name,
                           Semidefinite demanded = Semidefinite::Whole);

/// The graph with these poses for its vertices; vertices it did not list are added at the end.
template <int D>
urban_nav_core::G2oGraph withPoses(const urban_nav_core::G2oGraph& graph, const FileProblem<D>& file,
                                   const std::vector<Rigid<D>>& poses);

/// The core's pose, and back.
template <int D>
Rigid<D> toRigid(const urban_nav_core::Pose& pose);
urban_nav_core::Pose toPose(const Rigid<2>& T);
urban_nav_core::Pose toPose(const Rigid<3>& T);

}  // namespace pose_graph
