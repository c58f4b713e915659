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

/// Keeps a graph that grows in a store, and what was felt at its poses: hands what is new to a LiveWriter, which commits it once a second. Never waits for the
/// disk. What the disk does not take (it is full, say) stays in the graph, which has it anyway, and is handed over when there is
/// room: nothing is lost while the process lives, and no second copy grows.
///
/// Used by one thread at a time.
class Keeper {
 public:
  using StoredEdge = urban_nav_store::Edge;
  /// `store` must have no other user. `revision`: the highest that it has; those of the graph count on from there.
  Keeper(urban_nav_store::Store store, std::int64_t revision,
         std::chrono::milliseconds period = std::chrono::milliseconds(1000));

  /// A session of the graph has begun, goes on, or has ended (`complete`). Before its first node.
  void put(const urban_nav_store::Session& session,
           const std::vector<urban_nav_store::StoredParameter>& parameters = {});
  /// What its stage says of a closure.
  void putEvidence(const StoredEdge& edge, const std::string& evidence);
  /// A closure that its stage has rejected: kept with its reason, and no part of the graph.
  void putRejected(const StoredEdge& edge, const std::string& evidence);

  /// The chain of a track, as far as it is now, and a closure of the graph are in the store already.
  void knows(const PoseGraph& graph, std::size_t track);
  void knows(const Closure& closure);
  /// The next follow() is of another graph, whose revisions count on: what the store has stays there.
  void forget();
  /// Hands over what is new: nodes and closures each time; after a relaxation verdicts too, poses that it has moved by more than 1 cm
  /// or 0.02 deg from where the store has them (`exactly`: at all), and which map each session lies in.
  void follow(const PoseGraph& graph, bool exactly = false);
  /// The same at the end of something, every pose exactly. (follow() lets relaxations become one write while the last one waits for the
  /// disk.)
  void handOver(const PoseGraph& graph);
  /// Nothing that `graph` has is left to be handed over or committed.
  bool isUpToDate(const PoseGraph& graph) const;

  urban_nav_store::LiveWriter::Counts counts() const { return writer_->counts(); }
  /// Of rejected closures and evidence, which are nowhere else: how many there was no room for.
  std::int64_t lost() const { return lost_; }
  /// For who waits for it in another thread; whoever is last closes the store.
  std::shared_ptr<urban_nav_store::LiveWriter> writer() const { return writer_; }

 private:
  using Write = urban_nav_store::LiveWriter::Write;
  struct Kept {
    std::size_t nodes = 0, forces = 0;
    std::vector<Pose> map;  // where the store has the first poses; what follows follows odometry
  };
  struct Batch;
  bool post(Write write);
  void postLater(Write write);
  bool followPending();
  bool followNodes(const PoseGraph& graph);
  bool followForces(const PoseGraph& graph, bool at_once);
  void followRelaxation(const PoseGraph& graph, bool exactly, bool at_once);
  void takePoses(const PoseGraph& graph, bool exactly, Batch& batch);
  void takeClosures(const PoseGraph& graph, Batch& batch);

  std::shared_ptr<urban_nav_store::LiveWriter> writer_;
  const std::int64_t revision_;               // that the store had
  std::int64_t posted_ = 0, lost_ = 0;        // writes
  std::int64_t relaxation_ = 0;               // which of them was the last relaxation's
  std::int64_t followed_ = 0;                 // revision of the graph that it was of
  bool exact_ = true;                         // and it had every digit
  ClosureId newest_closure_ = 0;              // that was handed over
  std::vector<Kept> tracks_;                  // as those of the graph
  std::map<ClosureId, StoredEdge> closures_;  // as the store has them
  std::deque<Write> pending_;                 // for which there was no room yet
};

}  // namespace pose_graph
