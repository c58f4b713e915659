// SPDX-License-Identifier: BSD-3-Clause
// What README.md and config/laser_odometry.yaml say of the parameters; test/parameters_test.cpp compares both with the
// table.
#include "laser_odometry/parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& stage = laser_odometry::table();
  return urban_nav_core::documentParameters(argc, argv, {{stage.stage(), stage.rows()}});
}
