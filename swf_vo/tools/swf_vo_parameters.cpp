// SPDX-License-Identifier: BSD-3-Clause
// Prints the parameter tables of README.md and config/swf_vo.yaml; test/parameters_test.cpp checks that they are equal
// to the code's.
#include "live/nodelet_parameters.hpp"
#include "swf_vo/parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& stage = swf_vo::table();
  const auto& nodelet = swf_vo::nodeletTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{stage.stage(), stage.rows()}, {nodelet.stage(), nodelet.rows()}});
}
