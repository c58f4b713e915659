// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "robust/consistent_groups.hpp"
#include "robust/whitened_edge.hpp"

namespace pose_graph {

// What all who judge closures have in common.

/// A round's relaxation: steps at most, and the share of the cost that is left. Residuals then move by less than a
/// tenth of their noise.
constexpr int kRoundSteps = 8;
constexpr double kRoundShare = 0.01;

/// Redundancy below which an edge is not controlled by the others: less of its error than that shows in its residual,
/// and what a round's relaxation leaves would be taken for it. Where the graph is settled (AcceptedGraph::settle) a
/// millionth is seen: a closure of a centimetre beside ten metres of odometry's error.
constexpr double kUncontrolled = 0.1, kUncontrolledSettled = 1e-6;

/// A chi-square from 24 samples is good to 0.29 of its value: what leaves is off by two deviations of that.
constexpr double kDoubt = 1.58;

/// Times the limit: what no arc explains. Over a long way odometry's errors lie on an arc, which linearised covariances
/// do not see; the true groups of MIT and kitti_02 lie at up to four times.
constexpr double kArc = 10.0;

/// Times the work of factoring the closures that another one confirms: beyond, the others are false, or so many of them
/// that all together are not worth a trial.
constexpr double kWork = 4.0;

/// Groups whose test costs a relaxation, at most so many at a time.
constexpr std::size_t kTries = 10;

/// Chi-square of an edge that may stand by chance.
template <int D>
double findLimit(const Thresholds& thresholds, const WhitenedEdge<D>& edge) {
  return thresholds.limit[static_cast<std::size_t>(std::max(1, edge.rank))];
}

/// Chi-square from which an edge inside has to leave, where `worst` is the largest of all inside: far off ones first,
/// as they spoil the others.
inline double leavesBeyond(const Thresholds& thresholds, double limit, double worst) {
  return std::max(kDoubt * limit, std::sqrt(thresholds.limit.back() * worst));
}

}  // namespace pose_graph
