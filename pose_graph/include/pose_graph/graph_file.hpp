// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/problem.hpp"
#include "pose_graph/robust.hpp"
#include "urban_nav_core/io/g2o.hpp"

namespace pose_graph {

/// A pose-graph file as a problem. Pose ids become 0...n-1 in ascending order of id; edges keep the order of the file.
/// Vertices that edges refer to but the file does not list are initialised by following edges and reported in `notes`.
/// Landmarks, and the reference frame of priors and fixed vertices, are appended as poses, their measurements as edges.
/// Fixed vertices and the reference frame are fixed poses.
template <int D>
struct FileProblem {
  using Id = urban_nav_core::G2oGraph::Id;

  Problem<D> problem;
  std::vector<EdgeRole> roles;  ///< of each edge of `problem`
  std::vector<Id> ids;          ///< file id of each vertex pose, the first poses of `problem`
  std::vector<Id> point_ids;    ///< file id of each landmark, the poses after the vertices
  std::vector<int> edges;  ///< index in problem.edges of each edge of the file; -1 for an edge from a pose to itself
  std::vector<int> point_edges;  ///< index in problem.edges of each landmark measurement
  std::vector<int> priors;       ///< index in problem.edges of each prior
  int frame = -1;  ///< the fixed pose that represents the file's frame; -1 if no prior or fixed vertex refers to it
  std::vector<std::string> notes;  ///< remarks for the user, one sentence each
};

/// Which part of an edge's information must be positive semidefinite.
enum class Semidefinite {
  Whole,   ///< the full matrix
  Blocks,  ///< the translation and the rotation block, which are all that the chordal objective uses; in some public
           ///< graphs the full matrix is indefinite
};

/// Converts a file. In 3D files information refers to the vector part of a quaternion, half the rotation vector: its
/// rotation block is divided by 4 and its cross blocks by 2.
/// Requires: `graph.dimension` is D.
/// Throws UserError with `name` if an information matrix is not positive semidefinite (tolerance 3e-5 of the largest
/// eigenvalue, the round-off of six printed digits), if a parameter is used but not defined, and if the file has no
/// edges.
template <int D>
FileProblem<D> makeProblem(const urban_nav_core::G2oGraph& graph, const std::string& name,
                           Semidefinite demanded = Semidefinite::Whole);

/// Returns `graph` with vertices and landmarks at `poses` (all of `file.problem`). Vertices that the file did not list
/// are appended; fixed vertices keep their values.
template <int D>
urban_nav_core::G2oGraph withPoses(const urban_nav_core::G2oGraph& graph, const FileProblem<D>& file,
                                   const std::vector<Rigid<D>>& poses);

/// Conversions to and from the pose type of urban_nav_core.
template <int D>
Rigid<D> toRigid(const urban_nav_core::Pose& pose);
urban_nav_core::Pose toPose(const Rigid<2>& T);
urban_nav_core::Pose toPose(const Rigid<3>& T);

}  // namespace pose_graph
