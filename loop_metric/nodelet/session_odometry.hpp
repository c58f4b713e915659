// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "urban_nav_core/trajectory/odometry_chain.hpp"
#include "urban_nav_core/types/closure.hpp"
#include "urban_nav_store/store.hpp"

namespace loop_metric {

/// A session's odometry. Where a step does not begin at the end of the one before, what follows is a part of its own, of which nothing is
/// known beside the parts before it.
class SessionOdometry {
 public:
  using Part = std::shared_ptr<urban_nav_core::OdometryChain>;

  /// False, and left out, where it goes back in time or is not finite.
  bool add(const urban_nav_core::RelativePose& step);
  const std::vector<Part>& parts() const { return parts_; }
  /// The part that knows the moment, else the last one.
  std::size_t partAt(urban_nav_core::StampNs stamp) const;
  bool empty() const { return parts_.empty(); }
  /// Stamp of the newest pose; 0 where there is none.
  urban_nav_core::StampNs newest() const;

 private:
  std::vector<Part> parts_;
};

/// As it is stored with the nodes of a session; no parts where there are none. DataError where the store is damaged.
SessionOdometry readOdometry(urban_nav_store::Store& store, const urban_nav_store::SessionId& session);

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
