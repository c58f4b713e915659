// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/command.hpp"
#include "base/console.hpp"
#include "fabmap_node/recognition/place_recogniser.hpp"

namespace urban_nav {

/// Recognition of one observation; `match->place` is the number of a place, `matched_row` its row.
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

/// Described observations of consecutive sessions.
struct PlaceRecording {
  struct Place {
    std::size_t session = 0;
    urban_nav_core::StampNs stamp = 0;
    fabmap_node::PlaceDescription description;
    std::string thumbnail;  ///< JPEG; empty without an image
  };
  std::vector<std::string> sessions;
  std::vector<Place> places;
};

/// Runs a model over sessions in order; each observation is compared with all earlier ones outside the mask.
PlaceQuery queryPlaces(const fabmap_node::PlaceModel& model, const std::vector<std::string>& inputs,
                       const std::vector<std::string>& topics, const fabmap_node::RecogniserOptions& options,
                       Console& console);

/// Describes the observations of sessions once, for several runs of recognisePlaces().
PlaceRecording recordPlaces(const fabmap_node::PlaceModel& model, const std::vector<std::string>& inputs,
                            const std::vector<std::string>& topics, const fabmap_node::MatcherOptions& options,
                            Console& console);
/// Like queryPlaces(), for a recording: returns one row for each of its places. `progress`: called after each.
PlaceQuery recognisePlaces(const fabmap_node::PlaceModel& model, const PlaceRecording& recording,
                           const fabmap_node::RecogniserOptions& options,
                           const std::function<void(std::size_t done)>& progress = {});

/// Reads the model at `path`; `default` is that of the suite.
fabmap_node::PlaceModel readPlaceModel(const std::string& path);

/// Options that query and evaluate share.
std::vector<Option> placeQueryOptions();
/// Reads the options of placeQueryOptions(). Throws UserError.
fabmap_node::RecogniserOptions placeRecogniserOptions(const Arguments& arguments);

}  // namespace urban_nav
