// SPDX-License-Identifier: BSD-3-Clause
#include "topics/vo/vo_files.hpp"

#include <array>
#include <cstring>
#include <map>

#include "map/odometry_summary.hpp"
#include "urban_nav_core/io/cloud/ply_writer.hpp"
#include "urban_nav_core/io/numbers.hpp"

namespace urban_nav {

using urban_nav_core::appendNumber;
using urban_nav_core::Pose;
using urban_nav_core::StampNs;
using urban_nav_core::StepSource;

namespace {

constexpr int kMinObservations = 3;  // frames; landmarks with fewer are often wrong matches

std::array<double, 7> poseValues(const Pose& pose) {
  return {pose.t().x(), pose.t().y(), pose.t().z(), pose.q().x(), pose.q().y(), pose.q().z(), pose.q().w()};
}

void appendPose(std::string& text, const Pose& pose, char separator) {
  for (const double value : poseValues(pose)) {
    text += separator;
    appendNumber(text, value);
  }
}

void appendFloat(std::string& bytes, float value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

/// Returns the source of the step to each smoothed pose by its stamp; of the first one, of the step from it.
std::map<StampNs, StepSource> sourcesByStamp(const SessionOdometry& odometry) {
  std::map<StampNs, StepSource> sources;
  const std::vector<StepSource> steps = stepSources(odometry);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (i == 0) sources[odometry.settled[0].stamp] = steps[0];
    sources[odometry.settled[i + 1].stamp] = steps[i];
  }
  return sources;
}

/// Frames without a smoothed pose were not measured by any sensor.
const char* sourceName(const std::map<StampNs, StepSource>& sources, StampNs stamp) {
  const auto found = sources.find(stamp);
  switch (found == sources.end() ? StepSource::None : found->second) {
    case StepSource::None: return "none";
    case StepSource::Stereo: return "stereo";
    case StepSource::Laser: return "laser";
    case StepSource::Both: return "both";
  }
  return "none";
}

}  // namespace

std::string landmarksPly(const VoRun& run) {
  std::string bytes;
  std::size_t count = 0;
  for (const auto& [id, landmark] : run.landmarks) {
    if (landmark.seen < kMinObservations || !landmark.landmark.p_odom.allFinite()) continue;
    for (int i = 0; i < 3; ++i) appendFloat(bytes, static_cast<float>(landmark.landmark.p_odom(i)));
    appendFloat(bytes, landmark.landmark.sigma);
    bytes.append(3, static_cast<char>(landmark.grey));
    ++count;
  }
  using urban_nav_core::PlyType;
  return urban_nav_core::plyHeader({{{"x", PlyType::Float},
                                     {"y", PlyType::Float},
                                     {"z", PlyType::Float},
                                     {"sigma", PlyType::Float},
                                     {"red", PlyType::UChar},
                                     {"green", PlyType::UChar},
                                     {"blue", PlyType::UChar}},
                                    {}},
                                   count) +
         bytes;
}

std::string statsCsv(const std::vector<const VoRun*>& runs, const std::vector<const SessionOdometry*>& chosen) {
  std::string text =
      "session,frame,stamp_ns,accepted,status,reason,source,corners,features,tracked,track_length_mean,reprojection_px,"
      "iterations,landmarks,landmarks_in_prior,disparity_offset_px,disparity_offset_sigma_px,row_offset_px,noise_scale,"
      "disparity_step_px,disparity_step_sigma_px,now_x,now_y,now_z,now_qx,now_qy,now_qz,now_qw,swf_vo_ms\n";
  for (std::size_t session = 0; session < runs.size(); ++session) {
    const std::map<StampNs, StepSource> sources = sourcesByStamp(*chosen[session]);
    for (std::size_t i = 0; i < runs[session]->frames.size(); ++i) {
      const OdometryFrame& row = runs[session]->frames[i];
      const swf_vo::Statistics& s = runs[session]->figures[i].statistics;
      text += std::to_string(session + 1) + "," + std::to_string(row.frame) + "," + std::to_string(row.stamp) +
              (row.accepted ? ",1," : ",0,") + toString(row.status.health) + "," +
              swf_vo::toString(static_cast<swf_vo::Reason>(row.status.reason)) + "," + sourceName(sources, row.stamp);
      for (const int value : {s.corners, s.features, s.tracked}) text += "," + std::to_string(value);
      for (const double value : {s.track_length_mean, s.reprojection_px}) {
        text += ',';
        appendNumber(text, value);
      }
      for (const int value : {s.iterations, s.landmarks, s.landmarks_in_prior}) text += "," + std::to_string(value);
      for (const double value : {s.disparity_offset_px, s.disparity_offset_sigma_px, s.row_offset_px, s.noise_scale,
                                 row.compared.disparity_step_px, row.compared.disparity_step_sigma_px}) {
        text += ',';
        appendNumber(text, value);
      }
      appendPose(text, row.T_odom_base, ',');
      text += ',';
      appendNumber(text, runs[session]->figures[i].process_ms);
      text += '\n';
    }
  }
  return text;
}

}  // namespace urban_nav
