// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pose_graph/graph_file.hpp"
#include "pose_graph/robust.hpp"

namespace urban_nav {

/// `from,to,weight,verdict,reason`, a row for each edge between poses in the order of the file. After them, with the
/// same columns, measurements of landmarks (pose, landmark) and priors (vertex, nothing).
template <int D>
std::string edgesCsv(const urban_nav_core::G2oGraph& graph, const pose_graph::FileProblem<D>& file,
                     const std::vector<pose_graph::EdgeAssessment>& assessments);

/// `vertex` and its covariance, 9 numbers in the plane or 36, row by row: of T_first_vertex within its part of the
/// graph, or of the vertex in the frame of the file if priors or several fixed vertices define it; (rho, phi) in the
/// axes of that frame. Unmeasured directions have 1e6 m2 and 10 rad2.
template <int D>
std::string covarianceCsv(const pose_graph::FileProblem<D>& file,
                          const std::vector<pose_graph::EdgeAssessment>& assessments,
                          const std::vector<pose_graph::Rigid<D>>& poses);

/// The graph without rejected edges, in the order of the lines of the file.
template <int D>
urban_nav_core::G2oGraph withoutRejected(const urban_nav_core::G2oGraph& graph, const pose_graph::FileProblem<D>& file,
                                         const std::vector<pose_graph::EdgeAssessment>& assessments);

}  // namespace urban_nav
