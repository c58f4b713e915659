// SPDX-License-Identifier: BSD-3-Clause
#include "solve/tangled.hpp"

#include <algorithm>

#include "linear/index.hpp"
#include "manifold/rotation.hpp"

namespace pose_graph {

namespace {

// Radians: root mean square about one axis, and maximum of one edge.
constexpr double kNoisy = 0.1, kTangled = 1.1;

}  // namespace

template <int D>
bool isTangled(const Problem<D>& problem, const std::vector<double>& weights, const std::vector<Rigid<D>>& poses) {
  double sum = 0.0, largest = 0.0;
  int count = 0;
  for (std::size_t e = 0; e < problem.edges.size(); ++e) {
    const Edge<D>& edge = problem.edges[e];
    const bool measures =
        edge.information.template bottomRightCorner<kRotationSize<D>, kRotationSize<D>>().diagonal().minCoeff() > 0.0;
    if (!measures || (!weights.empty() && !(weights[e] > 0.0))) continue;
    const Rotation<D> off = edge.Z.R.transpose() * (poses[sz(edge.from)].R.transpose() * poses[sz(edge.to)].R);
    const double square = logRotation(off).squaredNorm();
    sum += square;
    largest = std::max(largest, square);
    ++count;
  }
  return sum > kNoisy * kNoisy * count * kRotationSize<D> || largest > kTangled * kTangled;
}

template bool isTangled<2>(const Problem<2>&, const std::vector<double>&, const std::vector<Rigid<2>>&);
template bool isTangled<3>(const Problem<3>&, const std::vector<double>&, const std::vector<Rigid<3>>&);

}  // namespace pose_graph
