// SPDX-License-Identifier: BSD-3-Clause
#include "session/planar_laser.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "recording/role_names.hpp"
#include "urban_nav_core/io/archive_types.hpp"
#include "urban_nav_core/io/format_number.hpp"
#include "urban_nav_core/types/frames.hpp"

namespace urban_nav_input {

namespace {

constexpr std::array<Role, 6> kPlanarRoles = {
    {Role::LaserLeft, Role::LaserRight, Role::Laser0, Role::Laser1, Role::Laser2, Role::Laser3}};

}  // namespace

PlacedLasers PlacedLasers::find(Recording& recording, const BagTopics& topics, PlanarClouds& clouds,
                                const urban_nav_ros::StaticTransforms& transforms, bool assumes_base) {
  const char* const base = urban_nav_core::frames::kBaseLink;
  PlacedLasers placed;
  for (const Role role : kPlanarRoles) {
    const std::optional<ChosenTopic> topic = topics.find(role);
    const auto scan = topic ? clouds.first(recording, topic->name) : nullptr;
    if (!scan) continue;
    const std::string& frame = scan->header.frame_id;
    const std::optional<urban_nav_core::Pose> T_base_laser = transforms.lookup(base, frame);
    const std::string moving = transforms.findMoving(base, frame);
    const bool is_base = assumes_base && role == Role::Laser0 && placed.lasers.empty() && moving.empty();
    if (T_base_laser || is_base)
      placed.lasers.push_back({toString(role), topic->name, frame, T_base_laser.value_or(urban_nav_core::Pose())});
    if (T_base_laser) continue;
    if (!moving.empty())
      placed.notes.push_back("the transform to \"" + moving + "\" on /tf changes over time: " + topic->name +
                             " is not used, since each scan of a laser that nods or spins needs its own mounting, "
                             "which is not supported");
    else
      placed.notes.push_back(
          "no static tf from base_link to \"" + frame + "\": " +
          (is_base ? "base_link is assumed at this laser, which is assumed to be horizontal, " + topic->name
                   : topic->name + " is not used"));
  }
  return placed;
}

bool hasLaser(const BagTopics& topics) {
  return std::any_of(kPlanarRoles.begin(), kPlanarRoles.end(),
                     [&](Role role) { return topics.find(role).has_value(); });
}

std::vector<Finding> sideFindings(const PlacedLasers& placed, BagTopics topics) {
  std::vector<Finding> findings;
  for (const PlacedLaser& laser : placed.lasers) {
    if (roleFromWord(laser.role) < Role::Laser0 || urban_nav_core::isHorizontal(laser.T_base_laser)) continue;
    const double y = laser.T_base_laser.t().y();
    for (const Role side : {Role::LaserLeft, Role::LaserRight}) {
      if (topics.find(side) || (side == Role::LaserLeft ? y < 0.0 : y > 0.0)) continue;
      topics.chosen[side] = {laser.topic, ""};
      const std::string option = std::string(toString(side)) + ":=" + laser.topic;
      Finding finding{FindingKind::Topics,
                      laser.topic + " is read as " + laser.role + ", since its name indicates no side; it could be " +
                          toString(side) + ", whose single beams can be labelled",
                      "--topic " + option};
      finding.options = {"--topic", option};
      findings.push_back(std::move(finding));
      break;
    }
  }
  return findings;
}

std::optional<PlanarLaser> PlanarLaser::choose(const PlacedLasers& placed) {
  std::optional<PlanarLaser> chosen;
  for (const PlacedLaser& laser : placed.lasers) {
    if (!urban_nav_core::isHorizontal(laser.T_base_laser)) continue;
    const bool is_further = roleFromWord(laser.role) >= Role::Laser0;
    if (chosen && (!is_further || roleFromWord(chosen->laser_.role) >= Role::Laser0)) continue;
    chosen.emplace();
    chosen->laser_ = laser;
  }
  return chosen;
}

std::string PlanarLaser::describeFailure(const PlacedLasers& placed, const std::vector<Finding>& clouds) {
  std::string text;
  for (const PlacedLaser& laser : placed.lasers)
    text += (text.empty() ? "" : ", ") + laser.topic + " by " +
            urban_nav_core::formatNumber(urban_nav_core::tiltOfLaser(laser.T_base_laser) * 180.0 / M_PI, 3) + " deg";
  if (!text.empty())
    text = "its planar lasers are tilted against the ground (" + text +
           "): none of their scans measures again what an earlier one did, so that the motion of the robot is not "
           "observed; a horizontal laser (within 10 deg by tf) is required";
  for (const std::string& note : placed.notes) text += (text.empty() ? "" : "; ") + note;
  for (const Finding& finding : clouds) text += (text.empty() ? "" : "; ") + finding.text;
  return "has no images, no clouds of a 3D LiDAR, and no scans that can be used for odometry: " +
         (text.empty() ? "its topics of scans are empty" : text);
}

std::string PlanarLaser::note() const {
  return laser_.role + ": " + laser_.topic + ", a horizontal planar laser: planar motion only";
}

SweepInput PlanarLaser::read(const urban_nav_core::PlanarScan& scan) {
  return {laser_.role, laser_.T_base_laser, reader_.read(scan), true};
}

void PlanarLaser::archive(urban_nav_core::Archive& archive) {
  archive(laser_.role, laser_.topic, laser_.frame, laser_.T_base_laser, reader_);
}

}  // namespace urban_nav_input
