// SPDX-License-Identifier: BSD-3-Clause
#include "robust/evidence/dead_reckoning.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"

namespace pose_graph {

namespace {}  // namespace

template <int D>
TangentMatrix<D> adjoint(const Rigid<D>& T) {
  constexpr int kR = kRotationSize<D>;
  TangentMatrix<D> made = TangentMatrix<D>::Zero();
  made.template topLeftCorner<D, D>() = T.R;
  if constexpr (D == 2) {
    made.template topRightCorner<2, 1>() = -turned(T.t);
    made(2, 2) = 1.0;
  } else {
    made.template topRightCorner<D, kR>() = -turned(T.t) * T.R;
    made.template bottomRightCorner<kR, kR>() = T.R;
  }
  return made;
}

template <int D>
TangentMatrix<D> boundedCovariance(const TangentMatrix<D>& information, double extent) {
  TangentMatrix<D> sum = information;
  for (int a = 0; a < kTangentSize<D>; ++a) {
    const double width = a < D ? 2.0 * extent : 2.0 * M_PI;
    sum(a, a) += 12.0 / (width * width);
  }
  return sum.inverse();
}

template <int D>
DeadReckoning<D>::DeadReckoning(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  const std::size_t n = problem.poses.size();
  std::vector<const Edge<D>*> step(n, nullptr);
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    if (roles[e] != EdgeRole::Trusted || std::abs(edge.from - edge.to) != 1) continue;
    const Edge<D>*& slot = step[sz(std::max(edge.from, edge.to))];
    if (!slot) slot = &edge;
  }
  of_pose.assign(n, 0);
  pose.resize(n);
  way.assign(n, 0.0);
  int chain = 0;
  for (std::size_t i = 1; i < n; ++i) {
    if (!step[i]) {
      of_pose[i] = ++chain;
      continue;
    }
    of_pose[i] = chain;
    const Rigid<D> T = step[i]->from < step[i]->to ? step[i]->Z : step[i]->Z.inverse();
    pose[i] = pose[i - 1] * T;
    way[i] = way[i - 1] + T.t.norm();
  }
  double sum = 0.0;
  for (std::size_t begin = 0; begin < n;) {
    std::size_t end = begin;
    Eigen::Matrix<double, D, 1> middle = Eigen::Matrix<double, D, 1>::Zero();
    while (end < n && of_pose[end] == of_pose[begin]) middle += pose[end++].t;
    middle /= static_cast<double>(end - begin);
    for (; begin < end; ++begin) sum += (pose[begin].t - middle).squaredNorm();
  }
  extent = std::max(kLeastExtent, 2.0 * std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, n))));
  Q.assign(n, TangentMatrix<D>::Zero());
  const Edge<D>* last = nullptr;  // consecutive steps often have equal information
  TangentMatrix<D> covariance;
  for (std::size_t i = 1; i < n; ++i) {
    if (!step[i]) continue;
    if (!last || step[i]->information != last->information)
      covariance = boundedCovariance<D>(step[i]->information, extent);
    last = step[i];
    const TangentMatrix<D> turn = adjoint<D>(step[i]->from < step[i]->to ? pose[i] : pose[i] * step[i]->Z);
    Q[i].noalias() = turn * covariance * turn.transpose();
  }
}

template <int D>
TangentMatrix<D> DeadReckoning<D>::covariance(int a, int b) const {
  TangentMatrix<D> sum = TangentMatrix<D>::Zero();
  for (int k = std::min(a, b) + 1; k <= std::max(a, b); ++k) sum += Q[sz(k)];
  const TangentMatrix<D> turn = adjoint<D>(pose[sz(a)].inverse());
  return turn * sum * turn.transpose();
}

namespace {

constexpr double kCopied = 1e-4;  // squared hundredth of a deviation; larger than the round-off of six printed digits

/// Returns the trusted edges of each pose.
template <int D>
std::vector<std::vector<const Edge<D>*>> trustedEdges(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  std::vector<std::vector<const Edge<D>*>> edges(problem.poses.size());
  for (std::size_t e = 0; e < roles.size(); ++e) {
    if (roles[e] != EdgeRole::Trusted) continue;
    edges[sz(problem.edges[e].from)].push_back(&problem.edges[e]);
    edges[sz(problem.edges[e].to)].push_back(&problem.edges[e]);
  }
  return edges;
}

/// Returns the squared Mahalanobis distance of two poses.
template <int D>
double squaredDistance(const Rigid<D>& a, const Rigid<D>& b, const TangentMatrix<D>& information) {
  const Rigid<D> difference = a.inverse() * b;
  Tangent<D> d;
  d.template head<D>() = difference.t;
  d.template tail<kRotationSize<D>>() = logRotation(difference.R);
  return d.dot(information * d);
}

}  // namespace

template <int D>
std::vector<int> withoutCopiedPoses(const Problem<D>& problem, const std::vector<EdgeRole>& roles) {
  if (problem.fixed.size() < 2) return problem.fixed;
  const auto edges = trustedEdges(problem, roles);
  std::vector<Rigid<D>> poses = problem.poses;
  std::vector<char> reached(poses.size(), 0);
  std::vector<int> kept, open;
  for (const int first : problem.fixed) {
    if (reached[sz(first)]) continue;
    reached[sz(first)] = 1;
    kept.push_back(first);
    open.push_back(first);
    while (!open.empty()) {
      const int at = open.back();
      open.pop_back();
      for (const Edge<D>* edge : edges[sz(at)]) {
        const int next = edge->from == at ? edge->to : edge->from;
        if (reached[sz(next)]) continue;
        reached[sz(next)] = 1;
        open.push_back(next);
        const Rigid<D> there = poses[sz(at)] * (edge->from == at ? edge->Z : edge->Z.inverse());
        if (!std::binary_search(problem.fixed.begin(), problem.fixed.end(), next)) poses[sz(next)] = there;
        else if (!(squaredDistance(there, poses[sz(next)], edge->information) < kCopied)) kept.push_back(next);
      }
    }
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

template TangentMatrix<2> adjoint<2>(const Rigid<2>&);
template TangentMatrix<3> adjoint<3>(const Rigid<3>&);
template TangentMatrix<2> boundedCovariance<2>(const TangentMatrix<2>&, double);
template TangentMatrix<3> boundedCovariance<3>(const TangentMatrix<3>&, double);
template struct DeadReckoning<2>;
template struct DeadReckoning<3>;
template std::vector<int> withoutCopiedPoses<2>(const Problem<2>&, const std::vector<EdgeRole>&);
template std::vector<int> withoutCopiedPoses<3>(const Problem<3>&, const std::vector<EdgeRole>&);

}  // namespace pose_graph
