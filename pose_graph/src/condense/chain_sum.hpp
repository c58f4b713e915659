// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// Sum over the links of a chain, as twists about the begin of the chain, which makes the terms additive (equivalent to
/// Newman et al. 2009, eq. 8-13, in the axes of the poses). `shift`: displacement from the present end to the end
/// predicted by the measurements. Exact to second order at the present poses.
template <int D>
struct ChainSum {
  Tangent<D> shift = Tangent<D>::Zero();
  TangentMatrix<D> covariance = TangentMatrix<D>::Zero();

  ChainSum& operator+=(const ChainSum& more) {
    shift += more.shift;
    covariance += more.covariance;
    return *this;
  }
};

/// Returns the sum of one link from `before` to `after` (both T_begin_pose) over `edge`; `covariance`: the inverse of
/// its information. `against`: the edge measures `before` in the frame of `after`. Adds the link's cost to `cost`.
template <int D>
ChainSum<D> linkSum(const Edge<D>& edge, bool against, const TangentMatrix<D>& covariance, const Rigid<D>& before,
                    const Rigid<D>& after, double* cost);

/// Returns the chain as one edge, with `from` and `to` unset. `end`: present T_begin_end.
template <int D>
Edge<D> composedEdge(const ChainSum<D>& sum, const Rigid<D>& end);

/// Returns the twist about the begin that moves `lies` to `wanted`, both T_begin_end.
template <int D>
Tangent<D> twistBetween(const Rigid<D>& wanted, const Rigid<D>& lies);

/// Returns covariance^-1 x.
template <int D>
Tangent<D> solvedWith(const TangentMatrix<D>& covariance, const Tangent<D>& x);

/// Returns the step from `before` to `after` after the chain's end is moved. pull = (sum of all links)^-1 (move of the
/// end - shift).
template <int D>
Rigid<D> pulledStep(const ChainSum<D>& link, const Tangent<D>& pull, const Rigid<D>& before, const Rigid<D>& after);

/// Inverts an edge's information. Returns false if it is nearly singular after scaling to a unit diagonal.
template <int D>
bool invert(const TangentMatrix<D>& information, TangentMatrix<D>& inverse);

}  // namespace pose_graph
