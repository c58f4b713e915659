// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "map/session_pass.hpp"
#include "topics/vo/vo_run.hpp"
#include "urban_nav_core/sequence/right_camera_turns.hpp"

namespace urban_nav {

/// Feeds SwfVo and records its output for files and report. Not thread-safe.
class VoRecorder {
 public:
  /// `run`: filled while frames are processed; must outlive the recorder.
  VoRecorder(const swf_vo::Parameters& parameters, const urban_nav_input::SourceInfo& info, VoRun& run);
  /// Continues bit-exactly from the `state` of another recorder. Throws UserError if parameters or calibration differ,
  /// DataError if the state is damaged.
  VoRecorder(const swf_vo::Parameters& parameters, const urban_nav_input::SourceInfo& info, VoRun& run,
             std::string_view state);
  ~VoRecorder();

  /// Processes an input. Returns the frame added to the run.
  const OdometryFrame& process(const urban_nav_input::SourceItem& input);
  /// Corrects the right image of the pair that was processed last by the turn of the right camera, if one was found.
  void correctRight(urban_nav_core::StereoPairWithMotion& frame);
  /// Empties the window; if `is_levelled` and specific forces determine gravity, rotates `odom` so that z is opposite
  /// to gravity. Returns whether it was rotated. No process() may follow.
  bool finish(const PassEnd& end, bool is_levelled);
  /// Returns the state of run and filter. Requires that finish() has not been called.
  std::string state() const;

 private:
  class PictureKeeper;

  VoRun& run_;
  std::optional<swf_vo::SwfVo> filter_;  // never empty: optional so that a state can replace it
  urban_nav_core::RightCameraTurns turns_;
  std::unique_ptr<PictureKeeper> pictures_;
};

}  // namespace urban_nav
