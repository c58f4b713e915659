// SPDX-License-Identifier: BSD-3-Clause
#include "false_closures.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/rotation.hpp"
#include "pose_graph/robust.hpp"
#include "program.hpp"

namespace pose_graph::bench {

using urban_nav_core::testing::Dice;

namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

constexpr double kPlaceM = 0.3, kTurnRad = 10.0 * M_PI / 180.0;  // standard deviation of a false transform per axis

template <int D>
bool isClosure(const Edge<D>& edge) {
  return edge.to != edge.from + 1;
}

template <int D>
Rigid<D> nearlyNothing(Dice& dice) {
  Rigid<D> T;
  for (int i = 0; i < D; ++i) T.t[i] = kPlaceM * dice.normal();
  for (int i = 0; i < kRotationSize<D>; ++i) {
    RotationVector<D> turn = RotationVector<D>::Zero();
    turn[i] = kTurnRad * dice.normal();
    T.R = expRotation(turn) * T.R;  // roll, pitch, yaw
  }
  return T;
}

}  // namespace

template <int D>
void addFalse(Problem<D>& problem, const FalseKind& kind, std::size_t count, Dice& dice) {
  if (problem.poses.size() < 2 * kind.group + 2 || count == 0) return;
  const TangentMatrix<D> information =
      std::find_if(problem.edges.begin(), problem.edges.end(), isClosure<D>)->information;
  const std::size_t last = problem.poses.size() - 1 - kind.group, end = problem.edges.size() + count;
  while (problem.edges.size() < end) {
    std::size_t a = 0, b = 0;
    while (a == b) {
      a = dice.below(last + 1);
      b = kind.local ? a + dice.below(std::min(last, a + 20) - a + 1) : dice.below(last + 1);
    }
    if (a > b) std::swap(a, b);
    if (b == a + 1) b = a + 2;
    const Rigid<D> Z = nearlyNothing<D>(dice);
    for (std::size_t k = 0; k < kind.group && problem.edges.size() < end; ++k)
      problem.edges.push_back({static_cast<int>(a + k), static_cast<int>(b + k), Z, information});
  }
}

// After the best rigid motion (Umeyama without scale).
template <int D>
double apart(const std::vector<Rigid<D>>& a, const std::vector<Rigid<D>>& b) {
  Eigen::Matrix<double, D, 1> mean_a = Eigen::Matrix<double, D, 1>::Zero(), mean_b = mean_a;
  const double n = static_cast<double>(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i].t / n;
    mean_b += b[i].t / n;
  }
  Eigen::Matrix<double, D, D> M = Eigen::Matrix<double, D, D>::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) M += (b[i].t - mean_b) * (a[i].t - mean_a).transpose();
  const Rotation<D> R = nearestRotation(M);
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (R * (a[i].t - mean_a) - (b[i].t - mean_b)).squaredNorm();
  return std::sqrt(sum / n);
}

template void addFalse<2>(Problem<2>&, const FalseKind&, std::size_t, Dice&);
template void addFalse<3>(Problem<3>&, const FalseKind&, std::size_t, Dice&);
template double apart<2>(const std::vector<Rigid<2>>&, const std::vector<Rigid<2>>&);
template double apart<3>(const std::vector<Rigid<3>>&, const std::vector<Rigid<3>>&);

namespace {

template <int D>
FalseOutcome makeOutcome(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, const FalseKind& kind,
                         double share, std::uint64_t seed) {
  FalseOutcome made;
  made.closures = static_cast<std::size_t>(std::count_if(clean.edges.begin(), clean.edges.end(), isClosure<D>));
  Problem<D> problem = clean;
  Dice dice(seed);
  addFalse<D>(problem, kind, static_cast<std::size_t>(share * static_cast<double>(made.closures)), dice);
  RobustSolution<D> robust;
  made.seconds = measureSeconds(1, [&] { robust = relaxRobust(problem, rolesByNumbers(problem), {}); });
  made.error_m = apart<D>(robust.solution.poses, optimum);
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    const bool rejected = robust.edges[e].verdict == urban_nav_core::ClosureVerdict::Rejected;
    if (e < clean.edges.size()) {
      made.lost += rejected && isClosure<D>(edge);
      continue;
    }
    const Rigid<D> off = edge.Z.inverse() * (optimum[sz(edge.from)].inverse() * optimum[sz(edge.to)]);
    if (off.t.norm() <= kRightM && logRotation(off.R).norm() <= kRightRad) continue;
    ++made.wrong;
    made.kept += !rejected;
  }
  return made;
}

}  // namespace

CleanGraph::CleanGraph(AnyProblem problem) : problem_(std::move(problem)) {
  std::visit(
      [&](const auto& clean) {
        auto optimum = solve(clean, SolveOptions());
        seconds_ = measureSeconds(3, [&] { optimum = solve(clean, SolveOptions()); });
        for (const auto& edge : clean.edges) closures_ += isClosure(edge);
        auto low = optimum.poses.front().t, high = low;
        for (const auto& pose : optimum.poses) {
          low = low.cwiseMin(pose.t).eval();
          high = high.cwiseMax(pose.t).eval();
        }
        extent_ = (high - low).maxCoeff();
        auto alone = clean;
        alone.edges.clear();
        alone.poses = std::move(optimum.poses);
        optimum_ = std::move(alone);
      },
      problem_);
}

FalseOutcome CleanGraph::with(const FalseKind& kind, double share, std::uint64_t seed) const {
  if (const auto* flat = std::get_if<Problem<2>>(&problem_))
    return makeOutcome<2>(*flat, std::get<Problem<2>>(optimum_).poses, kind, share, seed);
  return makeOutcome<3>(std::get<Problem<3>>(problem_), std::get<Problem<3>>(optimum_).poses, kind, share, seed);
}

}  // namespace pose_graph::bench
