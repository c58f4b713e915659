// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "input/source.hpp"
#include "swf_vo/swf_vo.hpp"

namespace urban_nav {

/// What is kept of one stereo frame: the row of stats.csv.
struct VoRow {
  std::int64_t frame = 0;  ///< counts stereo frames from 0, dropped ones included
  urban_nav_core::StampNs stamp = 0;
  bool accepted = true;  ///< false: dropped because of its stamp
  urban_nav_core::Status status;
  swf_vo::Statistics statistics;
  urban_nav_core::Pose T_odom_base;  ///< now: as odometry has it live
  double process_ms = 0.0;
};

/// A frame with its tracks, small enough to stand in the report.
struct VoPicture {
  std::int64_t frame = 0;
  urban_nav_core::StampNs stamp = 0;
  std::string caption;
  std::vector<unsigned char> jpeg;
  int width = 0, height = 0;
};

struct VoLandmark {
  swf_vo::Landmark landmark;
  std::uint8_t grey = 0;  ///< of the pixel where it was last seen
  int seen = 0;           ///< frames
};

/// All that visual odometry made of one session.
struct VoRun {
  std::string input;
  urban_nav_core::StereoCamera camera;
  urban_nav_core::Pose T_base_camera;
  std::vector<VoRow> rows;               ///< one per stereo frame
  std::vector<swf_vo::Settled> settled;  ///< one per accepted frame, as far as they have left the window
  std::map<swf_vo::LandmarkId, VoLandmark> landmarks;
  std::vector<VoPicture> pictures;            ///< evenly spread over the session
  std::vector<urban_nav_core::SpecificForce> forces;  ///< around settled frames, as far as an accelerometer felt any
  std::vector<std::string> faults;            ///< of the data, each with the file or topic; at most kFaultsKept
  std::int64_t faults_total = 0;
};
constexpr std::size_t kFaultsKept = 100;

/// Feeds SwfVo and keeps what the files and the report need of its answers. Not thread-safe.
class VoStage {
 public:
  VoStage(const swf_vo::Parameters& parameters, const SourceInfo& info);
  /// Goes on where another object stood when `state` was taken from it. UserError where that was made with other parameters or another
  /// calibration, or is damaged.
  VoStage(const swf_vo::Parameters& parameters, const SourceInfo& info, std::string_view state);
  /// What another stage object has finished: run() is all there is to do with it.
  explicit VoStage(VoRun finished);
  ~VoStage();

  /// The row it added to run().
  const VoRow& process(const SourceItem& input);
  /// Empties the window; `faults` are those of the input as a whole, `forces` all that an accelerometer felt. No process() after it.
  void finish(const std::vector<std::string>& faults, const std::vector<urban_nav_core::SpecificForce>& forces = {});

  /// Not after finish(). In it are the run so far and the filter.
  std::string state() const;

  const VoRun& run() const { return run_; }

 private:
  class PictureKeeper;

  VoRun run_;
  std::optional<swf_vo::SwfVo> filter_;  // none where the run came finished
  std::unique_ptr<PictureKeeper> pictures_;
};

}  // namespace urban_nav
