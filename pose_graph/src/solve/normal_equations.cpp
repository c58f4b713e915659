// SPDX-License-Identifier: BSD-3-Clause
#include "solve/normal_equations.hpp"

#include <Eigen/Core>

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "urban_nav_core/parallel/for_each.hpp"

namespace pose_graph {

namespace {

template <int D>
Adjacency adjacencyOfUnknowns(const Problem<D>& problem, const Unknowns& unknowns) {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(problem.edges.size());
  for (const Edge<D>& edge : problem.edges)
    pairs.emplace_back(unknowns.of_pose[sz(edge.from)], unknowns.of_pose[sz(edge.to)]);
  return makeAdjacency(static_cast<int>(unknowns.pose.size()), pairs);
}

// T = [I, turned(d); 0, I] of EdgeQuadratic: K T and T^T K by blocks.
template <int D>
TangentMatrix<D> timesT(const TangentMatrix<D>& K, const Eigen::Matrix<double, D, kRotationSize<D>>& turn) {
  TangentMatrix<D> made = K;
  made.template rightCols<kRotationSize<D>>().noalias() += K.template leftCols<D>() * turn;
  return made;
}
template <int D>
TangentMatrix<D> transposedTimes(const Eigen::Matrix<double, D, kRotationSize<D>>& turn, const TangentMatrix<D>& K) {
  TangentMatrix<D> made = K;
  made.template bottomRows<kRotationSize<D>>().noalias() += turn.transpose() * K.template topRows<D>();
  return made;
}

constexpr double kHardlyMore = 1.25;      // limit of the work relative to that of the stored order
constexpr std::size_t kEdgeGrain = 4096;  // edges summed per thread; fewer do not justify another thread

}  // namespace

template <int D>
Unknowns makeUnknowns(const Problem<D>& problem) {
  const int n = static_cast<int>(problem.poses.size());
  DisjointSets components(sz(n));
  for (const Edge<D>& edge : problem.edges) components.join(edge.from, edge.to);
  components.joinAll(problem.fixed);
  Unknowns unknowns;
  unknowns.of_pose.assign(sz(n), 0);
  unknowns.component.assign(sz(n), 0);
  for (int i = 0; i < n; ++i) {
    const int root = components.root(i);  // first pose of its component
    if (root == i) {
      unknowns.component[sz(i)] = unknowns.components++;
      unknowns.origin.push_back(i);
    } else {
      unknowns.component[sz(i)] = unknowns.component[sz(root)];
    }
  }
  if (!problem.fixed.empty())
    unknowns.origin[sz(unknowns.component[sz(problem.fixed.front())])] = problem.fixed.front();
  for (const int i : unknowns.origin) unknowns.of_pose[sz(i)] = -1;
  for (const int i : problem.fixed) unknowns.of_pose[sz(i)] = -1;
  for (int i = 0; i < n; ++i) {
    if (unknowns.of_pose[sz(i)] < 0) continue;
    unknowns.of_pose[sz(i)] = static_cast<int>(unknowns.pose.size());
    unknowns.pose.push_back(i);
  }
  return unknowns;
}

template <int D>
Symbolic NormalEquations<D>::analyseAfter(const NormalEquations* before) {
  // Without the removed edges another order may be much cheaper.
  if (before && before->unknowns_.pose == unknowns_.pose && graph_.neighbours.size() >= before->ordered_.neighbours) {
    ordered_ = before->ordered_;
    Symbolic made = analyse(graph_, before->symbolic_.node);
    if (made.work <= kHardlyMore * ordered_.work) return made;
  }
  Symbolic made = analyse(graph_);
  ordered_ = {graph_.neighbours.size(), made.work};
  return made;
}

template <int D>
NormalEquations<D>::NormalEquations(const Problem<D>& problem, const NormalEquations* before)
    : unknowns_(makeUnknowns(problem)),
      graph_(adjacencyOfUnknowns(problem, unknowns_)),
      symbolic_(analyseAfter(before)),
      pattern_(graph_, symbolic_) {
  terms_.reserve(problem.edges.size());
  places_.reserve(problem.edges.size());
  for (const Edge<D>& edge : problem.edges) {
    terms_.push_back(makeTerm(edge));
    const int from = unknowns_.of_pose[sz(edge.from)], to = unknowns_.of_pose[sz(edge.to)];
    EdgePlace place;
    if (from >= 0) place.from = symbolic_.place[sz(from)];
    if (to >= 0) place.to = symbolic_.place[sz(to)];
    if (from >= 0 && to >= 0) place.slot = pattern_.slot(from, to);
    places_.push_back(place);
  }
}

template <int D>
void NormalEquations<D>::renew(const Problem<D>& problem, std::size_t first) {
  for (std::size_t e = first; e < terms_.size(); ++e) terms_[e] = makeTerm(problem.edges[e]);
}

template <int D>
template <Objective objective>
double NormalEquations<D>::lineariseAs(const std::vector<Rigid<D>>& poses, const std::vector<double>& weights) {
  H_.setZero(pattern_);
  g_.assign(unknowns_.pose.size() * kN, 0.0);
  double total = 0.0;
  for (std::size_t e = 0; e < terms_.size(); ++e) {
    const double weight = weights.empty() ? 1.0 : weights[e];
    if (weight == 0.0) continue;
    const EdgeTerm<D>& term = terms_[e];
    const EdgePlace& place = places_[e];
    EdgeQuadratic<D> quadratic = edgeQuadratic<objective, D>(term, poses[sz(term.from)], poses[sz(term.to)]);
    if (weight != 1.0) {
      quadratic.cost *= weight;
      quadratic.g_to *= weight;
      quadratic.K *= weight;
    }
    total += quadratic.cost;
    const Eigen::Matrix<double, D, kRotationSize<D>> turn = turned(quadratic.d);
    if (place.to >= 0) {
      H_.diagonal[sz(place.to)] += quadratic.K;
      Eigen::Map<Tangent<D>>(g_.data() + sz(place.to) * kN) += quadratic.g_to;
    }
    if (place.from >= 0) {
      const TangentMatrix<D> TK = transposedTimes<D>(turn, quadratic.K);
      H_.diagonal[sz(place.from)] += timesT<D>(TK, turn);
      Tangent<D> g = quadratic.g_to;
      g.template tail<kRotationSize<D>>().noalias() += turn.transpose() * quadratic.g_to.template head<D>();
      Eigen::Map<Tangent<D>>(g_.data() + sz(place.from) * kN) -= g;
      if (place.to >= 0) {
        auto& block = H_.lower[sz(place.slot.index)];
        // The block of row `from` and column `to` is -T^T K; with slot.turned it is stored as (to, from).
        if (place.slot.turned) block -= TK.transpose();
        else block -= TK;
      }
    }
  }
  return total;
}

template <int D>
template <Objective objective>
double NormalEquations<D>::costAs(const std::vector<Rigid<D>>& poses, const std::vector<double>& weights) const {
  return urban_nav_core::sumInOrder(terms_.size(), kEdgeGrain, 0.0, [&](std::size_t e) {
    const double weight = weights.empty() ? 1.0 : weights[e];
    const EdgeTerm<D>& term = terms_[e];
    return weight == 0.0 ? 0.0 : weight * edgeCost<objective, D>(term, poses[sz(term.from)], poses[sz(term.to)]);
  });
}

template <int D>
double NormalEquations<D>::linearise(Objective objective, const std::vector<Rigid<D>>& poses,
                                     const std::vector<double>& weights) {
  switch (objective) {
    case Objective::Geodesic: return lineariseAs<Objective::Geodesic>(poses, weights);
    case Objective::Chordal: return lineariseAs<Objective::Chordal>(poses, weights);
    case Objective::G2o: return lineariseAs<Objective::G2o>(poses, weights);
  }
  return 0.0;
}

template <int D>
double NormalEquations<D>::cost(Objective objective, const std::vector<Rigid<D>>& poses,
                                const std::vector<double>& weights) const {
  switch (objective) {
    case Objective::Geodesic: return costAs<Objective::Geodesic>(poses, weights);
    case Objective::Chordal: return costAs<Objective::Chordal>(poses, weights);
    case Objective::G2o: return costAs<Objective::G2o>(poses, weights);
  }
  return 0.0;
}

template Unknowns makeUnknowns<2>(const Problem<2>&);
template Unknowns makeUnknowns<3>(const Problem<3>&);
template class NormalEquations<2>;
template class NormalEquations<3>;

}  // namespace pose_graph
