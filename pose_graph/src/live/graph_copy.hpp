// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_store/session.hpp"

namespace pose_graph {

/// Writes a graph that has no store to one at `path`, as copyStore() does. Returns what was done. Throws Error.
std::string writeStore(const PoseGraph& graph, const std::map<SessionId, urban_nav_store::Session>& sessions,
                       const std::string& path);

/// Copies the store at `from` to `to`, as a whole or not at all. An existing store at `to` is replaced if all of its
/// sessions are in `from`. Throws UserError if one is not, naming it, and for any other existing file.
void copyStore(const std::string& from, const std::string& to);

}  // namespace pose_graph
