// SPDX-License-Identifier: BSD-3-Clause
#include "robust/generators/slips.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "objective/whitened_edge.hpp"
#include "robust/evidence/chance_density.hpp"
#include "robust/evidence/closure_loops.hpp"
#include "robust/evidence/variances.hpp"
#include "solve/accepted_graph.hpp"

namespace pose_graph {

namespace {

// Work of all rounds, in multiplications: thousands of false closures that agree with each other make the factor dense,
// and a hundred rounds would take minutes.
constexpr double kCauchyWork = 2e11;
constexpr int kFewestCauchyRounds = 12, kMostCauchyRounds = 100;
constexpr std::size_t kMostSlips = 20;
// A step stands out if the distance to its few most similar steps exceeds, by this factor, that of every other step
// that would explain the slip equally well.
constexpr std::size_t kSimilarSteps = 3;
constexpr double kStandsOut = 4.0;       // of squared distances
constexpr double kAcceptedWeight = 0.5;  // weight under Cauchy's kernel above which a closure counts as accepted
constexpr int kSlipReach = 200;          // search range around the step where a slip appears, in poses
constexpr int kDownweightedRounds = 5;   // rounds until closures that span a down-weighted step agree
constexpr double kDownweightedWeight = 1e-9;

/// Steps of odometry between consecutive poses. The graph constrains a slip only by the closures that span it: all
/// steps spanned by the same closures, adjacent or not, explain it equally well.
template <int D>
class Steps {
 public:
  Steps(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<WhitenedEdge<D>>& whitened,
        const std::vector<double>& weights)
      : problem_(problem), whitened_(whitened), into_(problem.poses.size(), -1), spanned_(problem.poses.size(), 0) {
    for (std::size_t e = 0; e < roles.size(); ++e) {
      const auto [first, last] = std::minmax(problem.edges[e].from, problem.edges[e].to);
      if (roles[e] != EdgeRole::Candidate) {
        if (last == first + 1 && into_[sz(last)] < 0) into_[sz(last)] = static_cast<int>(e);
      } else if (weights[e] > kAcceptedWeight) {
        // A closure contributes its number to the sums of the steps from its first pose to its last.
        const std::uint64_t number = scatteredBits(e);
        for (const int end : {first, last})
          if (end + 1 < static_cast<int>(spanned_.size())) spanned_[sz(end + 1)] ^= number;
      }
    }
    for (std::size_t i = 1; i < spanned_.size(); ++i) spanned_[i] ^= spanned_[i - 1];
  }

  /// Returns the step that clearly differs most from all others, among those spanned by the same closures as e;
  /// otherwise e.
  int mostDistinct(int e) const {
    const int at = std::max(problem_.edges[sz(e)].from, problem_.edges[sz(e)].to);
    if (into_[sz(at)] != e) return e;
    int best = e;
    double most = 0.0, second = 0.0;
    const auto compare = [&](int pose) {
      if (spanned_[sz(pose)] != spanned_[sz(at)]) return;
      const double square = distanceToSimilar(into_[sz(pose)]);
      if (square > most) {
        second = most;
        most = square;
        best = into_[sz(pose)];
      } else {
        second = std::max(second, square);
      }
    };
    const int poses = static_cast<int>(into_.size());
    for (int pose = at; pose > 0 && into_[sz(pose)] >= 0 && pose > at - kSlipReach; --pose) compare(pose);
    for (int pose = at + 1; pose < poses && into_[sz(pose)] >= 0 && pose < at + kSlipReach; ++pose) compare(pose);
    return most > kStandsOut * second ? best : e;
  }

  /// Returns T_from_to of `f` if `f` slipped instead of e, with the poses between the two moved rigidly.
  Rigid<D> motionInstead(int f, int e, const std::vector<Rigid<D>>& poses) const {
    const auto ends = [&](int edge) { return std::minmax(problem_.edges[sz(edge)].from, problem_.edges[sz(edge)].to); };
    const auto [e_from, e_to] = ends(e);
    const auto [f_from, f_to] = ends(f);
    Rigid<D> from = poses[sz(f_from)], to = poses[sz(f_to)];
    if (f_from > e_from) from = poses[sz(e_from)] * forward(e) * (poses[sz(e_to)].inverse() * from);
    if (f_from < e_from) to = poses[sz(e_to)] * forward(e).inverse() * (poses[sz(e_from)].inverse() * to);
    const Rigid<D> motion = from.inverse() * to;
    return problem_.edges[sz(f)].from < problem_.edges[sz(f)].to ? motion : motion.inverse();
  }

