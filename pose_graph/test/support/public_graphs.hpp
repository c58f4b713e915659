// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/io/g2o.hpp"

namespace pose_graph::test {

/// A public graph and its known optima (data sets' README).
struct PublicGraph {
  std::string name;
  int dimension = 0;
  double chordal = 0.0, g2o = 0.0;
};
/// Returns the public graphs; empty if URBAN_NAV_DATA contains none.
std::vector<PublicGraph> publicGraphs();
/// Reads a public graph; nullopt without the program xz.
std::optional<urban_nav_core::G2oGraph> readPublic(const std::string& name);

}  // namespace pose_graph::test
