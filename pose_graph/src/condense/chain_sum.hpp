// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pose_graph/problem.hpp"

namespace pose_graph {

/// What the links of a chain add up to, as twists about the chain's begin: so they are summed as they are (Newman et
/// al. 2009, eq. 8-13, are the same in the poses' own axes). `shift`: where the measurements alone would have the end,
/// seen from where it lies. Exact to second order where the chain lies.
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

/// One link from `before` to `after`, T_begin_pose both, over `edge` with the inverse of its information; `against`:
/// the edge measures `before` in the frame of `after`. Adds its cost.
template <int D>
ChainSum<D> linkSum(const Edge<D>& edge, bool against, const TangentMatrix<D>& covariance, const Rigid<D>& before,
                    const Rigid<D>& after, double* cost);

/// The chain as one edge; `end`: T_begin_end as it lies. Its `from` and `to` are left alone.
template <int D>
Edge<D> composedEdge(const ChainSum<D>& sum, const Rigid<D>& end);

/// The twist about the begin that takes `lies` to `wanted`, both T_begin_end.
template <int D>
Tangent<D> twistBetween(const Rigid<D>& wanted, const Rigid<D>& lies);

/// covariance^-1 x.
template <int D>
Tangent<D> solvedWith(const TangentMatrix<D>& covariance, const Tangent<D>& x);

/// The step from `before` to `after` as it is once the chain's end is pulled: pull = (sum of all links)^-1 (move of the
/// end - shift).
template <int D>
Rigid<D> pulledStep(const ChainSum<D>& link, const Tangent<D>& pull, const Rigid<D>& before, const Rigid<D>& after);

/// The inverse of an edge's information, or false where that is near singular once it is scaled to ones on its
/// diagonal.
template <int D>
bool invert(const TangentMatrix<D>& information, TangentMatrix<D>& inverse);

}  // namespace pose_graph
