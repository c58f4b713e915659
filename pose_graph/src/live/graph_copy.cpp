// SPDX-License-Identifier: BSD-3-Clause
#include "live/graph_copy.hpp"

#include <filesystem>
#include <memory>

#include "pose_graph/graph_store_writer.hpp"
#include "pose_graph/stored_graph.hpp"
#include "urban_nav_core/types/error.hpp"
#include "urban_nav_store/merge.hpp"

namespace pose_graph {

using urban_nav_core::UserError;
using urban_nav_store::Access;
using urban_nav_store::LiveWriter;
using urban_nav_store::Store;

std::string writeStore(const PoseGraph& graph, const std::map<SessionId, urban_nav_store::Session>& sessions,
                       const std::string& path) {
  const std::string temporary = path + ".saving";
  urban_nav_store::removeStore(temporary);  // left over from a killed process
  try {
    {
      GraphStoreWriter writer(
          std::make_shared<LiveWriter>(Store(temporary, Access::Write), GraphStoreWriter::writerOptions()), 0);
      for (const Track& track : graph.tracks()) writer.put(sessions.at(track.session));
      for (const auto& [id, closure] : graph.closures())
        if (closure.odometry_gate) writer.putEvidence(toEdge(closure), toEvidence(true));
      while (!writer.isUpToDate(graph)) {
        writer.flush(graph);
        writer.writer()->flush();
        if (const std::string fault = writer.counts().fault; !fault.empty()) throw UserError("", fault, "");
      }
    }
    copyStore(temporary, path);
  } catch (const urban_nav_core::Error&) {
    urban_nav_store::removeStore(temporary);
    throw;
  }
  urban_nav_store::removeStore(temporary);
  return "written";
}

void copyStore(const std::string& from, const std::string& to) {
  if (std::error_code error; std::filesystem::exists(to, error)) {
    Store ours(from, Access::Snapshot), theirs(to, Access::Snapshot);
    for (const urban_nav_store::Session& session : theirs.sessions().all())
      if (!ours.sessions().find(session.id))
        throw UserError(to, "has session " + session.id + " (" + session.name + "), which this graph does not have",
                        "a name where there is no file yet; or load it first");
  }
  urban_nav_store::merge({from}, to);
}

}  // namespace pose_graph
