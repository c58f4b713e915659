// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "live_graph.hpp"
#include "pose_graph/keeper.hpp"
#include "pose_graph/stored_graph.hpp"

namespace pose_graph {

/// The file in which the nodelet keeps its graph: what is in the way when it is opened is named, and it is tried again each
/// ten seconds. Used by one thread.
class StoreLink {
 public:
  /// An empty path: no store, ever.
  explicit StoreLink(std::string path) : path_(std::move(path)) {}

  /// Opens the file where it is time to try. What it holds, once, when it could be opened.
  std::optional<StoredGraph> open();
  /// Null while there is no store.
  Keeper* keeper() { return keeper_.get(); }
  StoreState state() const;
  const std::string& path() const { return path_; }

 private:
  using Clock = std::chrono::steady_clock;
  const std::string path_;
  std::unique_ptr<Keeper> keeper_;
  std::string fault_;  // of the last attempt to open it
  std::optional<Clock::time_point> tried_;
};

/// A store at `path` of a graph that is kept nowhere. As copyStore().
std::string writeStore(const PoseGraph& graph, const std::map<SessionId, urban_nav_store::Session>& sessions,
                       const std::string& path);

/// Copies the store at `from` to `to`, whole or not at all. What lies there is replaced where it is a store with no session that `from`
/// does not have; UserError that names one, or any other file.
void copyStore(const std::string& from, const std::string& to);

}  // namespace pose_graph
