// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric {

/// Converts steps of odometry to rows of the graph, equal to those of pose_graph, so that stores of one session can be
/// merged.
class OdometryRows {
 public:
  /// Continues from a pose of the store.
  void continueFrom(const urban_nav_store::Node& newest) { newest_ = newest; }
  /// Creates the rows of a step. Returns false without rows if the step is invalid or earlier than the previous ones.
  bool write(const urban_nav_store::SessionId& session, const urban_nav_core::RelativePose& step,
             std::vector<urban_nav_store::Node>& nodes, std::optional<urban_nav_store::Edge>& edge);

 private:
  std::optional<urban_nav_store::Node> newest_;
};

}  // namespace loop_metric
