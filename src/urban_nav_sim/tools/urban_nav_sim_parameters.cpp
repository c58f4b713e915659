// SPDX-License-Identifier: BSD-3-Clause
// What README.md says of the parameters; test/live/simulator_parameters_test.cpp holds it equal to the table.
#include "live/simulator_parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& table = urban_nav_sim::simulatorTable();
  return urban_nav_core::documentParameters(argc, argv, {{table.stage(), table.rows()}});
}
