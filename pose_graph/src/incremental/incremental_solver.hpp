// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "incremental/incremental_chain.hpp"
#include "pose_graph/solution.hpp"

namespace pose_graph {

/// Interface of IncrementalSolver to the graph. Existing steps never change; each track has one step less than poses.
class GraphView {
 public:
  virtual ~GraphView() = default;
  virtual std::size_t tracks() const = 0;
  virtual const ChainStep* steps(std::size_t track) const = 0;
  /// Returns T_map_pose as written last; its rotation is proper to the last digits.
  virtual Rigid<3> pose(const NodeIndex& place) const = 0;
  /// Returns the first and the last pose of the unbroken run that contains a pose.
  virtual std::pair<std::size_t, std::size_t> run(const NodeIndex& place) const = 0;
  virtual void write(const NodeIndex& place, const Rigid<3>& T_map_pose) = 0;
};

/// The graph condensed to the ends of its closures (condense/condensed.hpp), kept relaxed while odometry grows and
/// closures arrive one at a time. A new closure splits the chains that it ends in, and the core is relaxed from its
/// present poses. A chain is updated only if its ends have moved relative to each other by a hundredth of its standard
/// deviation. An update therefore takes the time of the core and of the chains that bend.
class IncrementalSolver {
 public:
  /// `closure_edges`: accepted closures. The poses begin as written in `view`. `variance`: factor of the covariances of
  /// all steps.
  IncrementalSolver(const GraphView& view, const std::vector<ClosureEdge>& closure_edges, int iterations,
                    double variance = 1.0);

  /// Result of a relaxation with one more closure.
  struct Offer {
    double cost = 0.0;        ///< total cost, including the closure
    double innovation = 0.0;  ///< increase of the cost by the closure
    double before = 0.0;      ///< cost of the initial poses
  };
  /// Relaxes with one more closure, on trial; further closures may be offered meanwhile. Aborts if the linear
  /// prediction of its innovation exceeds `hopeless`; the caller must then call withdraw().
  Offer offer(const GraphView& view, const ClosureEdge& closure_edge, double hopeless);
  /// Accepts all closures on trial.
  void keep();
  /// Withdraws the last closure on trial and restores the state before its offer.
  void withdraw();
  /// Returns T_map_pose with all closures accepted or on trial.
  Rigid<3> pose(const GraphView& view, const NodeIndex& place) const;

  double cost() const { return cost_; }
  const std::vector<Iteration>& iterations() const { return iterations_; }
  Ending ending() const { return ending_; }
  /// Gradient norm of the core, as in Solution::gradient.
  double gradient() const { return gradient_; }

  /// Writes the present poses: those that moved by more than a tenth of the reporting threshold, and the end of each
  /// track.
  void write(GraphView& view);

 private:
  struct Node {
    Rigid<3> pose;
    IncrementalChain onward;              ///< chain to the next node of the track; empty: a single step, or none
    Rigid<3> written;                     ///< `pose` when the poses after it were last written
    double bent_m = 0.0, bent_rad = 0.0;  ///< accumulated change of the chain since then
    bool is_written = false;
    int number = 0;  ///< index in the core

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
  std::vector<Nodes> nodes_;  ///< per track, by pose index
  std::vector<ClosureEdge> closure_edges_;
  double cost_ = 0.0, cost_before_ = 0.0;
  std::vector<Iteration> iterations_;
  Ending ending_ = Ending::Converged;
  double gradient_ = 0.0;

  /// State before an offer, to restore it when the offer is withdrawn.
  struct Undo {
    /// Previous values of changed nodes; empty: the node did not exist.
    std::map<NodeIndex, std::optional<Node>> nodes;
    std::vector<Rigid<3>> poses;  ///< poses of all nodes in the order of the core, including inserted ones
    double cost = 0.0;
    Ending ending = Ending::Converged;
    double gradient = 0.0;
  };
  std::vector<Undo> undo_;  ///< of the closures on trial, in the order of the offers
};

}  // namespace pose_graph
