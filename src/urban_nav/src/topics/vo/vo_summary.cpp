// SPDX-License-Identifier: BSD-3-Clause
#include "topics/vo/vo_summary.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/plot.hpp"
#include "map/motion_summary.hpp"
#include "map/run_totals.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/trajectory/statistics.hpp"

namespace urban_nav {

namespace {

constexpr std::size_t kWarningsShown = 20;
constexpr double kFarOutside = 3.0;    // standard deviations of a prior
constexpr double kRowsDisagree = 1.0;  // px, beyond which a pair is not rectified, although its offset is compensated
constexpr double kRigDegrees = 180.0 / M_PI;

/// Returns whether an estimate contradicts its prior; false if it is not estimated.
bool isFarOutside(double estimate, double sigma, double prior) {
  return sigma > 0.0 && prior > 0.0 && std::abs(estimate) > kFarOutside * (prior + sigma);
}

/// Appends the number of LOST frames by reason, with the sentence of the first one.
void addLosses(const VoRun& run, std::vector<std::string>& warnings) {
  struct Loss {
    std::int64_t count = 0;
    std::string sentence;
  };
  std::map<int, Loss> losses;
  for (const OdometryFrame& row : run.frames) {
    if (row.status.health != urban_nav_core::Health::Lost) continue;
    Loss& loss = losses[row.status.reason];
    if (loss.count++ == 0) loss.sentence = row.status.sentence;
  }
  for (const auto& [reason, loss] : losses)
    warnings.push_back(run.input + ": " + std::to_string(loss.count) + " of " + std::to_string(run.frames.size()) +
                       " frames LOST (" + swf_vo::toString(static_cast<swf_vo::Reason>(reason)) +
                       "): " + loss.sentence);
}

/// Appends the constants of the rig that the images contradict.
void addRig(const VoRun& run, const swf_vo::Parameters& parameters, std::vector<std::string>& warnings) {
  const auto last =
      std::find_if(run.frames.rbegin(), run.frames.rend(), [](const OdometryFrame& frame) { return frame.accepted; });
  if (last == run.frames.rend()) return;
  const swf_vo::Statistics& figures = run.figures[static_cast<std::size_t>(run.frames.rend() - last) - 1].statistics;
  const double offset = figures.disparity_offset_px, sigma = figures.disparity_offset_sigma_px;
  if (isFarOutside(offset, sigma, parameters.disparity_offset))
    warnings.push_back(run.input + ": calibration: disparities are off by " + urban_nav_core::formatNumber(offset, 2) +
                       " +- " + urban_nav_core::formatNumber(sigma, 1) + " px, where swf_vo.disparity_offset = " +
                       urban_nav_core::formatNumber(parameters.disparity_offset, 3) +
                       " px is assumed: calibrate the pair again, or check the synchronisation of its shutters");
  const double rows = figures.row_offset_px;
  if (std::abs(rows) > kRowsDisagree)
    warnings.push_back(run.input + ": not_rectified: all points are " +
                       urban_nav_core::formatNumber(std::abs(rows), 2) + " px " + (rows > 0.0 ? "lower" : "higher") +
                       " in the right image than in the left one, which is compensated: calibrate the pair again");
  const double roll = run.rig.roll_rad * kRigDegrees, roll_sigma = run.rig.roll_sigma_rad * kRigDegrees;
  if (isFarOutside(roll, roll_sigma, parameters.right_roll))
    warnings.push_back(
        run.input + ": calibration: the right camera is rolled by " + urban_nav_core::formatNumber(roll, 2) + " +- " +
        urban_nav_core::formatNumber(roll_sigma, 1) + " deg against the left one, where swf_vo.right_roll = " +
        urban_nav_core::formatNumber(parameters.right_roll, 3) + " deg is assumed: calibrate the pair again");
  const double delay = 1e3 * run.rig.delay_s, delay_sigma = 1e3 * run.rig.delay_sigma_s;
  if (isFarOutside(delay, delay_sigma, parameters.shutter_delay))
    warnings.push_back(
        run.input + ": calibration: the right shutter opens " + urban_nav_core::formatNumber(std::abs(delay), 2) +
        " +- " + urban_nav_core::formatNumber(delay_sigma, 1) + " ms " + (delay > 0.0 ? "after" : "before") +
        " the left one, where swf_vo.shutter_delay = " + urban_nav_core::formatNumber(parameters.shutter_delay, 3) +
        " ms is assumed: trigger both cameras by one signal");
}

/// Appends the turns of the right camera that were found and corrected, by the frame of each.
void addTurns(const VoRun& run, std::vector<std::string>& warnings) {
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const Eigen::Vector3d& turn = run.figures[i].statistics.right_turn_rad;
    if (!run.frames[i].accepted || turn == before) continue;
    const Eigen::Vector3d change = (turn - before) * kRigDegrees;
    before = turn;
    warnings.push_back(
        run.input + ": calibration_changed: at " +
        urban_nav_core::formatNumber(urban_nav_core::secondsBetween(run.frames.front().stamp, run.frames[i].stamp), 4) +
        " s one camera of the stereo pair was turned against the other, by " +
        urban_nav_core::formatNumber(change.norm(), 2) + " deg (yaw " + urban_nav_core::formatNumber(change.y(), 2) +
        ", pitch " + urban_nav_core::formatNumber(change.x(), 2) + ", roll " +
        urban_nav_core::formatNumber(change.z(), 2) +
        " deg of the right one); later images are corrected for it: check the mounts and calibrate the pair again");
  }
}

void addWarnings(const VoRun& run, std::int64_t dropped, std::vector<std::string>& warnings) {
  const std::string where = run.input + ": ";
  if (dropped > 0)
    warnings.push_back(where + std::to_string(dropped) +
                       " frames dropped: their stamps are not later than the previous ones");
  for (std::size_t i = 0; i < std::min(run.faults.size(), kWarningsShown); ++i) warnings.push_back(run.faults[i]);
  const auto more = run.faults_total - static_cast<std::int64_t>(std::min(run.faults.size(), kWarningsShown));
  if (more > 0) warnings.push_back(where + std::to_string(more) + " more faults of this kind");
}

}  // namespace

