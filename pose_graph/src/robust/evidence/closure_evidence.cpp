// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/closure_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include "linear/index.hpp"
#include "robust/evidence/chance_density.hpp"
#include "urban_nav_core/geometry/dense_kernels.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"

namespace pose_graph {

namespace {

constexpr int kAtOnce = 8;
// Correction of the inverse of a covariance estimated from kDisturbances samples (mean of an inverse Wishart matrix).
template <int D>
constexpr double kShrink =
    static_cast<double>(ClosureEvaluator<D>::kDisturbances - kTangentSize<D> - 1) / ClosureEvaluator<D>::kDisturbances;

template <int D>
using Eight = Eigen::Matrix<double, kTangentSize<D>, kAtOnce, Eigen::RowMajor>;

// Returns disturbances first...first + 7 of an edge: pseudorandom signs.
template <int D>
Eight<D> disturbances(std::size_t edge, int first) {
  Eight<D> made;
  for (int a = 0; a < kTangentSize<D>; ++a) {
    const std::uint64_t bits = scatteredBits(edge * sz(kTangentSize<D>) + sz(a)) >> first;
    for (int c = 0; c < kAtOnce; ++c) made(a, c) = static_cast<double>(static_cast<int>(2 * (bits >> c & 1)) - 1);
  }
  return made;
}

}  // namespace

template <int D>
ClosureEvaluator<D>::ClosureEvaluator(const Problem<D>& problem, const std::vector<int>& candidates,
                                      const DeadReckoning<D>& chains)
    : problem_(&problem), candidates_(candidates), edges_(whitened(problem.edges)) {
  false_log_.reserve(candidates.size());
  for (int e : candidates) {
    const WhitenedEdge<D>& edge = edges_[sz(e)];
    // A false closure is uniform over the region that odometry can have reached, with any heading.
    const double reach = chains.of_pose[sz(edge.from)] == chains.of_pose[sz(edge.to)]
                             ? std::abs(chains.way[sz(edge.to)] - chains.way[sz(edge.from)]) + edge.Z.t.norm()
                             : chains.extent;
    const double width = 2.0 * std::max(kLeastExtent, std::min(chains.extent, reach));
    double log = 0.0;
    for (int a = 0; a < edge.rank; ++a)
      log += 0.5 * std::log(edge.W.row(a).template head<D>().squaredNorm() * width * width +
                            edge.W.row(a).template tail<kRotationSize<D>>().squaredNorm() * 4.0 * M_PI * M_PI);
    false_log_.push_back(log);
    width_log_.push_back(D * std::log(width) + kRotationSize<D> * kLogTwoPi);
  }
}

template <int D>
std::vector<WhitenedJacobians<D>> ClosureEvaluator<D>::linearise(const std::vector<char>& in,
                                                                 const std::vector<Rigid<D>>& poses) const {
  std::vector<WhitenedJacobians<D>> at(edges_.size());
  std::vector<char> is_candidate(edges_.size(), 0);
  for (int e : candidates_) is_candidate[sz(e)] = 1;
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (in[e] || is_candidate[e])
      at[e] = whitenedJacobians(edges_[e], poses[sz(edges_[e].from)], poses[sz(edges_[e].to)]);
  return at;
}

template <int D>
std::vector<typename ClosureEvaluator<D>::Samples> ClosureEvaluator<D>::disturb(
    AcceptedGraph<D>& graph, const std::vector<char>& in, const std::vector<WhitenedJacobians<D>>& at) const {
  constexpr int kN = kTangentSize<D>;
  std::vector<Samples> moved(candidates_.size(), Samples::Zero());
  std::vector<double> x;
  const auto at_place = [&x](int place) { return x.data() + sz(place * kN * kAtOnce); };
  static const auto kernels = urban_nav_core::kernels::instructionSets().front();
  for (int first = 0; first < kDisturbances && graph.unknowns() > 0; first += kAtOnce) {
    x.assign(sz(graph.unknowns() * kN * kAtOnce), 0.0);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!in[e]) continue;
      const int from = graph.place(edges_[e].from), to = graph.place(edges_[e].to);
      const Eight<D> y = -disturbances<D>(e, first);
      if (from >= 0) kernels.subtractEight(at_place(from), kN, at[e].by_from.data(), kN, 1, y.data(), kN);
      if (to >= 0) kernels.subtractEight(at_place(to), kN, at[e].by_to.data(), kN, 1, y.data(), kN);
    }
    graph.solveEight(x.data());
    for (std::size_t k = 0; k < candidates_.size(); ++k) {
      const std::size_t e = sz(candidates_[k]);
      const int from = graph.place(edges_[e].from), to = graph.place(edges_[e].to);
      Eight<D> z = Eight<D>::Zero();
      if (in[e]) z = disturbances<D>(e, first);
      if (from >= 0) kernels.subtractEight(z.data(), kN, at[e].by_from.data(), 1, kN, at_place(from), kN);
      if (to >= 0) kernels.subtractEight(z.data(), kN, at[e].by_to.data(), 1, kN, at_place(to), kN);
      moved[k].template middleCols<kAtOnce>(first) = z;
    }
  }
  return moved;
}

