// SPDX-License-Identifier: BSD-3-Clause
#include "pose_graph/false_priors.hpp"

#include <algorithm>
#include <map>

#include "linear/index.hpp"
#include "objective/whitened_edge.hpp"
#include "solve/accepted_graph.hpp"
#include "start/aligned.hpp"
#include "start/along_edges.hpp"

namespace pose_graph {

namespace {

// Limit of chi-square over degrees of freedom relative to the median, as for slips of odometry.
constexpr double kFalseSquare = 100.0;
constexpr double kTieBreak = 1.1;      // factor of the weight of the first edge in the first round
constexpr double kFitNarrowing = 4.0;  // divisor of the squared kernel width per round
constexpr int kFitStartSteps = 20, kFitSteps = 3, kFitLastRounds = 5;
constexpr double kFitStartShare = 1e-3, kFitShare = 1e-4;

template <int D>
struct TestedEdge {
  int edge = 0;
  int group = -1;  // the landmark; -1 for priors
  WhitenedEdge<D> whitened;

  double squareOverRank(const std::vector<Rigid<D>>& poses) const {
    return whitenedError(whitened, poses[sz(whitened.from)], poses[sz(whitened.to)]).squaredNorm() / whitened.rank;
  }
};

template <int D>
std::vector<TestedEdge<D>> collectTested(const FileProblem<D>& file) {
  std::vector<TestedEdge<D>> made;
  const auto add = [&](int e, int group) {
    TestedEdge<D> one{e, group, whitened(file.problem.edges[sz(e)])};
    if (one.whitened.rank > 0) made.push_back(one);
  };
  for (const int e : file.priors) add(e, -1);
  for (const int e : file.point_edges)
    if (file.roles[sz(e)] == EdgeRole::Asserted) add(e, file.problem.edges[sz(e)].to);
  return made;
}

template <int D>
double largestSquare(const std::vector<TestedEdge<D>>& tested, const std::vector<Rigid<D>>& poses) {
  double most = 0.0;
  for (const TestedEdge<D>& one : tested) most = std::max(most, one.squareOverRank(poses));
  return most;
}

template <int D>
double middleSquare(const std::vector<TestedEdge<D>>& tested, const std::vector<Rigid<D>>& poses) {
  std::vector<double> squares;
  for (const TestedEdge<D>& one : tested) squares.push_back(one.squareOverRank(poses));
  const auto at = squares.begin() + static_cast<std::ptrdiff_t>((squares.size() - 1) / 2);
  std::nth_element(squares.begin(), at, squares.end());
  return *at;
}

// Returns the poses that fit odometry and most of the priors; empty if least squares fit all of them.
template <int D>
std::vector<Rigid<D>> fitMost(const FileProblem<D>& file, const std::vector<TestedEdge<D>>& tested) {
  const Problem<D>& problem = file.problem;
  const std::vector<EdgeRole>& roles = file.roles;
  std::vector<char> in;
  Problem<D> part = problem.withoutEdges();
  for (std::size_t e = 0; e < roles.size(); ++e) {
    in.push_back(roles[e] != EdgeRole::Candidate && whitened(problem.edges[e]).rank > 0);
    if (in.back()) part.edges.push_back(problem.edges[e]);
  }
  std::vector<Rigid<D>> poses = posesAlongEdges(part);
  alignWithFixed(part, {}, poses);  // no other initial guess determines rotations from positions only
  AcceptedGraph<D> graph(problem);
  std::vector<double> weights(in.begin(), in.end());
  graph.take(in, weights);
  graph.relax(poses, kFitStartSteps, kFitStartShare, true);
  const bool all_fit = std::all_of(tested.begin(), tested.end(),
                                   [&](const TestedEdge<D>& one) { return one.squareOverRank(poses) <= kFalseSquare; });
  if (all_fit) return {};
  int last = 0;
  bool is_first = true;
  for (double width = largestSquare(tested, poses); last < kFitLastRounds;
       width = std::max(1.0, width / kFitNarrowing)) {
    last += width <= 1.0;
    for (const TestedEdge<D>& one : tested) weights[sz(one.edge)] = 1.0 / (1.0 + one.squareOverRank(poses) / width);
    // Two measurements that contradict each other equally would share the error indefinitely.
    if (is_first) weights[sz(tested.front().edge)] *= kTieBreak;
    is_first = false;
    alignWithFixed(problem, weights, poses);
    graph.take(in, weights);
    graph.relax(poses, kFitSteps, kFitShare, false);
  }
  return poses;
}

}  // namespace

template <int D>
FalsePriors findFalsePriors(const FileProblem<D>& file) {
  FalsePriors made;
  const std::vector<TestedEdge<D>> tested = collectTested(file);
  if (tested.empty()) return made;
  const std::vector<Rigid<D>> poses = fitMost(file, tested);
  if (poses.empty()) return made;
  const double scale = std::max(1.0, middleSquare(tested, poses));
  struct Group {
    std::size_t all = 0;
    std::vector<int> off;
  };
  std::map<int, Group> groups;
  for (const TestedEdge<D>& one : tested) {
    Group& group = groups[one.group];
    ++group.all;
    if (one.squareOverRank(poses) > scale * kFalseSquare) group.off.push_back(one.edge);
  }
  for (const auto& [name, group] : groups) {
    const std::size_t observations = group.all + (name >= 0);  // including the first observation
    if (2 * group.off.size() < observations)
      made.rejected.insert(made.rejected.end(), group.off.begin(), group.off.end());
    else made.undecided += group.off.size();
  }
  std::sort(made.rejected.begin(), made.rejected.end());
  return made;
}

template FalsePriors findFalsePriors<2>(const FileProblem<2>&);
template FalsePriors findFalsePriors<3>(const FileProblem<3>&);

}  // namespace pose_graph
