// SPDX-License-Identifier: BSD-3-Clause
#include "robust/decision/score.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"
#include "robust/evidence/chance_density.hpp"
#include "robust/evidence/dead_reckoning.hpp"
#include "robust/evidence/variances.hpp"
#include "start/along_edges.hpp"
#include "urban_nav_core/geometry/small_matrices.hpp"
#include "urban_nav_core/trajectory/chi_square.hpp"

namespace pose_graph {

namespace {

// Prior probability that a step slipped: 1/1000.
const double kLogSlip = std::log(Thresholds::kNegligible);
constexpr double kDisplaced = 0.01;                                 // share of the extent
constexpr double kLargestRatio = 0.9, kLargestExtrapolation = 2.0;  // ratio; logarithm
constexpr double kComponentsSettled = 0.05;                         // difference of the logarithms of the factors
// Limit of closures inside evaluated for the density of chance on a map.
constexpr std::size_t kMostChanceQueries = 512;
constexpr std::size_t kMostUnconfirmed = 8;
// Maximum length of a row of false closures: in public graphs rows have tens of closures, real front ends that confuse
// two corridors produce up to 25.
constexpr int kLongestRow = 30;

double logFactorial(double n) { return std::lgamma(n + 1.0); }

// Returns the log number of sets of `some` of `all` elements, times the number of sizes.
double logChoices(double all, double some) {
  return logFactorial(all) - logFactorial(some) - logFactorial(all - some) + std::log(all + 1.0);
}

// Computes HypothesisEvaluator::largestOdometryFactor().
template <int D>
double boundOdometryFactor(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  std::vector<const Edge<D>*> step(problem.poses.size(), nullptr);
  for (std::size_t e = 0; e < roles.size(); ++e)
    if (roles[e] == EdgeRole::Trusted && problem.edges[e].to == problem.edges[e].from + 1)
      step[sz(problem.edges[e].from)] = &problem.edges[e];
  std::vector<double> squares;
  for (std::size_t i = 0; i + 1 < step.size(); ++i) {
    if (!step[i] || !step[i + 1]) continue;
    Tangent<D> difference;
    difference.template head<D>() = step[i + 1]->Z.t - step[i]->Z.t;
    difference.template tail<kRotationSize<D>>() =
        logRotation(Rotation<D>(step[i]->Z.R.transpose() * step[i + 1]->Z.R));
    squares.push_back(0.5 * difference.dot(step[i]->information * difference) / kTangentSize<D>);
  }
  if (squares.empty()) return kFarFactor;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return kFarFactor * std::max(1.0, *middle);
}

// Adds a weak prior, uniform over the map, to information that constrains some direction less than that, as the
// evidence of an unbounded direction is undefined.
template <int D>
void boundInformation(double extent, TangentMatrix<D>& information) {
  Tangent<D> deviation;  // of a uniform distribution
  deviation.template head<D>().setConstant(2.0 * extent / std::sqrt(12.0));
  deviation.template tail<kRotationSize<D>>().setConstant(2.0 * M_PI / std::sqrt(12.0));
  const TangentMatrix<D> scaled = deviation.asDiagonal() * information * deviation.asDiagonal();
  if (urban_nav_core::smallEigen<kTangentSize<D>>(scaled).values[0] >= 1.0) return;
  information.diagonal() += deviation.cwiseAbs2().cwiseInverse();
}

// Whether most closures are bit-identical.
template <int D>
bool stateTheSame(const Problem<D>& problem, const std::vector<int>& candidates) {
  const auto values = [&](int e) {
    const Rigid<D>& Z = problem.edges[sz(e)].Z;
    std::array<double, D + D * D> made;
    std::copy(Z.t.data(), Z.t.data() + D, made.begin());
    std::copy(Z.R.data(), Z.R.data() + D * D, made.begin() + D);
    return made;
  };
  std::set<std::array<double, D + D * D>> different;
  for (const int e : candidates) different.insert(values(e));
  return 2 * different.size() < candidates.size();
}

// Extrapolates a slowly converging sequence beyond its second step (Aitken 1926).
double aitkenExtrapolation(double before, double now) {
  const double ratio = before * now > 0.0 ? std::min(now / before, kLargestRatio) : 0.0;
  return std::clamp(now * ratio / (1.0 - ratio), -kLargestExtrapolation, kLargestExtrapolation);
}

// Whether both ends of two closures are near each other: between two chains partners may be at any distance.
template <int D>
bool areNear(const Edge<D>& a, const Edge<D>& b) {
  return std::abs(std::min(a.from, a.to) - std::min(b.from, b.to)) <= kRowReach &&
         std::abs(std::max(a.from, a.to) - std::max(b.from, b.to)) <= kRowReach;
}

}  // namespace

template <int D>
HypothesisEvaluator<D>::HypothesisEvaluator(const Problem<D>& problem, const std::vector<EdgeRole>& roles)
    : problem_(problem), roles_(roles), reckoning_(problem, roles) {
  problem_.fixed = withoutCopiedPoses(problem, roles);
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (roles[e] == EdgeRole::Candidate) candidates_.push_back(static_cast<int>(e));
  }
  TangentMatrix<D> given = TangentMatrix<D>::Zero(), bounded = given;  // consecutive edges often have equal information
  for (std::size_t e = 0; e < roles.size(); ++e) {
    TangentMatrix<D>& information = problem_.edges[e].information;
    if (e == 0 || information != given || roles[e] != roles[e - 1]) {
      bounded = given = information;
      // A prior or fix without information has no effect; a step of odometry without information ends somewhere in the
      // map.
      if (roles[e] != EdgeRole::Asserted || !information.isZero(0.0)) boundInformation<D>(reckoning_.extent, bounded);
    }
    information = bounded;
  }
  set_ = std::make_unique<RelaxedSet<D>>(problem_, roles_);
  largest_odometry_ = boundOdometryFactor(problem, roles);
  assertions_ = stateTheSame(problem, candidates_);
  constexpr int kN = kTangentSize<D>, kR = kRotationSize<D>;
  log_place_ = -kR * kLogTwoPi - D * std::log(2.0 * reckoning_.extent);
  log_false_.assign(roles.size(), log_place_);
  ChanceDensity<D> by_chance(reckoning_, candidates_.size());
  for (const int e : candidates_) log_false_[sz(e)] = by_chance.logAt(problem.edges[sz(e)]);
  const ClosureLoops<D> loops(problem, candidates_, reckoning_);
  row_ = closureRows(loops, roles.size());
  neighbour_.assign(roles.size(), -1);
  std::vector<int> position(roles.size(), 0);  // position in its row
  std::vector<std::size_t> first(loops.size());
  std::iota(first.begin(), first.end(), std::size_t{0});
  log_alike_.assign(roles.size(), 0.0);
  const double scale = assertions_ ? 1.0 : informationScale(loops).factor;
  for (std::size_t a = 0; a < loops.size(); ++a)
    loops.partners(a, 1, [&](std::size_t b) {
      if (!areNear(problem.edges[sz(loops.edge(a))], problem.edges[sz(loops.edge(b))])) return;
      const ClosureLoop loop = loops.loop(a, b);
      if (!std::isfinite(loop.chi2) || !std::isfinite(loop.log_true)) return;
      double best = -std::numeric_limits<double>::infinity();
      for (const double factor : {1.0, scale, kLooseFactor, kLooseFactor * std::max(1.0, scale)})
        best = std::max(best, loop.log_true - 0.5 * kN * std::log(factor) - 0.5 * loop.chi2 / factor);
      const int before = loops.edge(a), after = loops.edge(b);
      neighbour_[sz(after)] = before;
      position[sz(after)] = position[sz(before)] + 1;
      first[b] = first[a];
      // A false closure would not have the error of those before it at this distance: similar places are parts of the
      // map.
      const bool too_long = loops.metresBetween(first[b], b) > reckoning_.extent;
      if (too_long) first[b] = b;
      log_alike_[sz(after)] =
          too_long || position[sz(after)] % kLongestRow == 0 ? -std::numeric_limits<double>::infinity() : best;
    });
}