 private:
  Rigid<D> forward(int e) const {
    const Edge<D>& edge = problem_.edges[sz(e)];
    return edge.from < edge.to ? edge.Z : edge.Z.inverse();
  }

  // Squared Mahalanobis distance to the kSimilarSteps-th nearest other step.
  double distanceToSimilar(int e) const {
    const Rigid<D> own = forward(e);
    std::vector<double> squares;
    for (const int other : into_) {
      if (other < 0 || other == e) continue;
      const Rigid<D> difference = own.inverse() * forward(other);
      Tangent<D> d;
      d.template head<D>() = difference.t;
      d.template tail<kRotationSize<D>>() = logRotation(difference.R);
      squares.push_back((whitened_[sz(e)].W * d).squaredNorm());
    }
    if (squares.size() < kSimilarSteps) return 0.0;
    std::nth_element(squares.begin(), squares.begin() + kSimilarSteps - 1, squares.end());
    return squares[kSimilarSteps - 1];
  }

  const Problem<D>& problem_;
  const std::vector<WhitenedEdge<D>>& whitened_;
  std::vector<int> into_;  // step that ends at a pose; -1 if none
  // By the end of a step: exclusive or of the numbers of the closures that span it.
  std::vector<std::uint64_t> spanned_;
};

// Returns chi-square over its degrees of freedom.
template <int D>
double squareOver(const WhitenedEdge<D>& edge, const std::vector<Rigid<D>>& poses) {
  return whitenedError(edge, poses[sz(edge.from)], poses[sz(edge.to)]).squaredNorm() / std::max(1, edge.rank);
}

// Returns `least` times the median of all steps.
template <int D>
double slipLimit(double least, const std::vector<EdgeRole>& roles, const std::vector<WhitenedEdge<D>>& edges,
                 const std::vector<Rigid<D>>& poses) {
  std::vector<double> squares;
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (roles[e] == EdgeRole::Trusted && edges[e].rank > 0) squares.push_back(squareOver(edges[e], poses));
  if (squares.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return least * std::max(1.0, *middle);
}

// Returns by pose the excess of rejected over accepted closures that span the step to the next pose.
template <int D>
std::vector<int> countContradicting(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                    const std::vector<char>& in, const std::vector<char>& considered) {
  std::vector<int> against(problem.poses.size() + 1, 0);
  for (std::size_t e = 0; e < in.size(); ++e) {
    if (roles[e] != EdgeRole::Candidate || !considered[e]) continue;
    const auto [first, last] = std::minmax(problem.edges[e].from, problem.edges[e].to);
    against[sz(first)] += in[e] ? -1 : 1;
    against[sz(last)] -= in[e] ? -1 : 1;
  }
  for (std::size_t i = 1; i < against.size(); ++i) against[i] += against[i - 1];
  return against;
}

// Steps spanned by at least two more rows of closures outside the set than inside, and one closure of each outside row
// over any of these steps. If a step slipped, two of these closures must be consistent.
template <int D>
struct ContradictingRows {
  std::vector<int> closures;
  std::vector<char> contradicted;  // the step from each pose to the next

  ContradictingRows(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
                    const std::vector<char>& considered, const std::vector<int>& row) {
    std::map<int, int> inside, outside;
    for (std::size_t e = 0; e < in.size(); ++e)
      if (roles[e] == EdgeRole::Candidate && considered[e]) (in[e] ? inside : outside).emplace(row[e], e);
    std::vector<int> against(problem.poses.size() + 1, 0);
    const auto span = [&](int e, int sign) {
      const auto [first, last] = std::minmax(problem.edges[sz(e)].from, problem.edges[sz(e)].to);
      against[sz(first)] += sign;
      against[sz(last)] -= sign;
    };
    for (const auto& [name, e] : inside) span(e, -1);
    for (const auto& [name, e] : outside)
      if (!inside.count(name)) span(e, 1);
    for (std::size_t i = 1; i < against.size(); ++i) against[i] += against[i - 1];
    for (const int more : against) contradicted.push_back(more >= static_cast<int>(Thresholds::kLeastAgreeing));
    std::vector<int> before(contradicted.size() + 1, 0);  // number of such steps before a pose
    for (std::size_t i = 0; i < contradicted.size(); ++i) before[i + 1] = before[i] + contradicted[i];
    for (const auto& [name, e] : outside) {
      const auto [first, last] = std::minmax(problem.edges[sz(e)].from, problem.edges[sz(e)].to);
      if (!inside.count(name) && before[sz(last)] > before[sz(first)]) closures.push_back(e);
    }
  }

  bool shareStep(const Edge<D>& a, const Edge<D>& b) const {
    const int first = std::max(std::min(a.from, a.to), std::min(b.from, b.to));
    const int last = std::min(std::max(a.from, a.to), std::max(b.from, b.to));
    for (int i = first; i < last; ++i)
      if (contradicted[sz(i)]) return true;
    return false;
  }
};

// Returns whether any two closures over one step are consistent. Their loop does not include the step: if it slipped,
// they still agree on the relative pose of its two sides, within the accuracy of the other edges.
template <int D>
bool anyAgree(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const ContradictingRows<D>& rows,
              const std::vector<Rigid<D>>& poses) {
  DeadReckoning<D> known(problem, roles);
  known.pose = poses;
  known.Q.assign(poses.size(), TangentMatrix<D>::Zero());
  const ClosureLoops<D> loops(problem, rows.closures, known);
  for (std::size_t a = 0; a < loops.size(); ++a)
    for (std::size_t b = a + 1; b < loops.size(); ++b)
      if (rows.shareStep(problem.edges[sz(loops.edge(a))], problem.edges[sz(loops.edge(b))]) &&
          loops.loop(a, b).chi2 <= kFarFactor)
        return true;
  return false;
}

}  // namespace

template <int D>
bool maySlip(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
             const std::vector<char>& considered, const std::vector<int>& row, const std::vector<Rigid<D>>& poses) {
  const std::vector<WhitenedEdge<D>> edges = whitened(problem.edges);
  const double limit = slipLimit(kLooseFactor, roles, edges, poses);
  for (std::size_t e = 0; e < in.size(); ++e)
    if (roles[e] == EdgeRole::Trusted && squareOver(edges[e], poses) > limit) return true;
  return anyAgree(problem, roles, ContradictingRows<D>(problem, roles, in, considered, row), poses);
}

template <int D>
std::vector<char> mostContradicted(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                                   const std::vector<char>& in, const std::vector<char>& considered) {
  const std::vector<int> against = countContradicting(problem, roles, in, considered);
  const int most = *std::max_element(against.begin(), against.end());
  std::vector<char> made;
  if (most < static_cast<int>(Thresholds::kLeastAgreeing)) return made;
  for (std::size_t e = 0; e < roles.size(); ++e) {
    const auto [first, last] = std::minmax(problem.edges[e].from, problem.edges[e].to);
    made.push_back(roles[e] == EdgeRole::Trusted && last == first + 1 && against[sz(first)] == most);
  }
  return made;
}

template <int D>
std::vector<Slip<D>> findSlips(const Problem<D>& problem, const std::vector<EdgeRole>& roles,
                               const std::vector<char>& considered, const std::vector<char>& weighted_down,
                               const std::vector<Rigid<D>>& odometry) {
  const std::vector<WhitenedEdge<D>> edges = whitened(problem.edges);
  std::vector<char> in;
  for (std::size_t e = 0; e < edges.size(); ++e)
    in.push_back(edges[e].rank > 0 && (roles[e] != EdgeRole::Candidate || considered[e]));
  std::vector<Rigid<D>> poses = odometry;
  std::vector<double> weights(edges.size(), 1.0);
  AcceptedGraph<D> graph(problem);
  double last = 0.0;
  const double work = graph.work(in) * std::pow(kTangentSize<D>, 3);
  const int rounds =
      static_cast<int>(std::clamp<double>(kCauchyWork / std::max(1.0, work), kFewestCauchyRounds, kMostCauchyRounds));
  for (int round = 0; round < rounds; ++round) {
    const bool is_downweighted = round < kDownweightedRounds && !weighted_down.empty();
    double cost = 0.0;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      weights[e] = 0.0;
      if (!in[e]) continue;
      const double square = squareOver(edges[e], poses);
      weights[e] = is_downweighted && weighted_down[e] ? kDownweightedWeight : 1.0 / (1.0 + square);
      cost += std::log1p(square);
    }
    if (round > 0 && !is_downweighted && std::abs(last - cost) <= kEndShare * cost) break;
    last = cost;
    graph.take(in, weights);
    graph.relax(poses, 1, 0.0, false);
  }
  std::vector<Slip<D>> made;
  const double limit = slipLimit(kFarFactor, roles, edges, poses);
  const Steps<D> steps(problem, roles, edges, weights);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (roles[e] != EdgeRole::Trusted || !(squareOver(edges[e], poses) > limit)) continue;
    const int likeliest = steps.mostDistinct(static_cast<int>(e));
    if (std::any_of(made.begin(), made.end(), [&](const Slip<D>& slip) { return slip.edge == likeliest; })) continue;
    made.push_back({likeliest, steps.motionInstead(likeliest, static_cast<int>(e), poses)});
  }
  if (made.size() > kMostSlips) made.clear();  // odometry as a whole does not have the stated accuracy
  return made;
}

