// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "map/context.hpp"
#include "map/session_pass.hpp"
#include "map/stage_result.hpp"

namespace urban_nav {

/// A stage of `map`. commands/stages.cpp lists all of them in order; options, help, parameters, checkpoints, report
/// and summary.json follow from that list. A stage has no state of its own beyond one run.
///
/// Order of calls: describe(), addTables() at any time; select() once; per session beginSession() or restoreSession();
/// missingInput(), then run(), after all sessions; result() at any time, also while sessions are read. All calls come
/// from one thread.
class Stage {
 public:
  struct Description {
    std::string name;                ///< word of --stages: "vo"
    std::string key;                 ///< of its object in summary.json and of its states in the store: "swf_vo"
    bool listed = true;              ///< selectable by --stages; false: enabled by other options
    bool uses_closures = false;      ///< reads MapContext::closures
    bool uses_previous = false;      ///< reads MapContext::previous
    std::vector<std::string> files;  ///< names of its possible files; "#" is fileSuffix()
    bool uses_depth = false;         ///< processes images of depth cameras
    bool uses_colour = false;        ///< processes images of cameras that colour the map
    bool uses_sweeps = false;        ///< processes sweeps of 3D LiDARs; sessions without images are then read too
  };
  struct Selection {
    bool enabled = false;
    std::string reason;              ///< if not enabled: the reason, for the user
    std::vector<std::string> notes;  ///< if enabled: printed before the run
  };
  /// A session whose reading starts. `checkpoint`: state of the pass at the end of a bag; nullopt: from the beginning.
  struct SessionStart {
    std::size_t session = 0;
    std::optional<std::string_view> checkpoint;
  };
  /// Lines for the console.
  struct Messages {
    std::vector<std::string> info, warnings;
  };

  virtual ~Stage() = default;
  virtual Description describe() const = 0;
  /// Adds the parameter tables that the stage uses.
  virtual void addTables(ParameterSet&) const {}
  /// Returns the parameters on which the stage's part of the reading pass depends. A session that was stored with other
  /// values is not resumed.
  virtual std::vector<urban_nav_core::Setting> passSettings(const ParameterSet&) const { return {}; }

  /// Returns the topics of recordings that the stage reads itself; they are not reported as unused.
  virtual std::vector<std::string> topicsRead(const ParameterSet&) const { return {}; }

  /// Decides from the options only; by default, a stage is enabled if --stages allows it. Throws UserError for options
  /// that contradict each other or name unusable files.
  virtual Selection select(const MapOptions& options) const {
    return {isRequested(options, describe().name), "not in --stages", {}};
  }

  /// Returns the stage's part of the reading pass of a session; null: none. Throws Error if the checkpoint does not
  /// match the session; the session is then read from its beginning.
  virtual std::unique_ptr<SessionPass> beginSession(MapContext&, const SessionStart&) { return nullptr; }
  /// Restores a session that a previous, interrupted run has read to its end. `finished`: SessionPass::finished().
  /// Returns false if the bytes are of another version; the session is then read again.
  virtual bool restoreSession(MapContext&, std::size_t /*session*/, std::string_view /*finished*/) { return true; }

  /// Returns the reason why run() has no input in this run: "no laser scans"; empty: nothing is missing.
  virtual std::string missingInput(const MapContext&) const { return {}; }
  /// Processes all sessions; their store is committed. Passes results to later stages through the context.
  virtual Messages run(MapContext&) { return {}; }
  /// Returns the results so far, for files, report and summary.json. References to the context stay valid until the
  /// files are written.
  virtual StageResult result(const MapContext&) const { return {}; }
};

}  // namespace urban_nav