template <int D>
double HypothesisEvaluator<D>::chance(const Hypothesis<D>& hypothesis) const {
  // The prior counts closures within chains, and closures between each pair of chains, separately: their numbers of
  // true closures are unrelated.
  struct Choice {
    double starts = 0.0, first_inside = 0.0, followers = 0.0, changes = 0.0;
  };
  std::map<std::pair<int, int>, Choice> choices;
  double sum = 0.0;
  for (const int e : candidates_) {
    const int near = neighbour_[sz(e)];
    const auto [a, b] = std::minmax(reckoning_.of_pose[sz(problem_.edges[sz(e)].from)],
                                    reckoning_.of_pose[sz(problem_.edges[sz(e)].to)]);
    Choice& choice = choices[a == b ? std::make_pair(-1, -1) : std::make_pair(a, b)];
    if (near < 0) {
      ++choice.starts;
      choice.first_inside += hypothesis.in[sz(e)] != 0;
    } else {
      ++choice.followers;
      choice.changes += (hypothesis.in[sz(e)] != 0) != (hypothesis.in[sz(near)] != 0);
    }
    if (hypothesis.in[sz(e)]) continue;
    const bool alike = near >= 0 && !hypothesis.in[sz(near)];
    sum += alike ? std::max(log_false_[sz(e)], log_alike_[sz(e)]) : log_false_[sz(e)];
  }
  for (const auto& [chains, choice] : choices)
    sum -= logChoices(choice.starts, choice.first_inside) + logChoices(choice.followers, choice.changes);
  for (std::size_t e = 0; e < roles_.size(); ++e)
    if (roles_[e] == EdgeRole::Trusted && !hypothesis.in[e]) sum += log_false_[e] + kLogSlip;
  return sum;
}

