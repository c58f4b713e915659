// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "ablation/ablated.hpp"
#include "urban_nav_core/testing/rendered_sequence.hpp"

namespace swf_vo::bench {

/// A stereo sequence with ground truth, from any source of images.
struct Sequence {
  std::string name;
  urban_nav_core::StereoCamera camera;
  std::vector<urban_nav_core::StampNs> stamps;
  std::vector<urban_nav_core::Pose> truth;  ///< left camera in that of frame 0; empty if there is none
  std::function<void(std::size_t frame, cv::Mat& left, cv::Mat& right)>
      read;  ///< 8-bit grey; empty if a frame is missing
};

/// KITTI's layout (image_0, image_1, calib.txt, times.txt, poses.txt), at most `frames` of it.
Sequence kittiFolder(const std::string& folder, std::size_t frames = 1000000);

/// Returns the folder of a real sequence below URBAN_NAV_DATA/stereo; empty, with a message on stderr, if it does not
/// exist.
std::string dataFolder(const std::string& name);

/// A scene of the renderer ("room" or "street", by its seed) along a named motion, at 20 Hz, 512x384 unless `camera` is
/// set.
struct RenderedOptions {
  std::string scene = "room", motion = "wander";
  std::uint32_t seed = 1;
  std::size_t frames = 201;
  double rate = 20.0;  ///< Hz
  double noise = 1.0;  ///< grey levels
  urban_nav_core::testing::RenderCamera camera;
};
Sequence rendered(const RenderedOptions& options);
/// The same frames at each of these noises (options.noise is ignored); if read in turn, each frame is rendered once.
std::vector<Sequence> renderedAt(const std::vector<double>& noises, const RenderedOptions& options);

/// Returns the defaults changed by settings such as "swf_vo.window=25". Throws UserError as the command does.
Parameters parametersFrom(const std::vector<std::string>& settings);

/// Result of a filter for a sequence; poses of the left camera in that of frame 0.
struct Run {
  std::vector<urban_nav_core::Pose> now, settled;
  std::vector<urban_nav_core::Matrix6d> now_covariance, settled_covariance, relative_covariance, drift_covariance;
  std::vector<Statistics> statistics;
  std::vector<urban_nav_core::Status> status;
  std::vector<double> ms;  ///< process() without decoding of images: processor time, independent of other processes
};
Run run(const Sequence& sequence, const Parameters& parameters, const Ablation& ablation = {});
/// Runs one filter per sequence, frame by frame in turn. Requires equal numbers of frames.
std::vector<Run> runTogether(const std::vector<Sequence>& sequences, const Parameters& parameters,
                             const Ablation& ablation = {});

/// Errors over all spans of a number of frames: mean in per cent and deg/m, and the median ratio of the lengths of
/// one-frame steps.
struct SpanErrors {
  double percent = 0.0;
  double deg_per_m = 0.0;
};
SpanErrors spanErrors(const std::vector<urban_nav_core::Pose>& truth, const std::vector<urban_nav_core::Pose>& estimate,
                      std::size_t span);
double stepRatio(const std::vector<urban_nav_core::Pose>& truth, const std::vector<urban_nav_core::Pose>& estimate);

}  // namespace swf_vo::bench
