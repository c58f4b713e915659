// SPDX-License-Identifier: BSD-3-Clause
#include "wrong_graphs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "false_closures.hpp"
#include "linear/disjoint_sets.hpp"
#include "manifold/rotation.hpp"
#include "pose_graph/selection_warnings.hpp"

namespace pose_graph::bench {

using urban_nav_core::testing::Dice;

namespace {

constexpr double kSlipShare = 0.05, kSlipRad = 1.0;  // share of the extent; rotation about each axis

std::size_t at(int i) { return static_cast<std::size_t>(i); }

template <int D>
WrongGraph<D> drawChain(const Problem<D>& clean, std::size_t wrong, Dice& dice) {
  WrongGraph<D> made;
  made.problem = clean;
  const std::size_t before = made.problem.edges.size();
  addFalse<D>(made.problem, kFalseKinds[0], wrong, dice);
  std::vector<Edge<D>> edges;
  for (std::size_t e = 0; e < made.problem.edges.size(); ++e)
    if (e >= before || isStep(made.problem.edges[e])) edges.push_back(made.problem.edges[e]);
  made.problem.edges = edges;
  for (const Edge<D>& edge : edges) made.truth.push_back(isStep(edge) ? EdgeTruth::True : EdgeTruth::False);
  Problem<D> alone = clean;
  alone.edges.clear();
  for (const Edge<D>& edge : edges)
    if (isStep(edge)) alone.edges.push_back(edge);
  made.right = solve(alone, {}).poses;
  return made;
}

template <int D>
WrongGraph<D> drawFalse(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, const FalseKind& kind,
                        double share, Dice& dice) {
  WrongGraph<D> made{clean, optimum, std::vector<EdgeTruth>(clean.edges.size(), EdgeTruth::True)};
  const auto closures = std::count_if(clean.edges.begin(), clean.edges.end(), [](const auto& e) { return !isStep(e); });
  addFalse<D>(made.problem, kind, static_cast<std::size_t>(share * static_cast<double>(closures)), dice);
  for (std::size_t e = clean.edges.size(); e < made.problem.edges.size(); ++e) {
    const Edge<D>& edge = made.problem.edges[e];
    const Rigid<D> off = edge.Z.inverse() * (optimum[at(edge.from)].inverse() * optimum[at(edge.to)]);
    made.truth.push_back(off.t.norm() > kRightM || logRotation(off.R).norm() > kRightRad ? EdgeTruth::False
                                                                                         : EdgeTruth::Open);
  }
  return made;
}

template <int D>
WrongGraph<D> drawSlip(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, Dice& dice) {
  WrongGraph<D> made{clean, optimum, std::vector<EdgeTruth>(clean.edges.size(), EdgeTruth::True)};
  std::size_t e = 0;
  do {
    e = dice.below(clean.edges.size());
  } while (!isStep(clean.edges[e]));
  Eigen::Matrix<double, D, 1> shift;
  for (int i = 0; i < D; ++i) shift[i] = dice.normal();
  made.problem.edges[e].Z.t += kSlipShare * longestSide<D>(optimum) / shift.norm() * shift;
  RotationVector<D> turn = RotationVector<D>::Zero();
  for (int i = 0; i < kRotationSize<D>; ++i) turn[i] = dice.uniform(-kSlipRad, kSlipRad);
  made.problem.edges[e].Z.R = made.problem.edges[e].Z.R * expRotation(turn);
  made.truth[e] = EdgeTruth::False;
  return made;
}

template <int D>
WrongGraph<D> scaleInformation(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, double odometry,
                               double closures) {
  WrongGraph<D> made{clean, optimum, std::vector<EdgeTruth>(clean.edges.size(), EdgeTruth::True)};
  for (Edge<D>& edge : made.problem.edges) edge.information *= isStep(edge) ? odometry : closures;
  return made;
}

template <int D>
WrongGraph<D> drawSessions(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum, std::size_t links,
                           std::size_t wrong, Dice& dice) {
  WrongGraph<D> made;
  made.problem.poses = clean.poses;
  made.right = optimum;
  const int half = static_cast<int>(clean.poses.size() / 2);
  std::vector<Edge<D>> between;
  for (const Edge<D>& edge : clean.edges) {
    if ((edge.from < half) == (edge.to < half)) made.problem.edges.push_back(edge);
    else if (!isStep(edge)) between.push_back(edge);
  }
  made.truth.assign(made.problem.edges.size(), EdgeTruth::True);
  if (links == 0) made.right = solve(made.problem, {}).poses;
  for (std::size_t k = 0; k < std::min(links, between.size()); ++k) {
    made.problem.edges.push_back(between[k * between.size() / std::min(links, between.size())]);
    made.truth.push_back(EdgeTruth::True);
  }
  for (std::size_t k = 0; k < wrong && !between.empty(); ++k) {
    Edge<D> edge = between.front();
    edge.from = static_cast<int>(dice.below(at(half)));
    edge.to = half + static_cast<int>(dice.below(clean.poses.size() - at(half)));
    for (int i = 0; i < D; ++i) edge.Z.t[i] = dice.uniform(-1.0, 1.0);
    RotationVector<D> turn;
    for (int i = 0; i < kRotationSize<D>; ++i) turn[i] = dice.uniform(-1.5, 1.5);
    edge.Z.R = expRotation(turn);
    made.problem.edges.push_back(edge);
    made.truth.push_back(EdgeTruth::False);
  }
  return made;
}

}  // namespace

template <int D>
double longestSide(const std::vector<Rigid<D>>& poses) {
  auto low = poses.front().t, high = low;
  for (const Rigid<D>& pose : poses) {
    low = low.cwiseMin(pose.t).eval();
    high = high.cwiseMax(pose.t).eval();
  }
  return (high - low).maxCoeff();
}

template <int D>
double distanceFromRight(const WrongGraph<D>& wrong, const std::vector<Rigid<D>>& poses) {
  DisjointSets joined(poses.size());
  for (std::size_t e = 0; e < wrong.problem.edges.size(); ++e)
    if (wrong.truth[e] == EdgeTruth::True) joined.join(wrong.problem.edges[e].from, wrong.problem.edges[e].to);
  std::map<int, std::pair<std::vector<Rigid<D>>, std::vector<Rigid<D>>>> parts;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    auto& [found, right] = parts[joined.root(static_cast<int>(i))];
    found.push_back(poses[i]);
    right.push_back(wrong.right[i]);
  }
  double worst = 0.0;
  for (const auto& [root, part] : parts) worst = std::max(worst, apart<D>(part.first, part.second));
  return worst;
}

