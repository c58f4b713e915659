// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/page.hpp"
#include "topics/graph/graph_run.hpp"

namespace urban_nav {

/// Returns the tables of the report on the closures of a run: their verdicts, each with the test that was nearest to
/// the opposite result, and all tests of each closure, as `urban_nav why` prints them. Rows of the first table carry
/// the ID of their closure in the store and link to the second one. The first 500 closures are listed.
std::vector<PageTable> closureTables(const GraphRun& graph);

}  // namespace urban_nav
