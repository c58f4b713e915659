// SPDX-License-Identifier: BSD-3-Clause
#include "start/aligned.hpp"

#include "linear/disjoint_sets.hpp"
#include "linear/index.hpp"
#include "manifold/rotation.hpp"

namespace pose_graph {

namespace {

template <int D>
bool measuresRotation(const Edge<D>& edge) {
  return edge.information.template bottomRightCorner<kRotationSize<D>, kRotationSize<D>>().diagonal().minCoeff() > 0.0;
}

/// Positions measured from the fixed poses, and present ones.
template <int D>
struct Correspondences {
  using Position = Eigen::Matrix<double, D, 1>;
  std::vector<Position> measured, present;
  std::vector<double> shares;  // proportional to information
  bool is_tied = false;

  Rigid<D> fit() const {
    Position measured_mean = Position::Zero(), present_mean = Position::Zero();
    double sum = 0.0;
    for (const double share : shares) sum += share;
    if (!(sum > 0.0)) return {};
    for (std::size_t i = 0; i < measured.size(); ++i) {
      measured_mean += shares[i] / sum * measured[i];
      present_mean += shares[i] / sum * present[i];
    }
    Rotation<D> moments = Rotation<D>::Zero();
    for (std::size_t i = 0; i < measured.size(); ++i)
      moments += shares[i] / sum * (measured[i] - measured_mean) * (present[i] - present_mean).transpose();
    if (moments.isZero(0.0) || !moments.allFinite()) return {};
    Rigid<D> result;
    result.R = nearestRotation(moments);
    result.t = measured_mean - result.R * present_mean;
    return result;
  }
};

}  // namespace

template <int D>
void alignWithFixed(const Problem<D>& problem, const std::vector<double>& weights, std::vector<Rigid<D>>& poses) {
  std::vector<char> fixed(poses.size(), 0);
  for (const int pose : problem.fixed) fixed[sz(pose)] = 1;
  DisjointSets parts(poses.size());
  const auto counts = [&](std::size_t e) { return weights.empty() || weights[e] > 0.0; };
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    if (counts(e) && !fixed[sz(edge.from)] && !fixed[sz(edge.to)]) parts.join(edge.from, edge.to);
  }
  std::vector<Correspondences<D>> found(poses.size());  // indexed by the first pose of a part
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    if (!counts(e) || fixed[sz(edge.from)] == fixed[sz(edge.to)] || edge.information.isZero(0.0)) continue;
    const bool from_fixed = fixed[sz(edge.from)] != 0;
    Correspondences<D>& part = found[sz(parts.root(from_fixed ? edge.to : edge.from))];
    part.is_tied |= !from_fixed || measuresRotation(edge);
    part.measured.push_back((poses[sz(edge.from)] * edge.Z).t);
    part.shares.push_back((weights.empty() ? 1.0 : weights[e]) *
                          edge.information.template topLeftCorner<D, D>().trace());
    part.present.push_back(edge.measured(poses[sz(edge.to)]).t);
  }
  std::vector<Rigid<D>> moves(poses.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    if (!found[i].is_tied && found[i].measured.size() > 1) moves[i] = found[i].fit();
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!fixed[i]) poses[i] = moves[sz(parts.root(static_cast<int>(i)))] * poses[i];
}

template <int D>
bool areRotationsTied(const Problem<D>& problem, const std::vector<double>& weights) {
  DisjointSets all(problem.poses.size()), tied(problem.poses.size());
  all.joinAll(problem.fixed);
  tied.joinAll(problem.fixed);
  int apart = 0;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    if (!weights.empty() && !(weights[e] > 0.0)) continue;
    apart += all.join(edge.from, edge.to);
    if (measuresRotation(edge)) apart -= tied.join(edge.from, edge.to);
  }
  return apart == 0;
}

template void alignWithFixed<2>(const Problem<2>&, const std::vector<double>&, std::vector<Rigid<2>>&);
template void alignWithFixed<3>(const Problem<3>&, const std::vector<double>&, std::vector<Rigid<3>>&);
template bool areRotationsTied<2>(const Problem<2>&, const std::vector<double>&);
template bool areRotationsTied<3>(const Problem<3>&, const std::vector<double>&);

}  // namespace pose_graph
