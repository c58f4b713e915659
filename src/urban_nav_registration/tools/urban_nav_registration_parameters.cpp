// SPDX-License-Identifier: BSD-3-Clause
// Prints the parameter tables of README.md and config/*.yaml; test/parameters_test.cpp compares them with the code.
#include "urban_nav_core/parameters/documents.hpp"
#include "urban_nav_registration/parameters.hpp"

int main(int argc, char** argv) {
  const auto& stage = urban_nav_registration::table();
  return urban_nav_core::documentParameters(argc, argv, {{stage.stage(), stage.rows()}});
}
