// SPDX-License-Identifier: BSD-3-Clause
// Writes the parameter tables of README.md and config/laser_mapper.yaml; test/parameters_test.cpp compares them with
// the table.
#include "laser_mapper/parameters.hpp"
#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& stage = laser_mapper::table();
  const auto& nodelet = laser_mapper::nodeletTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{stage.stage(), stage.rows()}, {nodelet.stage(), nodelet.rows()}});
}
