// SPDX-License-Identifier: BSD-3-Clause
// Writes the parameter tables of README.md and config/fabmap_node.yaml; test/parameters_test.cpp compares them with the
// tables.
#include "fabmap_node/parameters.hpp"
#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& stage = fabmap_node::table();
  const auto& nodelet = fabmap_node::nodeletTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{stage.stage(), stage.rows()}, {nodelet.stage(), nodelet.rows()}});
}
