// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_store/session.hpp"

namespace pose_graph {

/// Writes a graph without a store to `path`, with the rules of copyStore(). Returns a message. Throws Error.
std::string writeStore(const PoseGraph& graph, const std::map<SessionId, urban_nav_store::Session>& sessions,
                       const std::string& path);

/// Copies the store at `from` to `to` atomically. An existing store at `to` is replaced if `from` contains all its
/// sessions. Throws UserError, naming the session, if one is missing, and for any other existing file.
void copyStore(const std::string& from, const std::string& to);

}  // namespace pose_graph
