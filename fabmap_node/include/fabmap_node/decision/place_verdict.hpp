// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "urban_nav_core/types/closure.hpp"

namespace fabmap_node {

/// Verdict of geometry on a proposed closure, as evidence that both poses are at one place.
enum class PlaceVerdict {
  Accepted,   ///< loop_metric measured a transform between the poses
  Rejected,   ///< loop_metric found none that fits
  Confirmed,  ///< accepted, and consistent with odometry and the other closures in the pose graph
  Withdrawn,  ///< accepted, then rejected by the pose graph
};
/// Returns "accepted", "rejected", "confirmed" or "withdrawn".
const char* toString(PlaceVerdict verdict);
/// Returns whether the verdict is that of the pose graph.
bool isOfPoseGraph(PlaceVerdict verdict);

/// Returns the verdict on a closure: of the pose graph if that is its source, else of the stage that measured it.
/// nullopt without evidence about the place: the closure is waiting, or the data of one of its poses are missing.
std::optional<PlaceVerdict> placeVerdict(const urban_nav_core::MetricClosure& closure);

/// Returns the log likelihood ratio of a verdict: log P(verdict | one place) / P(verdict | two places), nats. Rates are
/// from counted cases, with one added to the counts of both outcomes (Laplace), so that an outcome that was never seen
/// has a probability. Verdicts of loop_metric and of the pose graph are taken as independent given the places; those of
/// the pose graph include the former (docs/methods/fabmap_node.md, "Verdicts").
double logRatio(PlaceVerdict verdict);

}  // namespace fabmap_node