VoSummary summarise(const VoRun& run, const swf_vo::Parameters& parameters) {
  return summarise(std::vector<const VoRun*>{&run}, parameters);
}

VoSummary summarise(const std::vector<const VoRun*>& runs, const swf_vo::Parameters& parameters) {
  VoSummary summary;
  summary.frames = totals({runs.begin(), runs.end()}).frames;
  summary.status_counts = {{"OK", 0}, {"DEGRADED", 0}, {"LOST", 0}, {"RECOVERED", 0}};
  std::vector<double> ms;
  double features = 0.0, lengths = 0.0, reprojection = 0.0;
  std::int64_t accepted = 0, observed = 0;
  for (const VoRun* run : runs) {
    std::int64_t dropped = 0;
    for (std::size_t i = 0; i < run->frames.size(); ++i) {
      const OdometryFrame& row = run->frames[i];
      const swf_vo::Statistics& of = run->figures[i].statistics;
      ++summary.status_counts[toString(row.status.health)];
      if (const auto reason = static_cast<swf_vo::Reason>(row.status.reason); reason != swf_vo::Reason::None)
        ++summary.reason_counts[swf_vo::toString(reason)];
      if (!row.accepted) {
        ++dropped;
        continue;
      }
      ++accepted;
      summary.disparity_offset_px = of.disparity_offset_px;
      summary.disparity_offset_sigma_px = of.disparity_offset_sigma_px;
      summary.row_offset_px = of.row_offset_px;
      ms.push_back(run->figures[i].process_ms);
      features += of.features;
      lengths += of.track_length_mean;
      if (of.tracked > 0) {
        reprojection += of.reprojection_px;
        ++observed;
      }
    }
    summary.dropped += dropped;
    summary.rig = run->rig;
    summary.motion = run->motion;
    addWarnings(*run, dropped, summary.warnings);
    addLosses(*run, summary.warnings);
    addRig(*run, parameters, summary.warnings);
    addTurns(*run, summary.warnings);
    if (!run->frames.empty()) addMotionFaults(run->motion, run->input, run->frames.front().stamp, summary.warnings);
  }
  const auto mean = [](double sum, std::int64_t count) { return count > 0 ? sum / static_cast<double>(count) : 0.0; };
  summary.features_mean = mean(features, accepted);
  summary.track_length_mean = mean(lengths, accepted);
  summary.reprojection_px_mean = mean(reprojection, observed);
  summary.ms_median = urban_nav_core::quantile(ms, 0.5);
  summary.ms_p99 = urban_nav_core::quantile(std::move(ms), 0.99);
  return summary;
}

Json toJson(const VoSummary& summary) {
  Json json = Json::object();
  json["frames"] = summary.frames;
  json["frames_dropped"] = summary.dropped;
  json["ms_median"] = summary.ms_median;
  json["ms_p99"] = summary.ms_p99;
  json["features_mean"] = summary.features_mean;
  json["track_length_mean"] = summary.track_length_mean;
  json["reprojection_px_mean"] = summary.reprojection_px_mean;
  json["disparity_offset_px"] = summary.disparity_offset_px;
  json["disparity_offset_sigma_px"] = summary.disparity_offset_sigma_px;
  json["row_offset_px"] = summary.row_offset_px;
  json["scale_sigma"] = summary.rig.scale_sigma;
  json["right_roll_deg"] = summary.rig.roll_rad * kRigDegrees;
  json["right_roll_sigma_deg"] = summary.rig.roll_sigma_rad * kRigDegrees;
  for (const auto& [name, radians] :
       {std::pair("pitch", summary.rig.right_turn_rad.x()), std::pair("yaw", summary.rig.right_turn_rad.y()),
        std::pair("roll", summary.rig.right_turn_rad.z())})
    json[std::string("right_turn_") + name + "_deg"] = radians * kRigDegrees;
  json["shutter_delay_ms"] = 1e3 * summary.rig.delay_s;
  json["shutter_delay_sigma_ms"] = 1e3 * summary.rig.delay_sigma_s;
  addMotion(summary.motion, summary.rig.scale_sigma, json);
  Json& statuses = json["status_counts"] = Json::object();
  for (const char* name : {"OK", "DEGRADED", "LOST", "RECOVERED"}) statuses[name] = summary.status_counts.at(name);
  Json& reasons = json["reason_counts"] = Json::object();
  for (const auto& [reason, count] : summary.reason_counts) reasons[reason] = count;
  Json& warnings = json["warnings"] = Json::array();
  for (const std::string& warning : summary.warnings) warnings.append(warning);
  return json;
}

}  // namespace urban_nav
