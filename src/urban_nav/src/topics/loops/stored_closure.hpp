// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time_query.hpp"
#include "loop_metric/evidence.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// A closure of a store with all that is known of it.
struct StoredClosure {
  std::int64_t id = 0;  ///< from 1; it stays for the life of the store
  urban_nav_store::Edge edge;
  std::string name_a, name_b;           ///< of the sessions, for people
  double since_a = 0.0, since_b = 0.0;  ///< s from the first node of each session
  std::optional<double> probability;    ///< of the places being one, where it is known
  loop_metric::Evidence evidence;       ///< empty where there is none
};

/// All closures of a store in the order of their ids: measured, asserted and rejected ones. DataError where evidence is
/// damaged.
std::vector<StoredClosure> listClosures(urban_nav_store::Store& store);

/// The same of an edge that is not in the store, with evidence as the store would hold it; its id is 0.
StoredClosure describeEdge(urban_nav_store::Store& store, const urban_nav_store::Edge& edge,
                           const std::string& evidence);

/// How far a closure is from these two moments, the larger of both, s; the moments may come in either order. Infinite
/// where a session is another one.
double computeDistance(const StoredClosure& closure, const TimeQuery& one, const TimeQuery& other);

}  // namespace urban_nav
