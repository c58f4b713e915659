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
  std::vector<std::string> left_out;  ///< sentences: what the store does not hold
};

/// Returns the files of all sessions of a store, in the order of their start, with the bytes that `map` wrote.
StoredResults readResults(urban_nav_store::Store& store);

/// Returns closures.csv of all sessions of a store, with the bytes that `map` wrote.
std::string storedClosures(urban_nav_store::Store& store);

/// Returns the names that closures.csv gives the sessions of a store.
std::map<urban_nav_store::SessionId, std::string> sessionNamesById(urban_nav_store::Store& store);

/// Returns the number of the session, from 0, whose map has its frame from session `id`: what fileSuffix() takes.
std::size_t numberOfSession(urban_nav_store::Store& store, const urban_nav_store::SessionId& id);

}  // namespace urban_nav