template <int D>
bool joinEndsWithoutAnyRow(const Problem<D>& problem, const std::vector<EdgeRole>& roles, const std::vector<char>& in,
                           const std::vector<int>& row, const std::vector<Slip<D>>& slips) {
  if (slips.empty()) return true;
  DisjointSets joined(problem.poses.size());
  joined.joinAll(problem.fixed);
  for (std::size_t e = 0; e < in.size(); ++e)
    if (roles[e] != EdgeRole::Candidate && in[e]) joined.join(problem.edges[e].from, problem.edges[e].to);
  // Two rows between two sections suffice: without one of them another one remains.
  std::map<std::pair<int, int>, std::set<int>> rows;
  for (std::size_t e = 0; e < in.size(); ++e) {
    const int a = joined.root(problem.edges[e].from), b = joined.root(problem.edges[e].to);
    if (a == b || roles[e] != EdgeRole::Candidate || !in[e]) continue;
    std::set<int>& between = rows[std::minmax(a, b)];
    if (between.size() < Thresholds::kLeastAgreeing) between.insert(row[e]);
  }
  std::set<int> all = {-1};  // no row removed
  for (const auto& [stretches, between] : rows) all.insert(between.begin(), between.end());
  return std::all_of(all.begin(), all.end(), [&](int one) {
    DisjointSets without = joined;
    for (const auto& [stretches, between] : rows)
      if (between.size() > between.count(one)) without.join(stretches.first, stretches.second);
    return std::all_of(slips.begin(), slips.end(), [&](const Slip<D>& slip) {
      const Edge<D>& edge = problem.edges[sz(slip.edge)];
      return without.areJoined(edge.from, edge.to);
    });
  });
}

