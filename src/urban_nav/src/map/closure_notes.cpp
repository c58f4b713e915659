// SPDX-License-Identifier: BSD-3-Clause
#include "map/closure_notes.hpp"

#include "map/previous_sessions.hpp"
#include "urban_nav_store/stored_ids.hpp"

namespace urban_nav {

std::vector<std::string> closureNotes(const MapOptions& options, bool measured) {
  const bool has_places = measured && isRequested(options, "places");
  if (!options.closures.empty())
    return {"closures: " + options.closures +
            (measured ? "; the stage loops measures their transforms, those in the file are ignored"
                      : ", with the transforms in the file (no stage loops)") +
            (has_places ? "; and those proposed by places" : "")};
  if (has_places) return {"closures: those proposed by places"};
  if (options.store.empty()) return {"closures: none (--closures FILE); the map follows odometry"};
  urban_nav_store::Store store = urban_nav_store::openForReading(options.store);
  if (holdsClosures(store)) return {"closures: those of " + options.store};
  return {};
}

}  // namespace urban_nav
