// SPDX-License-Identifier: BSD-3-Clause
#include "marginals/free_directions.hpp"

#include "urban_nav_core/geometry/covariance_frames.hpp"
#include "urban_nav_core/geometry/dense.hpp"

namespace pose_graph {

namespace {

// Share of free variance, in units of its own deviations, above which a direction is free. Pins are 1e-6 of the
// diagonal: pinned directions have a larger variance than constrained ones, and the difference of two such covariances
// is accurate to about 1e-8.
constexpr double kFree = 1e-5;

}  // namespace

template <int D>
Marginal<D> withoutPins(const TangentMatrix<D>& pinned, const TangentMatrix<D>& free) {
  using namespace urban_nav_core;
  Marginal<D> made;
  const Tangent<D> deviations = pinned.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (!(deviations.minCoeff() > 0.0)) return made;
  const Tangent<D> scale = deviations.cwiseInverse();
  const TangentMatrix<D> scaled_free = scale.asDiagonal() * free * scale.asDiagonal();
  const auto eigen = symmetricEigen(scaled_free);
  if (!eigen) return made;
  Eigen::Index known = 0;
  while (known < eigen->values.size() && eigen->values[known] < kFree) ++known;
  if (known == eigen->values.size()) {
    made.knowledge = Knowledge::Full;
    made.covariance = pinned;
    return made;
  }
  made.knowledge = Knowledge::Partial;
  if (known == 0) return made;
  const Eigen::MatrixXd V = scale.asDiagonal() * eigen->vectors.leftCols(known);
  const auto information = invertPositiveDefinite(V.transpose() * pinned * V);
  if (information) made.information = V * *information * V.transpose();
  return made;
}

template Marginal<2> withoutPins<2>(const TangentMatrix<2>&, const TangentMatrix<2>&);
template Marginal<3> withoutPins<3>(const TangentMatrix<3>&, const TangentMatrix<3>&);

}  // namespace pose_graph
