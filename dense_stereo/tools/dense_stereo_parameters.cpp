// SPDX-License-Identifier: BSD-3-Clause
// Writes the parameter tables of README.md and config/dense_stereo.yaml; test/parameters_test.cpp compares them with
// the tables.
#include "dense_stereo/parameters.hpp"
#include "live/nodelet_parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& stage = dense_stereo::table();
  const auto& nodelet = dense_stereo::nodeletTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{stage.stage(), stage.rows()}, {nodelet.stage(), nodelet.rows()}});
}
