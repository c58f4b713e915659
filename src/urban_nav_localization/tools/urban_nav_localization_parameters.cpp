// SPDX-License-Identifier: BSD-3-Clause
// Prints the parameter tables of README.md and config/*.yaml; test/parameters_test.cpp compares them with the code.
#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"
#include "urban_nav_localization/parameters.hpp"

int main(int argc, char** argv) {
  const auto& stage = urban_nav_localization::table();
  const auto& nodelet = urban_nav_localization::nodeletTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{stage.stage(), stage.rows()}, {nodelet.stage(), nodelet.rows()}});
}
