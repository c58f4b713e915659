// SPDX-License-Identifier: BSD-3-Clause
#include "map/odometry_summary.hpp"

#include <cmath>

namespace urban_nav {

using urban_nav_core::SharedConstant;
using urban_nav_core::StepSource;

namespace {

constexpr double kMountingDegrees = 180.0 / M_PI;

void addConstants(const OdometryFusion& fusion, Json& odometry) {
  const auto add = [&](const std::string& key, const std::string& name, double offset) {
    const SharedConstant* constant = findConstant(fusion, name);
    if (constant == nullptr) return;
    odometry[key] = offset + constant->value;
    odometry[key + "_sigma"] = constant->sigma;
  };
  add("stereo_scale", "scale", 1.0);
  add("disparity_offset_px", "disparity", 0.0);
  Json values = Json::array(), sigmas = Json::array();
  for (const char* axis : {"mounting_x", "mounting_y", "mounting_z"}) {
    const SharedConstant* constant = findConstant(fusion, axis);
    if (constant == nullptr) return;
    values.append(kMountingDegrees * constant->value);
    sigmas.append(kMountingDegrees * constant->sigma);
  }
  odometry["lidar_mounting_deg"] = values;
  odometry["lidar_mounting_deg_sigma"] = sigmas;
}

/// Returns the fusion with the smallest standard deviation of the stereo scale; null if no session has both sources.
const OdometryFusion* bestFusion(const MapContext& context) {
  const OdometryFusion* best = nullptr;
  for (const MapSession& session : context.sessions) {
    if (!session.odometry->fusion) continue;
    const OdometryFusion& fusion = *session.odometry->fusion;
    const SharedConstant* scale = findConstant(fusion, "scale");
    const SharedConstant* best_scale = best != nullptr ? findConstant(*best, "scale") : nullptr;
    if (best == nullptr || (scale != nullptr && best_scale != nullptr && scale->sigma < best_scale->sigma))
      best = &fusion;
  }
  return best;
}

}  // namespace

std::vector<StepSource> stepSources(const SessionOdometry& run) {
  if (run.fusion) return run.fusion->sources;
  const StepSource measured = run.source == OdometrySource::Laser ? StepSource::Laser : StepSource::Stereo;
  std::vector<StepSource> sources;
  for (std::size_t i = 1; i < run.settled.size(); ++i)
    sources.push_back(run.settled[i].status.health == urban_nav_core::Health::Lost ? StepSource::None : measured);
  return sources;
}

void addSteps(const SessionOdometry& run, StepCounts& counts) {
  for (const StepSource source : stepSources(run)) {
    switch (source) {
      case StepSource::None: ++counts.none; break;
      case StepSource::Stereo: ++counts.stereo; break;
      case StepSource::Laser: ++counts.laser; break;
      case StepSource::Both: ++counts.both; break;
    }
  }
}

const SharedConstant* findConstant(const OdometryFusion& fusion, const std::string& name) {
  for (const SharedConstant& constant : fusion.shared)
    if (constant.name == name) return &constant;
  return nullptr;
}

Json odometryJson(const MapContext& context) {
  StepCounts counts;
  for (const MapSession& session : context.sessions) addSteps(*session.odometry, counts);
  const OdometryFusion* fusion = bestFusion(context);
  Json json = Json::object();
  json["source"] = fusion != nullptr ? "both" : counts.laser > counts.stereo ? "laser" : "stereo";
  json["steps"] =
      Json::object({{"stereo", counts.stereo}, {"laser", counts.laser}, {"both", counts.both}, {"none", counts.none}});
  if (fusion != nullptr) addConstants(*fusion, json);
  return json;
}

}  // namespace urban_nav
