// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "urban_nav_core/types/pose_with_covariance.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric {

/// A step as rows of the graph, in the way that pose_graph has them, so that files of one session can be joined.
class OdometryRows {
 public:
  /// Goes on from a pose that is in the store.
  void goOn(const urban_nav_store::Node& newest) { newest_ = newest; }
  /// False, and nothing is written, where add() would be false.
  bool write(const urban_nav_store::SessionId& session, const urban_nav_core::RelativePose& step,
             std::vector<urban_nav_store::Node>& nodes, std::optional<urban_nav_store::Edge>& edge);

 private:
  std::optional<urban_nav_store::Node> newest_;
};

}  // namespace loop_metric
