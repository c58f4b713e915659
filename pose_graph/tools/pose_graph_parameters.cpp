// SPDX-License-Identifier: BSD-3-Clause
#include "live/nodelet_parameters.hpp"
#include "pose_graph/parameters.hpp"
#include "urban_nav_core/parameters/documents.hpp"

int main(int argc, char** argv) {
  const auto& stage = pose_graph::table();
  const auto& nodelet = pose_graph::nodeletTable();
  return urban_nav_core::documentParameters(argc, argv,
                                            {{stage.stage(), stage.rows()}, {nodelet.stage(), nodelet.rows()}});
}
