// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/io/g2o.hpp"

namespace pose_graph::test {

/// What is known of the optima of a public graph (data sets' README).
struct PublicGraph {
  std::string name;
  int dimension = 0;
  double chordal = 0.0, g2o = 0.0;
};
/// Empty where URBAN_NAV_DATA names no folder with graphs.
std::vector<PublicGraph> publicGraphs();
/// Empty without the program xz.
std::optional<urban_nav_core::G2oGraph> readPublic(const std::string& name);

}  // namespace pose_graph::test
