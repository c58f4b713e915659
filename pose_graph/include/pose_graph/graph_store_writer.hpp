// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "pose_graph/pose_graph.hpp"
#include "urban_nav_store/live_writer.hpp"

namespace pose_graph {

/// Writes a growing graph, and the specific force, the ground and the GPS fixes at its poses, to a store: hands what is
/// new to a LiveWriter, which commits once a second. Never waits for the disk. What the disk does not take (it is full,
/// say) remains in the graph and is handed over when there is room: nothing is lost while the process lives, and no
/// second copy grows. Used by one thread at a time.
class GraphStoreWriter {
 public:
  using StoredEdge = urban_nav_store::Edge;
  using LiveWriter = urban_nav_store::LiveWriter;

  /// Returns the options that `writer` of the constructor is to have.
  static LiveWriter::Options writerOptions(std::chrono::milliseconds period = std::chrono::milliseconds(1000));
  /// `revision`: the highest one in the store; those of the graph are added to it.
  GraphStoreWriter(std::shared_ptr<LiveWriter> writer, std::int64_t revision);

  /// Writes a session that began, was resumed, or has ended (`complete`). Required before its first node.
  void put(const urban_nav_store::Session& session,
           const std::vector<urban_nav_store::StoredParameter>& parameters = {});
  /// Writes the evidence of the stage that measured a closure.
  void putEvidence(const StoredEdge& edge, const std::string& evidence);
  /// Writes a closure that its stage has rejected: stored with its reason, not part of the graph.
  void putRejected(const StoredEdge& edge, const std::string& evidence);

  /// Declares that a track, as far as it is now, is in the store.
  void markStored(const PoseGraph& graph, std::size_t track);
  /// Declares that a closure is in the store.
  void markStored(const Closure& closure);
  /// Declares that the next sync() is of another graph, whose revisions continue. The store keeps what it has.
  void reset();
  /// Hands over what is new: nodes and closures each time; after a relaxation also verdicts, the anchors of sessions,
  /// and poses that differ by more than 1 cm or 0.02 deg from those in the store (`exactly`: at all). Several
  /// relaxations become one write while the disk is slow.
  void sync(const PoseGraph& graph, bool exactly = false);
  /// As sync(), with every pose exactly, and at once.
  void flush(const PoseGraph& graph);
  /// Returns true if all of `graph` has been handed over and committed.
  bool isUpToDate(const PoseGraph& graph) const;

  LiveWriter::Counts counts() const { return writer_->counts(); }
  /// Number of rejected closures and evidence lost for want of room.
  std::int64_t lost() const { return lost_; }
  std::shared_ptr<LiveWriter> writer() const { return writer_; }

 private:
  using Write = LiveWriter::Write;
  struct Stored {
    std::size_t nodes = 0, forces = 0, ground = 0, fixes = 0;
    std::vector<Pose> map;  // where the store has the first poses; later ones are as odometry
  };
  struct Batch;
  bool post(Write write);
  void postLater(Write write);
  bool syncPending();
  bool syncNodes(const PoseGraph& graph);
  bool syncForces(const PoseGraph& graph, bool at_once);
  bool syncGround(const PoseGraph& graph);
  bool syncFixes(const PoseGraph& graph);
  void syncRelaxation(const PoseGraph& graph, bool exactly, bool at_once);
  void collectPoses(const PoseGraph& graph, bool exactly, Batch& batch);
  void collectClosures(const PoseGraph& graph, Batch& batch);

  std::shared_ptr<LiveWriter> writer_;
  const std::int64_t revision_;               // that the store had
  std::int64_t posted_ = 0, lost_ = 0;        // writes
  std::int64_t relaxation_ = 0;               // which of them was the last relaxation's
  std::int64_t synced_revision_ = 0;          // of the graph, that it was of
  bool exact_ = true;                         // and it had every digit
  ClosureId newest_closure_ = 0;              // that was handed over
  std::vector<Stored> tracks_;                // as those of the graph
  std::map<ClosureId, StoredEdge> closures_;  // as the store has them
  std::deque<Write> pending_;                 // for which there was no room yet
};

}  // namespace pose_graph