template <int D>
double HypothesisEvaluator<D>::collapsePenalty(const Hypothesis<D>& hypothesis) const {
  std::vector<std::size_t> first;
  double gain = hypothesis.log_inside - log_odometry_;
  for (const int e : candidates_) {
    if (!hypothesis.in[sz(e)]) continue;
    if (isFollower(e)) gain -= log_alike_[sz(e)];
    else first.push_back(sz(e));
  }
  if (first.empty() || assertions_) return 0.0;
  ChanceDensity<D> by_chance(reckoning_, hypothesis.poses, candidates_.size());
  const double log_predicted = gain / static_cast<double>(first.size());  // average log density per closure
  const std::size_t every = 1 + first.size() / kMostChanceQueries;
  double sum = 0.0, queries = 0.0;
  for (std::size_t i = 0; i < first.size(); i += every, queries += 1.0) {
    const double on_map = by_chance.logAt(problem_.edges[first[i]], std::exp(-log_predicted));
    sum += std::max(0.0, on_map - log_false_[first[i]]);
  }
  return sum / queries * static_cast<double>(first.size());
}

// Sums of squares over redundancy (Förstner 1979), translation and rotation combined.
template <int D>
VarianceFactors HypothesisEvaluator<D>::estimateFactors(const Hypothesis<D>& hypothesis) const {
  const double cost = set_->cost();
  const typename AcceptedGraph<D>::Share closures = set_->candidates();
  double ranks[2] = {0.0, 0.0};
  for (std::size_t e = 0; e < roles_.size(); ++e)
    if (hypothesis.in[e]) ranks[roles_[e] == EdgeRole::Candidate] += set_->rank(e);
  const double unknowns = set_->unknowns() * kTangentSize<D>;
  const auto factor = [](double squares, double redundancy) {
    return likeliestFactor({squares, std::max(0.0, redundancy)});
  };
  VarianceFactors made;
  made.odometry =
      std::min(factor((cost - closures.cost) * hypothesis.factors.odometry, ranks[0] - (unknowns - closures.unknowns)),
               largest_odometry_);
  if (!assertions_) made.closures = factor(closures.cost * hypothesis.factors.closures, ranks[1] - closures.unknowns);
  return made;
}

