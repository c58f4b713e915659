// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Results of the sessions of a store as `map` writes them.
struct StoredResults {
  struct File {
    std::string name, content;
  };
  std::vector<File> files;            ///< trajectories, covariances, closures.csv, graph.g2o
  std::vector<std::string> left_out;  ///< sentences on files that the store has no data for
};

/// Returns the files of all sessions of a store, in the order of their start, identical to the output of `map`.
StoredResults readResults(urban_nav_store::Store& store);

/// Returns the names of the sessions of a store in closures.csv.
std::map<urban_nav_store::SessionId, std::string> sessionNamesById(urban_nav_store::Store& store);

/// Returns the number, from 0, of the map whose origin is in session `id`, for fileSuffix().
std::size_t numberOfSession(urban_nav_store::Store& store, const urban_nav_store::SessionId& id);

}  // namespace urban_nav
