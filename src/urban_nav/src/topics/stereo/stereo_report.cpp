// SPDX-License-Identifier: BSD-3-Clause
#include "topics/stereo/stereo_report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/plot.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav {

namespace {

constexpr double kStereoDegrees = 57.29577951308232;

double shareOfGround(const StereoSummary& summary) {
  return summary.pairs == 0 ? 0.0 : static_cast<double>(summary.ground_found) / static_cast<double>(summary.pairs);
}

/// Returns one warning for each kind of fault, with the sentence of its first pair.
std::vector<std::string> describeFaults(const std::vector<const StereoRun*>& runs, std::int64_t pairs) {
  std::map<std::string, std::pair<std::int64_t, std::string>> faults;
  for (const StereoRun* run : runs)
    for (const StereoKeyframe& keyframe : run->keyframes) {
      if (keyframe.reason == "none") continue;
      auto& [count, sentence] = faults[keyframe.reason];
      if (count++ == 0) sentence = keyframe.sentence;
    }
  std::vector<std::string> warnings;
  for (const auto& [reason, fault] : faults)
    warnings.push_back("stereo: " + std::to_string(fault.first) + " of " + std::to_string(pairs) + " pairs, " + reason +
                       ": " + fault.second);
  return warnings;
}

/// Plots a value of each keyframe over time.
template <typename Value>
std::string plotKeyframes(const StereoRun& run, const std::string& label, bool from_zero, const Value& value) {
  Plot plot;
  plot.x_label = "time (s)";
  plot.y_label = label;
  plot.y_from_zero = from_zero;
  Series line;
  line.kind = Series::Kind::Dots;
  for (const StereoKeyframe& keyframe : run.keyframes)
    line.points.push_back({1e-9 * static_cast<double>(keyframe.stamp - run.keyframes.front().stamp), value(keyframe)});
  plot.series.push_back(line);
  return renderSvg(plot);
}

double orGap(const StereoKeyframe& keyframe, double value) {
  return keyframe.hasGround() ? value : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

StereoSummary summariseStereo(const std::vector<const StereoRun*>& runs) {
  StereoSummary made;
  std::vector<double> ms, heights, tilts;
  for (const StereoRun* run : runs)
    for (const StereoKeyframe& keyframe : run->keyframes) {
      ++made.pairs;
      ms.push_back(keyframe.ms);
      made.valid_share += keyframe.answered;
      made.near_share += keyframe.near_share;
      if (!keyframe.hasGround()) continue;
      ++made.ground_found;
      heights.push_back(keyframe.height);
      tilts.push_back(kStereoDegrees * keyframe.tilt);
    }
  if (made.pairs == 0) return made;
  made.valid_share /= static_cast<double>(made.pairs);
  made.near_share /= static_cast<double>(made.pairs);
  made.ms_median = urban_nav_core::quantile(ms, 0.5);
  made.ms_p99 = urban_nav_core::quantile(ms, 0.99);
  made.ground_height_median = urban_nav_core::quantile(heights, 0.5);
  made.ground_tilt_deg_median = urban_nav_core::quantile(tilts, 0.5);
  made.warnings = describeFaults(runs, made.pairs);
  return made;
}

std::string stereoSentence(const StereoSummary& summary) {
  return "stereo: " + std::to_string(summary.pairs) + " pairs, " +
         urban_nav_core::formatNumber(100.0 * summary.valid_share, 3) + " % of the pixels matched, ground in " +
         urban_nav_core::formatNumber(100.0 * shareOfGround(summary), 3) + " %; " +
         urban_nav_core::formatNumber(summary.ms_median, 3) + " ms each";
}

std::vector<Verdict> stereoVerdicts(const StereoSummary& summary) {
  const bool is_dense = summary.valid_share > 0.5, has_ground = shareOfGround(summary) > 0.5;
  return {{is_dense && has_ground ? Grade::Good : Grade::Fair,
           "Dense stereo matched " + urban_nav_core::formatNumber(100.0 * summary.valid_share, 3) + " % of the pixels.",
           "Of " + std::to_string(summary.pairs) + " pairs " + std::to_string(summary.ground_found) +
               " have a ground plane; " + urban_nav_core::formatNumber(100.0 * summary.near_share, 3) +
               " % of the matched pixels are near enough for ground, obstacles and map."}};
}

Section stereoSection(const StereoRun& run, std::size_t session, bool is_numbered) {
  const std::string number = is_numbered ? std::to_string(session + 1) : "";
  Section section{"stereo" + number,
                  "Dense stereo" + (is_numbered ? " (session " + number + ")" : ""),
                  "Depth of each pixel at keyframes. In the pictures: the left image; disparities from far, blue, to "
                  "near, red; their standard deviations from 0, dark, to 0.5 px, bright; the ground in green and "
                  "obstacles in red. Black pixels are not matched.",
                  {},
                  {},
                  {}};
  if (run.keyframes.empty()) return section;
  section.figures.push_back(
      {"Matched pixels",
       plotKeyframes(run, "share (%)", true, [](const StereoKeyframe& keyframe) { return 100.0 * keyframe.answered; }),
       "Of each keyframe.", false});
  section.figures.push_back(
      {"Height of the camera above the ground",
       plotKeyframes(run, "height (m)", false,
                     [](const StereoKeyframe& keyframe) { return orGap(keyframe, keyframe.height); }),
       "Of keyframes with a ground plane.", false});
  section.figures.push_back(
      {"Tilt of the ground",
       plotKeyframes(run, "tilt (deg)", true,
                     [](const StereoKeyframe& keyframe) { return orGap(keyframe, kStereoDegrees * keyframe.tilt); }),
       "Between the ground's normal and the z axis of base_link: pitch, roll and slopes.", false});
  for (const StereoPicture& picture : run.pictures)
    section.pictures.push_back({picture.caption, picture.jpeg, picture.width, picture.height});
  return section;
}

Json toJson(const StereoSummary& summary) {
  Json json = Json::object();
  json["pairs"] = summary.pairs;
  json["ms_median"] = summary.ms_median;
  json["ms_p99"] = summary.ms_p99;
  json["valid_share"] = summary.valid_share;
  json["near_share"] = summary.near_share;
  json["ground_found"] = summary.ground_found;
  json["ground_height_median"] = summary.ground_height_median;
  json["ground_tilt_deg_median"] = summary.ground_tilt_deg_median;
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : summary.warnings) warnings.append(warning);
  return json;
}

}  // namespace urban_nav