template <int D>
void HypothesisEvaluator<D>::evaluate(Hypothesis<D>& hypothesis) const {
  assess(hypothesis, kRounds);
}

template <int D>
double HypothesisEvaluator<D>::gainByFactors(const Hypothesis<D>& hypothesis, bool by_rows) const {
  Hypothesis<D> as_stated = hypothesis;
  as_stated.factors = {};
  if (by_rows) as_stated = assessRows(as_stated, 0);
  else assess(as_stated, 0);
  return hypothesis.log_evidence - as_stated.log_evidence;
}

template <int D>
void HypothesisEvaluator<D>::assess(Hypothesis<D>& hypothesis, int rounds) const {
  double steps_before[2] = {0.0, 0.0};
  for (int round = 0; round <= rounds; ++round) {
    set_->relax(hypothesis.in, hypothesis.factors.closures, hypothesis.factors.odometry, hypothesis.poses);
    if (round == rounds || !set_->factor()) break;
    const VarianceFactors last = hypothesis.factors;
    hypothesis.factors = estimateFactors(hypothesis);
    const double steps[2] = {std::log(hypothesis.factors.odometry / last.odometry),
                             std::log(hypothesis.factors.closures / last.closures)};
    // Poses and redundancies depend only on the ratio of the two factors.
    if (std::abs(steps[0] - steps[1]) < kComponentsSettled) {
      round = rounds - 1;  // only the poses remain to be updated
    } else if (round % 2 == 1) {
      hypothesis.factors.odometry = std::min(
          hypothesis.factors.odometry * std::exp(aitkenExtrapolation(steps_before[0], steps[0])), largest_odometry_);
      // Remains 1 if it is not estimated.
      hypothesis.factors.closures *= std::exp(aitkenExtrapolation(steps_before[1], steps[1]));
    }
    std::copy(steps, steps + 2, steps_before);
  }
  hypothesis.log_evidence = -std::numeric_limits<double>::infinity();
  if (!set_->factor()) return;
  const double sum = set_->logDensity() + set_->unknowns() * log_place_ +
                     logPriorOfFactor(hypothesis.factors.odometry) + logPriorOfFactor(hypothesis.factors.closures);
  if (!std::isfinite(sum)) return;
  hypothesis.log_inside = sum;
  hypothesis.log_evidence = sum + chance(hypothesis);
}

template <int D>
double HypothesisEvaluator<D>::rowsInside(const Hypothesis<D>& hypothesis) const {
  double rows = 0.0;
  for (const int e : candidates_) {
    const int near = neighbour_[sz(e)];
    rows += hypothesis.in[sz(e)] && (near < 0 || !hypothesis.in[sz(near)]);
  }
  return rows;
}

