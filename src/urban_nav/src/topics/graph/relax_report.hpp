// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "pose_graph/certificate.hpp"
#include "pose_graph/scales.hpp"

namespace urban_nav {

/// The three costs of the same poses.
struct GraphCosts {
  double geodesic = 0.0, chordal = 0.0, g2o = 0.0;
};

/// Report of a run of `relax`.
struct RelaxReport {
  GraphCosts before, after;
  std::size_t poses = 0, edges = 0, rejected = 0, iterations = 0;
  std::size_t landmarks = 0, landmark_edges = 0, priors = 0;
  int components = 0;
  std::optional<double> variance;  ///< RobustSolution::variance_factor, with --robust
  std::string ending;
  std::optional<double> gradient;  ///< Solution::gradient, if terminated early
  double ms = 0.0;
  std::optional<pose_graph::Certificate> certificate;  ///< of the accepted edges, for the chordal objective
  std::optional<pose_graph::DeviationScales> scales;   ///< with --robust
  std::vector<std::string> warnings;
};

std::string toText(const RelaxReport& report);
Json toJson(const RelaxReport& report);

}  // namespace urban_nav