template <int D>
void ClosureEvaluator<D>::evaluateOne(std::size_t k, bool inside, const WhitenedJacobians<D>& at, const Samples& moved,
                                      double uncontrolled, double own, Evidence& made) const {
  constexpr int kN = kTangentSize<D>;
  const std::size_t e = sz(candidates_[k]);
  const int rank = edges_[e].rank;
  TangentMatrix<D> C = moved.lazyProduct(moved.transpose()) / kDisturbances;
  for (int a = rank; a < kN; ++a) C(a, a) = 1.0;  // unmeasured direction: rows of W and the error are zero
  double log = false_log_[k] - 0.5 * rank * kLogTwoPi;
  if (inside) {
    // Let R be the covariance of the edge's residual. Outside the graph, its innovation would be R^-1 r with covariance
    // R^-1; with own variance `own`, R^-1 + (own - 1) I.
    log += 0.5 * std::log(std::max(1e-300, C.determinant()));
    if (own != 1.0) {
      const TangentMatrix<D> larger = TangentMatrix<D>::Identity() + (own - 1.0) * C;
      log += 0.5 * (kN - rank) * std::log(own) - 0.5 * std::log(larger.determinant());
    }
    C.diagonal().array() += uncontrolled;
    if (own != 1.0) C += (own - 1.0) * C.lazyProduct(C).eval();
    made.chi2[e] = at.error.dot(urban_nav_core::SmallCholesky<kN>(C).solve(at.error)) * kShrink<D> / made.variance;
  } else {
    C.topLeftCorner(rank, rank) /= kShrink<D>;
    C.diagonal().head(rank).array() += own;
    const urban_nav_core::SmallCholesky<kN> factored(C);
    made.chi2[e] = at.error.dot(factored.solve(at.error)) / made.variance;
    for (int a = 0; a < rank; ++a) log -= std::log(factored.factor()(a, a));
  }
  made.likelier[e] = logInlierLikelihood(log, rank, made.chi2[e] * made.variance, made.variance);
}

