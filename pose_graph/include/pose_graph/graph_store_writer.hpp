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

/// Writes a growing graph to a store, with the specific force, ground normals and position fixes at its poses. New data
/// are passed to a LiveWriter, which commits once a second. Never blocks on the disk: data that cannot be written, for
/// example because the disk is full, stay in the graph and are written when possible, so nothing is lost while the
/// process lives and no second copy is kept. Not thread-safe.
class GraphStoreWriter {
 public:
  using StoredEdge = urban_nav_store::Edge;
  using LiveWriter = urban_nav_store::LiveWriter;

  /// Returns the options required for the constructor's `writer`.
  static LiveWriter::Options writerOptions(std::chrono::milliseconds period = std::chrono::milliseconds(1000));
  /// `revision`: the highest revision in the store; revisions of the graph are added to it.
  GraphStoreWriter(std::shared_ptr<LiveWriter> writer, std::int64_t revision);

  /// Writes a session that began, was resumed or has ended (`complete`). Required before its first node.
  void put(const urban_nav_store::Session& session,
           const std::vector<urban_nav_store::StoredParameter>& parameters = {});
  /// Writes the evidence text of the stage that measured a closure.
  void putEvidence(const StoredEdge& edge, const std::string& evidence);
  /// Writes a closure that its stage rejected: it is stored with its reason and is not part of the graph.
  void putRejected(const StoredEdge& edge, const std::string& evidence);

  /// Marks the present contents of a track as stored.
  void markStored(const PoseGraph& graph, std::size_t track);
  /// Marks a closure as stored.
  void markStored(const Closure& closure);
  /// Announces that the next sync() passes another graph, which continues the revision numbers. Stored data are kept.
  void reset();
  /// Writes new nodes and closures. After a relaxation, also writes verdicts, session anchors and the poses that differ
  /// from the stored ones by more than 1 cm or 0.02 deg (`exactly`: by any amount). While the disk is slow, several
  /// relaxations are combined in one write.
  void sync(const PoseGraph& graph, bool exactly = false);
  /// As sync() with all poses exact, without delay.
  void flush(const PoseGraph& graph);
  /// Returns whether all of `graph` has been committed.
  bool isUpToDate(const PoseGraph& graph) const;

  LiveWriter::Counts counts() const { return writer_->counts(); }
  /// Returns the number of rejected closures and evidence texts lost because the queue was full.
  std::int64_t lost() const { return lost_; }
  std::shared_ptr<LiveWriter> writer() const { return writer_; }

 private:
  using Write = LiveWriter::Write;
  struct Stored {
    std::size_t nodes = 0, forces = 0, ground = 0, fixes = 0;
    std::vector<Pose> map;  // stored map poses of the first nodes; later nodes are stored as odometry
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
  const std::int64_t revision_;               // highest revision in the store at construction
  std::int64_t posted_ = 0, lost_ = 0;        // numbers of writes
  std::int64_t relaxation_ = 0;               // number of the write of the last relaxation
  std::int64_t synced_revision_ = 0;          // revision of the graph in that write
  bool exact_ = true;                         // whether that write contained all poses exactly
  ClosureId newest_closure_ = 0;              // newest closure written
  std::vector<Stored> tracks_;                // per track of the graph
  std::map<ClosureId, StoredEdge> closures_;  // as stored
  std::deque<Write> pending_;                 // writes that did not fit into the queue yet
};

}  // namespace pose_graph
