// SPDX-License-Identifier: BSD-3-Clause
// Prints the parameter tables of README.md and config/laser_odometry.yaml; test/parameters_test.cpp compares both with
// the code.
#include "laser_odometry/parameters.hpp"
#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& stage = laser_odometry::table();
  const auto& nodelet = laser_odometry::nodeletTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{stage.stage(), stage.rows()}, {nodelet.stage(), nodelet.rows()}});
}
