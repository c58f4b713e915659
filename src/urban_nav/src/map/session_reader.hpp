// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/command_parameters.hpp"
#include "map/run_checkpoint.hpp"
#include "map/stage_list.hpp"

namespace urban_nav {

/// Returns the number of pairs of this camera to read ahead: as many as fit into a share of `memory_mb`, within limits.
int readAheadDepth(const CommandParameters& parameters, const urban_nav_core::Pinhole& camera);

/// Reads one session once, runs the passes of all stages on it, and stores its progress. Not thread-safe.
class SessionReader {
 public:
  /// Called for each frame with the share of the session that has been read, 0...1; 0 if unknown.
  using ProgressCallback = std::function<void(double share)>;

  SessionReader(MapContext& context, const StageList& stages, RunCheckpoint& checkpoint, std::size_t session);

  /// Opens source and stages at the resume point of the session. If that fails, warns and starts a new session.
  void openResumed();
  /// Opens source and stages at the beginning, unless openResumed() has; restores a session that is finished. Sets
  /// MapSession::info. Throws UserError or DataError if the inputs cannot be read.
  void open();
  /// Reads the session to its end; does nothing if it is finished.
  void read(const ProgressCallback& progress);

 private:
  using StagePass = std::pair<std::string, std::unique_ptr<SessionPass>>;  // Stage::Description::key

  std::unique_ptr<urban_nav_input::Source> openSource(const urban_nav_input::BagEnd* after = nullptr);
  std::vector<std::string> calibrationFaults() const;
  void openPasses(const BagCheckpoint* checkpoint);
  bool restoreFinished();
  void flush();
  template <typename Input>
  void processAll(const std::vector<Input>& inputs);
  void saveBagEnd(const urban_nav_input::BagEnd& end);

  MapContext& context_;
  const StageList& stages_;
  RunCheckpoint& checkpoint_;
  const std::size_t session_;
  std::unique_ptr<urban_nav_input::Source> source_;
  std::vector<StagePass> passes_;  // in the order of the stages
  bool finished_ = false;          // restored
};

}  // namespace urban_nav
