// SPDX-License-Identifier: BSD-3-Clause
// Writes the parameter tables of README.md; tests in test/live compare them with the tables.
#include "live/device_parameters.hpp"
#include "live/simulator_parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& simulator = urban_nav_sim::simulatorTable();
  const auto& device = urban_nav_sim::deviceTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{simulator.stage(), simulator.rows()}, {device.stage(), device.rows()}});
}
