// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "incremental/incremental_chain.hpp"
#include "pose_graph/solution.hpp"

namespace pose_graph {

/// What the live core reads of the graph around it. Steps are never changed once they are there; each track has one
/// less than poses.
class GraphView {
 public:
  virtual ~GraphView() = default;
  virtual std::size_t tracks() const = 0;
  virtual const ChainStep* steps(std::size_t track) const = 0;
  /// T_map_pose as last written, its rotation proper to the last digits.
  virtual Rigid<3> pose(const NodeIndex& place) const = 0;
  /// The first and the last pose of the unbroken run that a pose lies in.
  virtual std::pair<std::size_t, std::size_t> run(const NodeIndex& place) const = 0;
  virtual void write(const NodeIndex& place, const Rigid<3>& T_map_pose) = 0;
};

/// The graph condensed to the ends of its closures (condense/condensed.hpp), kept relaxed while odometry grows and
/// closures come one at a time. A closure more splits the chains that it ends in; the core is relaxed from where it
/// stands; a chain is laid anew only once its ends have moved against each other by a hundredth of its standard
/// deviation. So an update costs what the core costs, and the chains that bend.
class IncrementalSolver {
 public:
  /// Takes closure_edges that are accepted. Poses begin as they are written. `variance`: factor of the covariances of
  /// all steps.
  IncrementalSolver(const GraphView& view, const std::vector<ClosureEdge>& closure_edges, int iterations,
                    double variance = 1.0);

  /// What relaxing with one closure_edge more came to.
  struct Offer {
    double cost = 0.0;        ///< of all that is relaxed, the closure_edge included
    double innovation = 0.0;  ///< by how much the closure_edge raises it
    double before = 0.0;      ///< the cost where the poses stood
  };
  /// Relaxes with this closure_edge too, on trial: further ones may be offered beside it. Gives up where already the
  /// linear prediction of its innovation is `hopeless`; readmitByTruncatedSquares() follows then.
  Offer offer(const GraphView& view, const ClosureEdge& closure_edge, double hopeless);
  /// All that are on trial stay.
  void keep();
  /// The last one that is on trial goes, and everything is where it was before.
  void readmitByTruncatedSquares();
  /// T_map_pose with all that is accepted or on trial.
  Rigid<3> pose(const GraphView& view, const NodeIndex& place) const;

  double cost() const { return cost_; }
  const std::vector<Iteration>& iterations() const { return iterations_; }
  Ending ending() const { return ending_; }
  /// As Solution::gradient, of the core.
  double gradient() const { return gradient_; }

  /// Writes where the poses are now: those that moved by more than a tenth of what is reported, and the end of
  /// each track.
  void write(GraphView& view);

 private:
  struct Node {
    Rigid<3> pose;
    IncrementalChain onward;              ///< to the next node of the track; empty: a single step, or none
    Rigid<3> written;                     ///< `pose` when what follows was written
    double bent_m = 0.0, bent_rad = 0.0;  ///< by how much the chain was laid otherwise since then
    bool is_written = false;
    int number = 0;  ///< in the core

    bool leadsOn(const ChainStep* steps, std::size_t index, std::size_t next) const {
      return !onward.empty() || (next == index + 1 && steps[index].joins);
    }
  };
  using Nodes = std::map<std::size_t, Node>;

  void insert(const GraphView& view, const NodeIndex& place);
  void layChains(const GraphView& view, std::size_t track, std::size_t first, std::size_t last);
  Rigid<3> hangingAt(const GraphView& view, const NodeIndex& node, const NodeIndex& place) const;
  void remember(const NodeIndex& place);
  void number();
  void bringTogether(const GraphView& view, const ClosureEdge& closure_edge);
  void relax(const GraphView& view, double hopeless);
  struct Core;
  Core core(const GraphView& view);
  bool layBent(const GraphView& view, Core& core);
  void writeFrom(GraphView& view, std::size_t track, Nodes::iterator at);

  int steps_at_most_;
  double variance_;
  std::vector<Nodes> nodes_;  ///< of each track, by their numbers in there
  std::vector<ClosureEdge> closure_edges_;
  double cost_ = 0.0, cost_before_ = 0.0;
  std::vector<Iteration> iterations_;
  Ending ending_ = Ending::Converged;
  double gradient_ = 0.0;

  /// How to take an offer back: to where its predecessors on trial had brought things.
  struct Undo {
    std::map<NodeIndex, std::optional<Node>> nodes;  ///< as they were; empty: there was none
    std::vector<Rigid<3>> poses;                     ///< of the nodes in the core's order, those inserted included
    double cost = 0.0;
    Ending ending = Ending::Converged;
    double gradient = 0.0;
  };
  std::vector<Undo> undo_;  ///< of those on trial, in the order of the offers
};

}  // namespace pose_graph
