// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "base/page.hpp"
#include "topics/stereo/stereo_run.hpp"

namespace urban_nav {

/// Dense stereo of all sessions of a run.
struct StereoSummary {
  std::int64_t pairs = 0;
  double ms_median = 0.0, ms_p99 = 0.0;
  double valid_share = 0.0;           ///< of the pixels, mean over the pairs
  double near_share = 0.0;            ///< of the valid pixels, mean over the pairs
  std::int64_t ground_found = 0;      ///< pairs
  double ground_height_median = 0.0;  ///< m, of the camera
  double ground_tilt_deg_median = 0.0;
  std::vector<std::string> warnings;
};

StereoSummary summariseStereo(const std::vector<const StereoRun*>& runs);
/// Returns the summary as a line for the console.
std::string stereoSentence(const StereoSummary& summary);
std::vector<Verdict> stereoVerdicts(const StereoSummary& summary);
/// Returns the section on a session: matched pixels and ground over time, and pictures of keyframes.
Section stereoSection(const StereoRun& run, std::size_t session, bool is_numbered);
/// Returns the object "dense_stereo" of summary.json.
Json toJson(const StereoSummary& summary);

}  // namespace urban_nav
