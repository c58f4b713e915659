// SPDX-License-Identifier: BSD-3-Clause
// Parameters of README.md and config/*.yaml; test/parameters_test.cpp compares them with the tables.
#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"
#include "urban_nav_trust/parameters.hpp"

int main(int argc, char** argv) {
  const auto& stage = urban_nav_trust::table();
  const auto& nodelet = urban_nav_trust::nodeletTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{stage.stage(), stage.rows()}, {nodelet.stage(), nodelet.rows()}});
}