template <int D>
std::vector<std::vector<int>> HypothesisEvaluator<D>::unconfirmedRows(const Hypothesis<D>& hypothesis) const {
  struct Row {
    std::vector<int> closures;
    int begin = 0, end = 0;
    std::size_t alone = 0;  // number of steps spanned by this row only
  };
  std::vector<Row> rows;
  std::vector<int> row_of(roles_.size(), -1);
  for (const int e : candidates_) {
    if (!hypothesis.in[sz(e)]) continue;
    const auto [begin, end] = std::minmax(problem_.edges[sz(e)].from, problem_.edges[sz(e)].to);
    const int near = neighbour_[sz(e)];
    row_of[sz(e)] = near >= 0 && row_of[sz(near)] >= 0 ? row_of[sz(near)] : static_cast<int>(rows.size());
    if (row_of[sz(e)] == static_cast<int>(rows.size())) rows.push_back({{}, begin, end, 0});
    Row& row = rows[sz(row_of[sz(e)])];
    row.closures.push_back(e);
    row.begin = std::min(row.begin, begin);
    row.end = std::max(row.end, end);
  }
  std::vector<std::ptrdiff_t> changes(problem_.poses.size() + 1, 0), number_changes = changes;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    ++changes[sz(rows[r].begin)];
    --changes[sz(rows[r].end)];
    number_changes[sz(rows[r].begin)] += static_cast<std::ptrdiff_t>(r);
    number_changes[sz(rows[r].end)] -= static_cast<std::ptrdiff_t>(r);
  }
  std::ptrdiff_t spanning = 0, numbers = 0;  // rows that span a step, and the sum of their numbers
  for (std::size_t step = 0; step + 1 < problem_.poses.size(); ++step) {
    spanning += changes[step];
    numbers += number_changes[step];
    if (spanning == 1) ++rows[static_cast<std::size_t>(numbers)].alone;
  }
  rows.erase(std::remove_if(rows.begin(), rows.end(), [](const Row& row) { return row.alone == 0; }), rows.end());
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.alone > b.alone; });
  std::vector<std::vector<int>> unconfirmed;
  for (Row& row : rows)
    if (unconfirmed.size() < kMostUnconfirmed) unconfirmed.push_back(std::move(row.closures));
  return unconfirmed;
}

template <int D>
double HypothesisEvaluator<D>::followersInside(const Hypothesis<D>& hypothesis) const {
  double sum = 0.0;
  for (const int e : candidates_)
    if (hypothesis.in[sz(e)] && isFollower(e) && hypothesis.in[sz(neighbour_[sz(e)])]) sum += log_alike_[sz(e)];
  return sum;
}

template <int D>
Hypothesis<D> HypothesisEvaluator<D>::assessRows(const Hypothesis<D>& hypothesis, int rounds) const {
  Hypothesis<D> rows = hypothesis;
  for (const int e : candidates_)
    if (hypothesis.in[sz(e)] && isFollower(e) && hypothesis.in[sz(neighbour_[sz(e)])]) rows.in[sz(e)] = 0;
  assess(rows, rounds);
  rows.log_evidence += followersInside(hypothesis) + chance(hypothesis) - chance(rows);
  return rows;
}

template <int D>
std::vector<double> HypothesisEvaluator<D>::estimateLosses(const Hypothesis<D>& rows, const Hypothesis<D>& hypothesis,
                                                           const std::vector<std::vector<int>>& without) const {
  std::vector<double> losses(without.size(), -std::numeric_limits<double>::infinity());
  std::vector<Rigid<D>> poses = rows.poses;
  set_->relax(rows.in, rows.factors.closures, rows.factors.odometry, poses);
  if (!set_->factor()) return losses;
  const double with = followersInside(hypothesis) + chance(hypothesis);
  for (std::size_t r = 0; r < without.size(); ++r) {
    std::vector<int> first;
    Hypothesis<D> rest = hypothesis;
    for (const int e : without[r]) {
      rest.in[sz(e)] = 0;
      if (rows.in[sz(e)]) first.push_back(e);
    }
    if (first.size() == 1)
      losses[r] = set_->predictByOthers(first.front()).log_density + with - followersInside(rest) - chance(rest);
  }
  return losses;
}

template <int D>
bool HypothesisEvaluator<D>::hasContradictedRow(const Hypothesis<D>& hypothesis) const {
  const std::vector<std::vector<int>> rows = unconfirmedRows(hypothesis);
  Hypothesis<D> set = hypothesis;
  set.factors = {};
  for (const std::vector<int>& row : rows)
    for (const int e : row) set.in[sz(e)] = e == row.front();
  if (rows.empty()) return false;
  const double probability = 1.0 - Thresholds::kNegligible / static_cast<double>(rows.size());  // of the largest
  const auto excess = [&](const std::vector<int>& row) {
    const int dof = set_->rank(sz(row.front()));
    return set_->predictByOthers(row.front()).chi2 / urban_nav_core::chiSquareQuantile(probability, dof);
  };
  if (!std::isfinite(assessRows(set, 0).log_evidence)) return false;
  const auto worst =
      std::max_element(rows.begin(), rows.end(), [&](const auto& a, const auto& b) { return excess(a) < excess(b); });
  if (!(excess(*worst) > 1.0)) return false;
  Hypothesis<D> rest = set;
  rest.in[sz(worst->front())] = 0;
  const VarianceFactors found = assessRows(rest, kRounds).factors;
  set.factors = {std::max(1.0, found.odometry), std::max(1.0, found.closures)};
  return std::isfinite(assessRows(set, 0).log_evidence) && excess(*worst) > 1.0;
}

