// SPDX-License-Identifier: BSD-3-Clause
#include "store_link.hpp"

#include <filesystem>
#include <utility>

#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/merge.hpp"

namespace pose_graph {

using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::Store;

namespace {

constexpr std::chrono::seconds kAgain{10};

}  // namespace

std::optional<StoredGraph> StoreLink::open() {
  if (path_.empty() || keeper_) return std::nullopt;
  if (tried_ && Clock::now() - *tried_ < kAgain) return std::nullopt;
  tried_ = Clock::now();
  try {
    if (path_.front() != '/') throw UserError("store", "`" + path_ + "`", "an absolute path");
    Store store(path_, Access::Write);
    StoredGraph stored = readGraph(store);
    keeper_ = std::make_unique<Keeper>(std::move(store), stored.revision);
    fault_.clear();
    return stored;
  } catch (const urban_nav_core::Error& error) {
    fault_ = error.what();
    return std::nullopt;
  }
}

StoreState StoreLink::state() const {
  StoreState state;
  state.path = path_;
  state.fault = fault_;
  if (!keeper_) return state;
  const urban_nav_store::LiveWriter::Counts counts = keeper_->counts();
  state.fault = counts.fault;
  state.committed = counts.committed;
  state.refused = counts.refused;
  state.waiting = counts.waiting;
  state.lost = keeper_->lost();
  return state;
}

std::string writeStore(const PoseGraph& graph, const std::map<SessionId, urban_nav_store::Session>& sessions,
                       const std::string& path) {
  const std::string beside = path + ".saving";
  urban_nav_store::removeStore(beside);  // of a process that was killed
  try {
    {
      Keeper keeper(Store(beside, Access::Write), 0);
      for (const Track& track : graph.tracks()) keeper.put(sessions.at(track.session));
      for (const auto& [id, closure] : graph.closures())
        if (closure.odometry_gate) keeper.putEvidence(edgeOf(closure), evidenceOf(true));
      while (!keeper.isUpToDate(graph)) {
        keeper.handOver(graph);
        keeper.writer()->flush();
        if (const std::string fault = keeper.counts().fault; !fault.empty()) throw UserError("", fault, "");
      }
    }
    copyStore(beside, path);
  } catch (const urban_nav_core::Error&) {
    urban_nav_store::removeStore(beside);
    throw;
  }
  urban_nav_store::removeStore(beside);
  return "written";
}

void copyStore(const std::string& from, const std::string& to) {
  if (std::error_code error; std::filesystem::exists(to, error)) {
    Store ours(from, Access::Read), theirs(to, Access::Read);
    for (const urban_nav_store::Session& session : theirs.sessions().all())
      if (!ours.sessions().find(session.id))
        throw UserError(to, "has session " + session.id + " (" + session.name + "), which this graph does not have",
                        "a name where there is no file yet; or load it first");
  }
  urban_nav_store::merge({from}, to);
}

}  // namespace pose_graph
