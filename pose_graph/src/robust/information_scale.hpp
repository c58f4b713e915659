// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "robust/closure_loops.hpp"

namespace pose_graph {

/// What loops of near closures say of a graph before anything is known of its shape. Their chi-squares come from true
/// pairs, where they follow their distribution times `factor`, and from false ones, which are anywhere or, found in a
/// row, err alike; the likeliest mixture of these is found by expectation and maximisation (Dempster, Laird, Rubin
/// 1977).
struct InformationScale {
  /// By what the variances differ from those that the information states. Without loops 1; few draw it from there but
  /// little.
  double factor = 1.0;
  double true_loops = 0.0;  ///< of those looked at
  double true_share = 0.0;
};
template <int D>
InformationScale informationScale(const ClosureLoops<D>& loops);

extern template InformationScale informationScale<2>(const ClosureLoops<2>&);
extern template InformationScale informationScale<3>(const ClosureLoops<3>&);

}  // namespace pose_graph
