// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time_query.hpp"
#include "loop_metric/evidence.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// A closure of a store with its evidence.
struct StoredClosure {
  std::int64_t id = 0;  ///< from 1; permanent in the store
  urban_nav_store::Edge edge;
  std::string name_a, name_b;           ///< names of the sessions
  double since_a = 0.0, since_b = 0.0;  ///< s from the first node of each session
  std::optional<double> probability;    ///< that the places are the same, if known
  loop_metric::Evidence evidence;       ///< may be empty
};

/// Returns all closures of a store in the order of their ids: measured, asserted and rejected ones. Throws DataError
/// for damaged evidence.
std::vector<StoredClosure> listClosures(urban_nav_store::Store& store);

/// Returns the closure of an edge that is not in the store, with its packed evidence; its id is 0.
StoredClosure describeEdge(urban_nav_store::Store& store, const urban_nav_store::Edge& edge,
                           const std::string& evidence);

/// Returns the larger time difference, s, between the ends of a closure and two moments in any order. Infinite for
/// other sessions.
double computeDistance(const StoredClosure& closure, const TimeQuery& one, const TimeQuery& other);

}  // namespace urban_nav
