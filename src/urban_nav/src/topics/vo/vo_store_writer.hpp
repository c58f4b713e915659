// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "topics/vo/vo_run.hpp"
#include "urban_nav_store/store.hpp"

namespace urban_nav {

/// Writes the growing run of a session to the store: order of inputs, nodes, odometry edges. Not thread-safe.
class VoStoreWriter {
 public:
  /// The store must outlive the writer. The session must be in the store before the first write().
  VoStoreWriter(urban_nav_store::Store& store, urban_nav_store::SessionId id) : store_(store), id_(std::move(id)) {}

  /// Writes what the run has gained since the last call. Does not commit.
  void write(const VoRun& run);
  /// Writes the specific forces of a finished run.
  void writeForces(const VoRun& run);

 private:
  urban_nav_store::Store& store_;
  urban_nav_store::SessionId id_;
  std::size_t rows_ = 0, nodes_ = 0;  // written
};

}  // namespace urban_nav