template bool maySlip<2>(const Problem<2>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                         const std::vector<char>&, const std::vector<int>&, const std::vector<Rigid<2>>&);
template bool maySlip<3>(const Problem<3>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                         const std::vector<char>&, const std::vector<int>&, const std::vector<Rigid<3>>&);
template std::vector<char> mostContradicted<2>(const Problem<2>&, const std::vector<EdgeRole>&,
                                               const std::vector<char>&, const std::vector<char>&);
template std::vector<char> mostContradicted<3>(const Problem<3>&, const std::vector<EdgeRole>&,
                                               const std::vector<char>&, const std::vector<char>&);
template std::vector<Slip<2>> findSlips<2>(const Problem<2>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                           const std::vector<char>&, const std::vector<Rigid<2>>&);
template std::vector<Slip<3>> findSlips<3>(const Problem<3>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                           const std::vector<char>&, const std::vector<Rigid<3>>&);

template bool joinEndsWithoutAnyRow<2>(const Problem<2>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                       const std::vector<int>&, const std::vector<Slip<2>>&);
template bool joinEndsWithoutAnyRow<3>(const Problem<3>&, const std::vector<EdgeRole>&, const std::vector<char>&,
                                       const std::vector<int>&, const std::vector<Slip<3>>&);

}  // namespace pose_graph