template <int D>
std::vector<char> HypothesisEvaluator<D>::outsideAcceptedRows(const std::vector<char>& in) const {
  std::map<int, int> more_inside;
  for (const int e : candidates_) more_inside[row_[sz(e)]] += in[sz(e)] ? 1 : -1;
  std::vector<char> outside(in.size(), 0);
  for (const int e : candidates_) outside[sz(e)] = !in[sz(e)] && more_inside[row_[sz(e)]] > 0;
  return outside;
}

template <int D>
double HypothesisEvaluator<D>::mostWorth(std::size_t e, double factor) const {
  return 0.5 * set_->logInformation(e) - 0.5 * set_->rank(e) * (kLogTwoPi + std::log(factor)) - log_false_[e];
}

template <int D>
bool HypothesisEvaluator<D>::mayFitLooser(const Hypothesis<D>& hypothesis,
                                          const std::vector<EdgeAssessment>& edges) const {
  const VarianceFactors& found = hypothesis.factors;
  const double scale = std::min(1.0, std::max(found.odometry, found.closures));
  std::map<int, std::pair<double, double>> rows;  // squared residual and log likelihood ratio of each row outside
  double degrees = 0.0;
  for (const int e : candidates_) {
    const EdgeAssessment& edge = edges[sz(e)];
    if (edge.weight > 0.0) degrees += edge.dof;
    if (edge.weight > 0.0 || !(edge.chi2 > 0.0)) continue;
    const double square = edge.chi2 / scale, worth = mostWorth(sz(e), found.closures);
    auto& [least, most] = rows.emplace(row_[sz(e)], std::make_pair(square, worth)).first->second;
    least = std::min(least, square);
    most = std::max(most, worth);
  }
  std::vector<std::pair<double, double>> nearest;
  for (const auto& [name, row] : rows) nearest.push_back(row);
  std::sort(nearest.begin(), nearest.end());
  double squares = degrees, all = degrees, worth = 0.0;
  for (const auto& [square, most] : nearest) {
    squares += square;
    all += kTangentSize<D>;
    worth += most;
    if (squares > kSameFactor * all && worth - 0.5 * (all - degrees) > 0.5 * all * std::log(squares / all)) return true;
  }
  return false;
}

template <int D>
bool HypothesisEvaluator<D>::isDisplaced(const std::vector<Rigid<D>>& poses,
                                         const std::vector<Rigid<D>>& others) const {
  double largest = 0.0;
  for (std::size_t i = 0; i < poses.size(); ++i) largest = std::max(largest, (poses[i].t - others[i].t).norm());
  return largest > kDisplaced * reckoning_.extent;
}

template <int D>
Hypothesis<D> HypothesisEvaluator<D>::evaluateOdometry() {
  Hypothesis<D> made;
  Problem<D> part = problem_.withoutEdges();
  for (std::size_t e = 0; e < roles_.size(); ++e) {
    made.in.push_back(roles_[e] != EdgeRole::Candidate);
    if (made.in.back()) part.edges.push_back(problem_.edges[e]);
  }
  made.poses = posesAlongEdges(part);
  evaluate(made);
  log_odometry_ = made.log_inside;
  return made;
}

template class HypothesisEvaluator<2>;
template class HypothesisEvaluator<3>;

}  // namespace pose_graph
