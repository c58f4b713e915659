// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/command.hpp"
#include "command_line/console.hpp"
#include "fabmap_node/recognition/place_recogniser.hpp"

namespace urban_nav {

/// Recognition of one observation; `match->place` indexes PlaceQuery::rows.
struct PlaceQueryRow {
  std::size_t session = 0;
  urban_nav_core::StampNs stamp = 0;
  fabmap_node::PlaceRecognition recognition;
  std::size_t matched_row = 0;  ///< row of the earlier place, if there is a match
};

struct PlaceQuery {
  std::vector<std::string> sessions;
  std::vector<PlaceQueryRow> rows;
  std::size_t unused = 0;  ///< observations with too few features
};

/// Runs a model over sessions in order; each observation is compared with all earlier ones outside the mask.
PlaceQuery queryPlaces(const fabmap_node::PlaceModel& model, const std::vector<std::string>& inputs,
                       const std::vector<std::string>& topics, const fabmap_node::RecogniserOptions& options,
                       Console& console);

/// Reads the model at `path`; `default` is the one that the suite comes with.
fabmap_node::PlaceModel readPlaceModel(const std::string& path);

/// Options that query and evaluate share.
std::vector<Option> placeQueryOptions();
/// Reads them. Throws UserError.
fabmap_node::RecogniserOptions placeRecogniserOptions(const Arguments& arguments);

}  // namespace urban_nav