template <int D>
std::vector<WrongKind<D>> wrongKinds(const Problem<D>& clean, const std::vector<Rigid<D>>& optimum) {
  std::vector<WrongKind<D>> kinds;
  const auto scaled = [&](const std::string& name, double odometry, double closures) {
    kinds.push_back({name, false, [&clean, &optimum, odometry, closures](Dice&) {
                       return scaleInformation<D>(clean, optimum, odometry, closures);
                     }});
  };
  const auto amongTrue = [&](const std::string& name, const FalseKind& kind, double share) {
    kinds.push_back({name, true, [&clean, &optimum, kind, share](Dice& dice) {
                       return drawFalse<D>(clean, optimum, kind, share, dice);
                     }});
  };
  const auto chain = [&](std::size_t wrong) {
    kinds.push_back({"odometry and " + std::to_string(wrong) + " false ones", true,
                     [&clean, wrong](Dice& dice) { return drawChain<D>(clean, wrong, dice); }});
  };
  const auto sessions = [&](std::size_t links, std::size_t wrong) {
    kinds.push_back(
        {"two sessions, " + std::to_string(links) + " true and " + std::to_string(wrong) + " false", true,
         [&clean, &optimum, links, wrong](Dice& dice) { return drawSessions<D>(clean, optimum, links, wrong, dice); }});
  };
  scaled("nothing", 1.0, 1.0);
  for (const FalseKind& kind : kFalseKinds) amongTrue(std::string("half as many false, ") + kind.name, kind, 0.5);
  amongTrue("as many false, random", kFalseKinds[0], 1.0);
  chain(20);
  chain(100);
  kinds.push_back({"a slipped step", true, [&](Dice& dice) { return drawSlip<D>(clean, optimum, dice); }});
  scaled("odometry ten times too sure", 100.0, 1.0);
  scaled("closures ten times too sure", 1.0, 100.0);
  scaled("all ten times too sure", 100.0, 100.0);
  scaled("all ten times too modest", 0.01, 0.01);
  sessions(0, 20);
  sessions(0, 200);
  sessions(5, 20);
  sessions(21, 200);
  return kinds;
}

template <int D>
std::size_t countWarnings(const Problem<D>& problem, const RobustSolution<D>& robust) {
  FileProblem<D> file;
  file.problem = problem;
  file.roles = rolesByNumbers(problem);
  file.ids.resize(problem.poses.size());
  std::iota(file.ids.begin(), file.ids.end(), 0);
  file.edges.resize(problem.edges.size());
  std::iota(file.edges.begin(), file.edges.end(), 0);
  return selectionWarnings(
             file, robust,
             estimateScales(file.problem, file.roles, robust.edges, robust.solution.poses, robust.selection))
      .size();
}

template std::vector<WrongKind<2>> wrongKinds<2>(const Problem<2>&, const std::vector<Rigid<2>>&);
template double distanceFromRight<2>(const WrongGraph<2>&, const std::vector<Rigid<2>>&);
template double longestSide<2>(const std::vector<Rigid<2>>&);
template std::size_t countWarnings<2>(const Problem<2>&, const RobustSolution<2>&);
template std::vector<WrongKind<3>> wrongKinds<3>(const Problem<3>&, const std::vector<Rigid<3>>&);
template double distanceFromRight<3>(const WrongGraph<3>&, const std::vector<Rigid<3>>&);
template double longestSide<3>(const std::vector<Rigid<3>>&);
template std::size_t countWarnings<3>(const Problem<3>&, const RobustSolution<3>&);

}  // namespace pose_graph::bench
