// SPDX-License-Identifier: BSD-3-Clause
// Writes the parameter tables of README.md and config/segway_drivers.yaml; test/parameters_test.cpp compares them with
// the table.
#include "live/nodelet_parameters.hpp"
#include "segway_drivers/parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  return urban_nav_core::documentParameters(
      argc, argv,
      {{segway_drivers::table().stage(), segway_drivers::table().rows()},
       {segway_drivers::nodeletTable().stage(), segway_drivers::nodeletTable().rows()}});
}
