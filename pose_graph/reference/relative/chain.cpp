// SPDX-License-Identifier: BSD-3-Clause
#include "chain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "twist.hpp"
#include "urban_nav_core/geometry/dense.hpp"
#include "urban_nav_core/types/error.hpp"

namespace pose_graph {
namespace {

using urban_nav_core::UserError;

template <int D>
std::string makeName(const Problem<D>& problem, std::size_t i) {
  const Edge<D>& edge = problem.edges[i];
  return "edge " + std::to_string(i) + " (" + std::to_string(edge.from) + " to " + std::to_string(edge.to) + ")";
}

template <int D>
bool isFinite(const Rigid<D>& T) {
  return T.R.allFinite() && T.t.allFinite();
}

// Round-off of the smallest eigenvalue, relative to the largest one, of a matrix computed or printed with six digits.
constexpr double kRounding = 1e-6;

// Returns root^T root = information; rows without information are zero.
template <int D>
TangentMatrix<D> chainRoot(const Problem<D>& problem, std::size_t i) {
  const TangentMatrix<D>& information = problem.edges[i].information;
  const auto eigen = urban_nav_core::symmetricEigen(information);
  const double least = eigen->values.minCoeff(), most = eigen->values.maxCoeff();
  if (least < -kRounding * std::max(most, 0.0) || most < 0.0) {
    throw UserError(
        "", makeName(problem, i) + " has indefinite information (an eigenvalue of " + std::to_string(least) + ")",
        "positive semidefinite information");
  }
  return eigen->values.cwiseMax(0.0).cwiseSqrt().asDiagonal() * eigen->vectors.transpose();
}

// Returns an edge's information about the link from its lower pose, at zero error: sufficient to test whether the link
// is constrained in all directions.
template <int D>
TangentMatrix<D> informationOnLink(const Edge<D>& edge) {
  const bool forwards = edge.from < edge.to;
  const Rigid<D> link = forwards ? edge.Z : edge.Z.inverse();
  const TangentMatrix<D> J =
      edgeRow(edge, forwards ? Rigid<D>() : link, forwards ? link : Rigid<D>()).K * linkMatrix<D>(Rigid<D>(), link.t);
  return J.transpose() * edge.information * J;
}

template <int D>
void checkNumbers(const Problem<D>& problem) {
  for (std::size_t i = 0; i < problem.poses.size(); ++i) {
    if (!isFinite(problem.poses[i])) throw UserError("", "pose " + std::to_string(i) + " is not finite", "");
  }
  const int count = static_cast<int>(problem.poses.size());
  for (std::size_t i = 0; i < problem.edges.size(); ++i) {
    const Edge<D>& edge = problem.edges[i];
    for (const int pose : {edge.from, edge.to}) {
      if (pose < 0 || pose >= count) {
        throw UserError("", makeName(problem, i) + " refers to a missing pose",
                        count == 0 ? "a graph with poses" : "0..." + std::to_string(count - 1));
      }
    }
    if (edge.from == edge.to) throw UserError("", makeName(problem, i) + " goes from a pose to itself", "");
    if (!isFinite(edge.Z) || !edge.information.allFinite())
      throw UserError("", makeName(problem, i) + " is not finite", "");
  }
}

}  // namespace

template <int D>
Chain<D> makeChain(const Problem<D>& problem) {
  checkNumbers(problem);
  Chain<D> chain;
  chain.links = std::max(0, static_cast<int>(problem.poses.size()) - 1);
  std::vector<TangentMatrix<D>> held(static_cast<std::size_t>(chain.links), TangentMatrix<D>::Zero());
  for (std::size_t i = 0; i < problem.edges.size(); ++i) {
    const Edge<D>& edge = problem.edges[i];
    const TangentMatrix<D> root = chainRoot(problem, i);
    if (std::abs(edge.from - edge.to) != 1) {
      chain.closures.push_back({i, root});
      continue;
    }
    const int link = std::min(edge.from, edge.to);
    chain.link_edges.push_back({link, i});
    held[static_cast<std::size_t>(link)] += informationOnLink(edge);
  }
  std::stable_sort(chain.link_edges.begin(), chain.link_edges.end(),
                   [](const auto& a, const auto& b) { return a.link < b.link; });
  for (int link = 0; link < chain.links; ++link) {
    if (urban_nav_core::choleskyInPlace(held[static_cast<std::size_t>(link)])) continue;
    const bool none = held[static_cast<std::size_t>(link)].isZero(0.0);
    throw UserError("",
                    "the chain " + std::string(none ? "is broken" : "leaves a direction free") + " between poses " +
                        std::to_string(link) + " and " + std::to_string(link + 1),
                    "edges between consecutive poses with positive definite information; other solvers do not "
                    "require them");
  }
  return chain;
}

template Chain<2> makeChain(const Problem<2>&);
template Chain<3> makeChain(const Problem<3>&);

}  // namespace pose_graph
