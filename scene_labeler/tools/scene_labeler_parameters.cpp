// SPDX-License-Identifier: BSD-3-Clause
// Writes the parameter tables of README.md and config/scene_labeler.yaml; test/parameters_test.cpp compares them with
// the tables.
#include "live/nodelet_parameters.hpp"
#include "scene_labeler/parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& stage = scene_labeler::table();
  const auto& nodelet = scene_labeler::nodeletTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{stage.stage(), stage.rows()}, {nodelet.stage(), nodelet.rows()}});
}
