// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "map/session_odometry.hpp"
#include "urban_nav_input/session/source.hpp"
#include "urban_nav_ros/panorama_feed.hpp"

namespace urban_nav {

/// One item of the reading pass.
struct PassItem {
  urban_nav_input::SourceItem& input;  ///< rectified pair, corrected by stage vo; motion, scans, faults of its data
  const OdometryFrame* odometry = nullptr;  ///< of this frame, set by stage vo, which runs first
};

/// Data available at the end of an input.
struct PassEnd {
  std::vector<std::string> faults;
  std::vector<urban_nav_core::SpecificForce> forces;  ///< specific forces; empty without an accelerometer
};

/// A stage's part of the single pass in which all images of a session are read. Calls come from one thread.
class SessionPass {
 public:
  virtual ~SessionPass() = default;
  /// Observes the next item.
  virtual void process(PassItem& item) = 0;
  /// Observes a panorama whose images follow SourceInfo::panorama. Panoramas come in order of stamps, each before the
  /// first pair that was recorded after it was complete; its own stamp may be later or earlier than that of this pair.
  virtual void process(const urban_nav_ros::Panorama&) {}
  /// Observes a sweep of a 3D LiDAR, if a stage of the run uses sweeps (Stage::Description). Sweeps come in order of
  /// their references, each before the first pair that was read after it; its reference may be later or earlier than
  /// the stamp of this pair. In a session without images there is no other input.
  virtual void process(const urban_nav_input::SweepInput&) {}
  /// Observes an image of a depth camera, if a stage of the run uses them (Stage::Description). Images come in the
  /// order of the reader, each before the first pair or sweep that was read after it.
  virtual void process(const urban_nav_input::DepthInput&) {}
  /// Observes an image of a camera that colours the map, if a stage of the run uses them (Stage::Description), in the
  /// order of the reader.
  virtual void process(const urban_nav_input::ColourInput&) {}
  /// Writes new results to the store. Called before each commit, about once a second.
  virtual void flush() {}
  /// Returns the state at the end of a bag, from which a new object continues bit-exactly. All previous results
  /// must be in the store.
  virtual std::string checkpoint() { return {}; }
  /// Called once, after the last item. Throws DataError if nothing of the session is usable.
  virtual void finish(const PassEnd&) {}
  /// Returns the finished pass for Stage::restoreSession(), after finish().
  virtual std::string finished() { return {}; }
};

}  // namespace urban_nav
