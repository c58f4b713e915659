// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "topics/loops/stored_closure.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Explains the verdict on a closure from the evidence in the store: all tests with value and limit.
std::string explain(const StoredClosure& closure);
/// Explains the verdict on a page, with the two views and their matches, and the two clouds, if stored.
/// `cloud_half_length`: registration.cloud_half_length, m.
Page explainOnPage(const StoredClosure& closure, urban_nav_store::Store& store, double cloud_half_length);
Json explainAsJson(const StoredClosure& closure);

/// Returns a line for each closure, for `why` without a closure.
std::string makeList(const std::vector<StoredClosure>& closures);

}  // namespace urban_nav
