// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "topics/loops/stored_closure.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Why a closure has its verdict, from what the store holds: all tests with value and limit, and what would have been
/// needed.
std::string explain(const StoredClosure& closure);
/// The same as a page, with the two views and their matches, and the two clouds, where the store has them.
/// `cloud_half_length`: loop_metric's.
Page explainOnPage(const StoredClosure& closure, urban_nav_store::Store& store, double cloud_half_length);
Json explainAsJson(const StoredClosure& closure);

/// A line for each closure: what `why` says where none is asked for.
std::string makeList(const std::vector<StoredClosure>& closures);

}  // namespace urban_nav
