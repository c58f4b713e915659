// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include "map/session_odometry.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Writes the growing odometry of a session to the store: order of inputs, nodes, odometry edges. Not thread-safe.
class OdometryStoreWriter {
 public:
  /// `source`: of the edges; `stream`: name of the inputs. The store must outlive the writer. The session must be in
  /// the store before the first write().
  OdometryStoreWriter(urban_nav_store::Store& store, urban_nav_store::SessionId id, std::string source,
                      std::string stream)
      : store_(store), id_(std::move(id)), source_(std::move(source)), stream_(std::move(stream)) {}

  /// Writes the frames and steps added since the last call. Does not commit.
  void write(const SessionOdometry& run);
  /// Writes only nodes and edges, replacing those of another odometry with the same times and edge source `replaced`.
  void replaceNodes(const SessionOdometry& run, const std::string& replaced);
  /// Writes all poses and steps of the run, replacing those of earlier calls. Does not commit.
  void rewrite(const SessionOdometry& run);
  /// Writes the specific forces of a finished run.
  void writeForces(const SessionOdometry& run);

 private:
  void writeNodes(const SessionOdometry& run);

  urban_nav_store::Store& store_;
  urban_nav_store::SessionId id_;
  std::string source_, stream_;
  std::size_t rows_ = 0, nodes_ = 0;  // written
};

}  // namespace urban_nav
