// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/command.hpp"
#include "base/console.hpp"
#include "fabmap_node/recognition/place_describer.hpp"
#include "urban_nav_core/types/stamp.hpp"

namespace urban_nav {

struct StampedObservation {
  urban_nav_core::StampNs stamp = 0;
  fabmap_node::PlaceObservation observation;  ///< without a describer
  fabmap_node::PlaceDescription description;  ///< with a describer
  std::string thumbnail;                      ///< JPEG, if requested
};

/// Requested content of each observation.
struct PlaceReading {
  const fabmap_node::PlaceDescriber* describer = nullptr;  ///< null: features instead of descriptions
  bool with_thumbnails = false;
};

/// Reads sessions one after the other and extracts their features on several threads. `session` is called with the
/// index and the name of each session before its observations, `place` for each observation in order of time. The order
/// of calls does not depend on the number of threads. Descriptions are computed on the same threads. Reports
/// progress and notes to `console`. Throws the errors of openPlaceSource().
void readPlaceSessions(const std::vector<std::string>& inputs, const std::vector<std::string>& topics, Console& console,
                       const PlaceReading& reading,
                       const std::function<void(std::size_t index, const std::string& name)>& session,
                       const std::function<void(StampedObservation observation)>& place);

}  // namespace urban_nav
