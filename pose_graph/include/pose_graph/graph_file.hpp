// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/problem.hpp"
#include "pose_graph/robust.hpp"
#include "urban_nav_core/io/g2o.hpp"

namespace pose_graph {

/// A pose-graph file as a problem: the ids of its poses, whatever they are, become 0...n-1 in ascending order; its
/// edges stay in the order of the file. Vertices that edges name and the file does not list are placed by following
/// edges, and named in `notes`. Landmarks and the frame that priors and fixed vertices refer to become further poses,
/// their measurements further edges after those of the file; fixed vertices and the frame are fixed poses.
template <int D>
struct FileProblem {
  using Id = urban_nav_core::G2oGraph::Id;

  Problem<D> problem;
  std::vector<EdgeRole> roles;     ///< of each edge of `problem`
  std::vector<Id> ids;             ///< of the first poses of `problem`
  std::vector<Id> point_ids;       ///< of the landmarks, the poses after those
  std::vector<int> edges;          ///< of each edge of the file: its index in problem.edges; -1 for one to itself
  std::vector<int> point_edges;    ///< of each measurement of a landmark: its index in problem.edges
  std::vector<int> priors;         ///< of each prior
  int frame = -1;                  ///< the fixed pose that is the frame of the file; -1 where nothing refers to one
  std::vector<std::string> notes;  ///< what a user should know, a sentence each
};

/// What of an edge's information must be positive semidefinite.
enum class Semidefinite {
  Whole,   ///< all of it
  Blocks,  ///< its translation and its rotation block, all that the chordal objective reads: public graphs exist of
           ///< which the rest is not
};

/// `graph.dimension` must be D. Information of 3D files is that of the quaternion's vector, half the rotation vector:
/// its rotation block is divided by 4 and its cross blocks by 2. Throws UserError with `name` for information that is
/// not positive semidefinite (to 3e-5 of its largest eigenvalue, which six printed digits cost), for a parameter that
/// is named and not defined, and for a file without edges.
template <int D>
FileProblem<D> makeProblem(const urban_nav_core::G2oGraph& graph, const std::string& name,
                           Semidefinite demanded = Semidefinite::Whole);

/// The graph with these poses (all of `file.problem`) for its vertices and landmarks; vertices it did not list are
/// added at the end. Fixed vertices keep their numbers.
template <int D>
urban_nav_core::G2oGraph withPoses(const urban_nav_core::G2oGraph& graph, const FileProblem<D>& file,
                                   const std::vector<Rigid<D>>& poses);

/// The core's pose, and back.
template <int D>
Rigid<D> toRigid(const urban_nav_core::Pose& pose);
urban_nav_core::Pose toPose(const Rigid<2>& T);
urban_nav_core::Pose toPose(const Rigid<3>& T);

}  // namespace pose_graph