// One common bias of the group: a rigid displacement of its later ends.
template <int D>
void ClosureEvaluator<D>::evaluateGroup(const std::vector<std::size_t>& members, const std::vector<Rigid<D>>& poses,
                                        const std::vector<WhitenedJacobians<D>>& at, const std::vector<Samples>& moved,
                                        double uncontrolled, double own, Evidence& made) const {
  constexpr int kN = kTangentSize<D>;
  Samples spread = Samples::Zero();
  Tangent<D> sum = Tangent<D>::Zero();
  TangentMatrix<D> weight = TangentMatrix<D>::Zero();
  const WhitenedEdge<D>& head = edges_[sz(candidates_[members.front()])];
  const Eigen::Matrix<double, D, 1> middle = poses[sz(std::max(head.from, head.to))].t;
  for (std::size_t k : members) {
    const std::size_t e = sz(candidates_[k]);
    const bool forward = edges_[e].from < edges_[e].to;
    const Rigid<D>& end = poses[sz(forward ? edges_[e].to : edges_[e].from)];
    TangentMatrix<D> body = TangentMatrix<D>::Identity();
    body.template topRightCorner<D, kRotationSize<D>>() = turned(Eigen::Matrix<double, D, 1>(end.t - middle));
    const TangentMatrix<D> bias = (forward ? at[e].by_to : at[e].by_from) * body;
    spread.noalias() += bias.transpose() * moved[k];
    sum.noalias() += bias.transpose() * at[e].error;
    weight.noalias() += bias.transpose() * bias;
  }
  TangentMatrix<D> C = spread.lazyProduct(spread.transpose()) / kDisturbances + uncontrolled * weight;
  C.diagonal().array() += 1e-12 * std::max(1e-300, C.diagonal().maxCoeff());
  TangentMatrix<D> with_own = C;
  if (own != 1.0) {  // as for one closure; the inverse of `weight` takes the place of the unit covariance
    weight.diagonal().array() += 1e-12 * weight.diagonal().maxCoeff();
    with_own += (own - 1.0) * C.lazyProduct(urban_nav_core::SmallCholesky<kN>(weight).solve(C)).eval();
  }
  const double chi2 = sum.dot(urban_nav_core::SmallCholesky<kN>(with_own).solve(sum)) * kShrink<D> / made.variance;
  double width = 0.0;
  for (std::size_t k : members) width = std::max(width, width_log_[k]);
  const double log = width - 0.5 * kN * kLogTwoPi + 0.5 * std::log(std::max(1e-300, C.determinant()));
  for (std::size_t k : members) {
    made.group_chi2[sz(candidates_[k])] = std::isfinite(chi2) ? chi2 : 0.0;
    made.group_likelier[sz(candidates_[k])] = logInlierLikelihood(log, kN, chi2 * made.variance, made.variance);
  }
}

template <int D>
Evidence ClosureEvaluator<D>::evaluate(AcceptedGraph<D>& graph, const std::vector<char>& in,
                                       const std::vector<Rigid<D>>& poses, double variance,
                                       const std::vector<int>& small_group, double uncontrolled, double own) const {
  const std::size_t edges = problem_->edges.size();
  Evidence made;
  made.chi2.assign(edges, 0.0);
  made.group_chi2.assign(edges, 0.0);
  made.likelier.assign(edges, 0.0);
  made.group_likelier.assign(edges, 0.0);
  made.variance = variance;
  made.known = graph.factor(poses);
  if (!made.known) return made;

  const std::vector<WhitenedJacobians<D>> at = linearise(in, poses);
  const std::vector<Samples> moved = disturb(graph, in, at);
  std::map<int, std::vector<std::size_t>> groups;
  for (std::size_t k = 0; k < candidates_.size(); ++k) {
    const std::size_t e = sz(candidates_[k]);
    if (graph.component(edges_[e].from) != graph.component(edges_[e].to)) {
      made.chi2[e] = made.likelier[e] = std::numeric_limits<double>::infinity();
      made.likelier[e] *= -1.0;
      continue;
    }
    evaluateOne(k, in[e] != 0, at[e], moved[k], uncontrolled, own, made);
    if (in[e] && small_group[e] >= 0) groups[small_group[e]].push_back(k);
  }
  for (const auto& [name, members] : groups)
    if (members.size() > 1) evaluateGroup(members, poses, at, moved, uncontrolled, own, made);
  return made;
}

namespace {

constexpr double kAsStated = 0.05;  // share; with 0.01 or 0.2 the log density changes by less than 2

}  // namespace

double logInlierLikelihood(double log_at_zero, int rank, double chi2, double variance) {
  const double narrow = log_at_zero - 0.5 * rank * std::log(variance) - 0.5 * chi2 / variance;
  if (!(variance < 1.0)) return narrow;
  const double a = std::log(1.0 - kAsStated) + narrow, b = std::log(kAsStated) + log_at_zero - 0.5 * chi2;
  return std::max(a, b) + std::log1p(std::exp(-std::abs(a - b)));
}

template class ClosureEvaluator<2>;
template class ClosureEvaluator<3>;

}  // namespace pose_graph
