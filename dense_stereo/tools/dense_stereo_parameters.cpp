// SPDX-License-Identifier: BSD-3-Clause
// Writes the parameter tables of README.md and config/dense_stereo.yaml; test/parameters_test.cpp compares them with
// the table.
#include "dense_stereo/parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& stage = dense_stereo::table();
  return urban_nav_core::documentParameters(argc, argv, {{stage.stage(), stage.rows()}});
}
